// Every term, whole model and bound: timed, counted, and held against the truth.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "reports/audit/entry.h"
#include "reports/cost/baseline.h"
#include "reports/cost/models.h"
#include "reports/cost/processes.h"
#include "reports/cost/studies.h"
#include "reports/measure/load.h"
#include "reports/picture/front.h"
#include "reports/yardstick/by_hand.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

using namespace costing;

/// Columns to read and to write, and what a model keeps between its terms.
template <class F>
struct Field {
  AngleColumns<F> x;
  std::array<Column<F>, max_channels> out;
  typename Evaluator<F>::Between scratch;

  explicit Field(std::size_t n) : x(n, true) {
    for (auto& o : out) o = Column<F>(x.padded());
    // Formulas have no branches: how often a direction comes again makes no difference.
    constexpr std::size_t different = 4096;
    std::vector<FrameAngles<double>> rows;
    for (std::size_t i = 0; i < std::min(n, different); ++i) {
      Draws draw(1, i);
      const auto direction = [&] {  // even over the hemisphere
        const double z = draw.uniform(), s = std::sqrt((1 - z) * (1 + z)),
                     phi = 2 * std::numbers::pi * draw.uniform();
        return Direction{s * std::cos(phi), s * std::sin(phi), z};
      };
      const auto light = direction();
      rows.push_back(frame_angles({light, direction()}));
    }
    for (std::size_t i = 0; i < n; ++i) x.set(i, rows[i % rows.size()]);
  }
};
template <class F>
using SharedField = std::shared_ptr<Field<F>>;

/// A term as a composed model uses it: D begins, a fraction or not, V divides a fraction, F and a diffuse
/// term join what is there.  (V's loop takes GGX's D in, which is not timed here.)
template <class F>
Timed timed_term(std::size_t term, const Kernels<F>& kernels, const SharedField<F>& field) {
  const auto& t = kernels.terms[term];
  const auto& entry = catalogue()[term];
  std::array<F, max_parameters> p{};
  for (std::size_t k = 0; k < entry.parameters.size(); ++k)
    p[k] = static_cast<F>(entry.parameters[k].start);
  auto& s = field->scratch;
  using Between = typename Evaluator<F>::Between;
  F *const num = s[Between::first_free], *const den = s[Between::first_free + 1];
  const auto by_blocks = [field](const auto& work) {
    constexpr std::size_t block = Between::block;
    const auto x = field->x.block();
    for (std::size_t at = 0; at < x.n; at += block) work(x.part(at, std::min(block, x.n - at)), at);
  };
  const Role role = entry.role();
  if (role == Role::ndf || role == Role::masking) {
    const ProductColumns<F> join{s.ones(), s.ones(), nullptr, num, den};
    return {field->x.size(), [=, kernel = role == Role::ndf ? t.start_product : t.finish_product] {
              by_blocks([&](const Block<F>& x, std::size_t) { kernel(x, p.data(), join); });
            }};
  }
  ChannelColumns<F> join;
  if (role == Role::fresnel) join.factor = s.ones();
  return {field->x.size(), [=, kernel = t.shade[1]] {
            auto j = join;
            j.parameters[0] = p.data();
            by_blocks([&](const Block<F>& x, std::size_t at) {
              j.out[0] = field->out[0].data() + at;
              kernel(x, j);
            });
          }};
}

template <class F>
std::array<F*, max_channels> outputs(Field<F>& field) {
  std::array<F*, max_channels> out;
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = field.out[c].data();
  return out;
}
template <class F>
std::vector<F> values_of(const BoundModel& b) {
  return {b.values.begin(), b.values.end()};
}

template <class F>
Timed timed_model(const BoundModel& b, const Kernels<F>& kernels, const SharedField<F>& field) {
  const auto evaluator = std::make_shared<Evaluator<F>>(b.model, kernels);
  evaluator->set(values_of<F>(b));
  return {field->x.size(), [=, out = outputs(*field), channels = b.model.channels] {
            (*evaluator)(field->x.block(), {out.data(), channels});
          }};
}
template <class F>
Timed timed_by_hand(const HandWritten<F>& hand, const BoundModel& b, const SharedField<F>& field) {
  return {field->x.size(),
          [=, value = hand.value, values = values_of<F>(b), out = outputs(*field)] {
            value(field->x.block(), values.data(), out.data());
          }};
}

/// True of the same terms in as many channels.
bool is_same(const Model& a, const Model& b) {
  const auto same = [](const TermUse& s, const TermUse& t) { return s.term == t.term; };
  return a.channels == b.channels && std::ranges::equal(a.diffuse, b.diffuse, same) &&
         std::ranges::equal(a.lobes, b.lobes, [&](const Lobe& s, const Lobe& t) {
           return same(s.ndf, t.ndf) && same(s.masking, t.masking) && same(s.fresnel, t.fresnel);
         });
}

