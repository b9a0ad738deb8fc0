// Budgets of the machine: bits, operations, bytes and times.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/random.h"
#include "brdf/cost/model_operations.h"
#include "brdf/model/column_run.h"
#include "geometry/half_difference.h"
#include "geometry/sampling.h"
#include "reports/energy/energy.h"
#include "stability/answer.h"
#include "timing/timing.h"
#include "validate/measure.h"

#include <fmt/format.h>

namespace gonio::validating {
namespace {

/// Model in the middle of the domain, whose parameters do not change what it costs.
BoundModel middle(const Choice& c) {
  const auto rough = roughnesses(c);
  return bound(c, c.shipped, substances(c).front(), rough[rough.size() / 2]);
}

/// Work of the compensation in a shader.
CompensationWork compensation_of(const Choice& c, const char* budget) {
  const auto all = compensation_work();
  const auto at = std::ranges::find(all, name_of(c.shipped.scattering), &CompensationWork::id);
  if (at == all.end())
    throw bad_input(
        c.path, fmt::format("/budgets/{}", budget),
        fmt::format("scattering {}, which no shader computes", name_of(c.shipped.scattering)),
        "single, kulla_conty, turquin or fdez_aguera");
  return *at;
}

}  // namespace

BudgetCheck check_nonfinite(const Choice& c) {
  using namespace stability;
  Question q;
  q.arithmetic.number = c.number;
  q.safe_from = false;
  q.subject = subjects_of(to_text(middle(c).model.spec)).front();
  const auto narrow = [&](const std::string& name, double low, double high) {
    const auto at = std::ranges::find(q.subject.inputs, name, &Input::name);
    if (at == q.subject.inputs.end()) return;
    set_domain(q.subject, name, {std::max(low, at->legal.low), std::min(high, at->legal.high)});
  };
  // Parameters over all roughness and substances; cosines of directions as the domain has them.
  std::vector<std::pair<std::string, Choice::Ends>> seen;
  for (const auto& s : substances(c))
    for (const double r : roughnesses(c))
      for (const auto& [name, values] : named_values(bound(c, c.shipped, s, r)))
        for (const double v : values) {
          auto at = std::ranges::find(seen, name, &std::pair<std::string, Choice::Ends>::first);
          if (at == seen.end()) at = seen.insert(at, {name, {v, v}});
          at->second = {std::min(at->second[0], v), std::max(at->second[1], v)};
        }
  for (const auto& [name, ends] : seen) narrow(name, ends[0], ends[1]);
  if (c.domain.mu)
    for (const char* name : {"nol", "nov"}) narrow(name, (*c.domain.mu)[0], (*c.domain.mu)[1]);
  const Answer a = answer(q);
  BudgetCheck out{"nonfinite", *c.budgets.nonfinite, 0, a.holds, std::string(name_of(a.evidence))};
  out.found = static_cast<double>(a.looked.no_value.count + a.looked.overflow.count);
  if (a.counterexample) {
    out.found = std::max(out.found, 1.0);
    out.at = a.counterexample->inputs;
  }
  if (a.evidence == Evidence::open && !a.counterexample) {
    out.evidence = "searched";
    out.holds = out.found <= out.limit;
    out.words = fmt::format("It is not proved for every input: {}", a.unproved_because);
  }
  if (!a.holds && a.counterexample) out.holds = out.found <= out.limit;
  return out;
}

BudgetCheck check_operations(const Choice& c) {
  const auto n = static_cast<double>(operations_of(middle(c).model).total() +
                                     compensation_of(c, "operations").operations);
  return {"operations", *c.budgets.operations, n, n <= *c.budgets.operations, "counted"};
}

BudgetCheck check_table_bytes(const Choice& c) {
  const auto n = static_cast<double>(compensation_of(c, "table_bytes").bytes);
  return {"table_bytes", *c.budgets.table_bytes, n, n <= *c.budgets.table_bytes, "counted"};
}

BudgetCheck check_time(const Choice& c) {
  const auto& budget = *c.budgets.ns;
  constexpr std::size_t n = 4096;
  auto x = std::make_shared<AngleColumns<float>>(n, true);
  for (std::size_t i = 0; i < n; ++i) {
    Draws draw(1, i);
    const auto to = [&] { return cosine_direction({draw.uniform(), 0.99 * draw.uniform()}); };
    const auto l = to();
    x->set(i, frame_angles({l, to()}));
  }
  const BoundModel mine = middle(c);
  const BoundModel baseline = bind_model(budget.baseline, {}, mine.model.channels);
  TimingOptions options;
  options.of_thread = true;
  options.repetitions = 21;
  const auto times = time_all({{n, column_run(mine, x)}, {n, column_run(baseline, x)}}, options);
  const double ratio = times[0].ns / times[1].ns;
  BudgetCheck out{"ns", budget.limit, ratio, ratio <= budget.limit, "measured"};
  out.words = fmt::format("{:.3g} ns a sample, the baseline {:.3g} ns, in columns of float",
                          times[0].ns, times[1].ns);
  return out;
}

}  // namespace gonio::validating