/// Time of reading four columns and writing one, with almost no arithmetic.
template <class F>
Timed timed_columns(const Kernels<F>& kernels, const SharedField<F>& field) {
  return {field->x.size(), [product_sum = kernels.product_sum, field] {
            const auto x = field->x.block();
            product_sum(x.n, x.nol, x.nov, x.noh, x.voh, field->out[0].data());
          }};
}

template <class F>
Timed timed_roots(const RootsAndDivision<F>& bound, const SharedField<F>& field) {
  return {field->x.size(), [=] { bound.value(field->x.block(), field->out[0].data()); }};
}

/// A row before it is measured.
struct Subject {
  CostRow row;
  Timed timed;
};

/// Subjects of one number in one place.
template <class F>
void add_subjects(std::vector<Subject>& to, const CostOptions& o, std::string_view memory) {
  const bool streaming = memory == "streaming";
  const auto sets = instruction_sets();
  const std::string_view number = std::is_same_v<F, float> ? "float" : "double";
  const auto field = std::make_shared<Field<F>>(streaming ? o.stream_samples : o.cache_samples);
  const auto wanted = [&](std::string_view id) { return id.find(o.filter) != id.npos; };
  for (const auto& set : sets) {
    if (streaming && !o.full && set != sets.back()) continue;
    const auto& k = kernels<F>(set);
    const auto add = [&](std::string_view id, std::string_view kind, std::string_view way,
                         std::size_t channels, Timed timed) {
      CostRow row{std::string(id), kind, number, set, memory, way, channels, {}, {}, 0, {}};
      to.push_back({std::move(row), std::move(timed)});
    };
    for (std::size_t t = 0; t < catalogue_size(); ++t) {
      const auto id = catalogue()[t].id();
      if (wanted(id)) add(id, name_of(role_of(id)), "", 1, timed_term<F>(t, k, field));
    }
    auto terms_alone = k;
    terms_alone.fused = {};
    for (const auto& w : wholes()) {
      if (!wanted(w.id)) continue;
      const auto& m = w.model.model;
      if (Evaluator<F>(m, k).is_fused())
        add(w.id, "model", "fused", m.channels, timed_model<F>(w.model, k, field));
      add(w.id, "model", "composed", m.channels, timed_model<F>(w.model, terms_alone, field));
      for (const auto& hand : by_hand<F>(set).models)
        if (is_same(compose(hand.spec, hand.channels), m))
          add(w.id, "by_hand", "by_hand", m.channels, timed_by_hand<F>(hand, w.model, field));
    }
    if (std::is_same_v<F, float> && !streaming)
      for (auto& s : study_subjects(set, o.cache_samples))
        if (wanted(s.id)) add(s.id, s.kind, "", 1, std::move(s.timed));
    if (wanted("bound.columns")) add("bound.columns", "bound", "", 1, timed_columns<F>(k, field));
    if (wanted("bound.roots_and_division"))
      add("bound.roots_and_division", "bound", "", 1, timed_roots<F>(by_hand<F>(set).bound, field));
  }
}

std::vector<Subject> subjects_in(const CostOptions& o, std::string_view memory) {
  std::vector<Subject> out;
  add_subjects<float>(out, o, memory);
  add_subjects<double>(out, o, memory);
  return out;
}
std::vector<Subject> all_subjects(const CostOptions& o) {
  auto out = subjects_in(o, "cache");
  std::ranges::move(subjects_in(o, "streaming"), std::back_inserter(out));
  return out;
}

/// Times that this process finds for each subject, in their order.
std::vector<std::vector<double>> times_here(const CostOptions& o,
                                            const std::function<void(double)>& done) {
  auto subjects = subjects_in(o, "cache");
  const std::size_t cached = subjects.size();
  std::ranges::move(subjects_in(o, "streaming"), std::back_inserter(subjects));
  // In cache it matters how columns lie to each other, and a run would know one way alone: several,
  // of columns that are a little longer, share the repetitions.
  constexpr int ways = 3;
  const int each = (o.timing.repetitions + ways - 1) / ways;
  for (int way = 1; way < ways; ++way) {
    auto longer = o;
    longer.cache_samples += 48 * static_cast<std::size_t>(way * way);
    std::ranges::move(subjects_in(longer, "cache"), std::back_inserter(subjects));
  }
  std::vector<Timed> timed;
  for (auto& s : subjects) {
    s.timed.repetitions = each;
    timed.push_back(std::move(s.timed));
  }
  auto taken = repetitions_of(timed, o.timing, done);
  const std::size_t rows = taken.size() - (ways - 1) * cached;
  for (std::size_t i = rows; i < taken.size(); ++i)
    std::ranges::copy(taken[i], std::back_inserter(taken[(i - rows) % cached]));
  taken.resize(rows);
  return taken;
}

/// Facts that do not depend on where it runs: by id and number.
struct Facts {
  Operations operations, block_operations;
  std::size_t bytes;
  CostError error;
};
using FactsByName = std::map<std::pair<std::string, std::string_view>, Facts>;

Operations block_operations(const Model& m) {
  Operations sum;
  const auto add = [&](const TermUse& t) { sum += operations_of(t.term).parameters; };
  for (const auto& d : m.diffuse) add(d);
  for (const auto& l : m.lobes) add(l.ndf), add(l.masking), add(l.fresnel);
  return sum;
}

FactsByName facts_of(const std::vector<Subject>& subjects,
                     bool errors,
                     const std::function<void(double)>& done) {
  FactsByName facts;
  std::vector<FactsByName::value_type*> all;
  for (const auto& s : subjects) {
    if (is_study(s.row.kind)) continue;
    if (const auto [at, added] = facts.try_emplace({s.row.id, s.row.number}); added)
      all.push_back(&*at);
  }
  const auto models = wholes();
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    const auto& [id, number] = all[i]->first;
    Facts& f = all[i]->second;
    const bool is_float = number == "float";
    if (const auto w = std::ranges::find(models, id, &Whole::id); w != models.end()) {
      f = {operations_of(w->model.model),
           block_operations(w->model.model),
           table_bytes(w->model.model),
           {}};
      if (errors) f.error = is_float ? error_of_whole<float>(*w) : error_of_whole<double>(*w);
    } else if (id == "bound.columns") {
      f.operations[Operation::mul] = 2;
      f.operations[Operation::add] = 1;
    } else if (id == "bound.roots_and_division") {
      f.operations[Operation::sqrt] = 2;
      f.operations[Operation::add] = f.operations[Operation::div] = 1;
    } else {
      const auto term = find_term(id);
      const auto count = operations_of(term);
      f = {count.sample, count.parameters, table_bytes(id), {}};
      if (errors) f.error = error_of_term(term, is_float ? Number::float_ : Number::double_);
    }
  });
  done(1);
  return facts;
}

/// Name of the rows that are compared with each other.
std::string rivals(const CostRow& r) {
  return fmt::format("{} {} {} {} {} {}", r.kind, r.number, r.isa, r.memory, r.channels,
                     r.error.truth);
}

}  // namespace

void mark_front(std::vector<CostRow>& rows) {
  std::map<std::string, std::vector<CostRow*>> groups;
  for (auto& r : rows)
    if (!r.error.truth.empty() && !is_mistake(r)) groups[rivals(r)].push_back(&r);
  for (auto& [name, group] : groups) {
    std::vector<TimedError> places;
    for (const auto* r : group) places.push_back({r->time, r->error.rms, r->each});
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto place = front_place(places, i);
      group[i]->pareto = place.front, group[i]->tie = place.tie;
      group[i]->on_line = place.on_line;
    }
  }
}

MeasuredCosts measure_costs(const CostOptions& o, const ReportProgress& done) {
  // Names of everything, in columns too short to be measured.
  auto named = o;
  named.cache_samples = named.stream_samples = padding;
  auto subjects = all_subjects(named);
  const auto facts = facts_of(subjects, o.errors, part_of(done, "errors", 0, 0.2));
  MeasuredCosts out;
  std::vector<CostName> names;
  for (const auto& s : subjects) names.push_back(name_of(s.row));
  const OthersWork others;
  const auto part = part_of(done, "times", 0.2, 1);
  auto taken = times_in_processes(o, names, part);
  const bool here = taken.empty();
  if (here) taken = times_here(o, part);
  out.others = others.processors();
  if (!here) out.processes = o.processes;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    auto& r = out.rows.emplace_back(std::move(subjects[i].row));
    if (!here) r.each = taken[i];
    r.time = spread_of(std::move(taken[i]));
    if (r.kind == "by_hand") continue;  // its operations are not the formula's; beside the front
    if (is_study(r.kind)) {
      if (o.errors) r.error = study_error(r);
      continue;
    }
    const auto& f = facts.at({r.id, r.number});
    r.operations = f.operations, r.block_operations = f.block_operations, r.bytes = f.bytes;
    r.error = f.error;
  }
  mark_front(out.rows);
  return out;
}

}  // namespace gonio
