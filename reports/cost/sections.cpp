// The page of the cost report: what accuracy costs in time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "brdf/catalogue/registry.h"
#include "reports/cost/cost.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using page::Group;
using page::Table;

constexpr const char* numbers[] = {"float", "double"};
const Control by_number{"number", "Number", "float"};

/// To the first digit of the spread, or to picoseconds.
std::string ns_text(double ns, double spread) {
  const int decimals =
      std::clamp(-static_cast<int>(std::floor(std::log10(std::max(spread, 1e-3)))), 0, 3);
  return fmt::format("{}{:.{}f} ± {:.{}f}", ns < 0 ? "−" : "", std::abs(ns), decimals, spread,
                     decimals);
}
Cell time_cell(const Timing& t) {
  return Cell(std::isfinite(t.ns) ? ns_text(t.ns, t.spread_ns) : "–");
}
Cell error_cell(double e) {
  return Cell(significant(e, 2));
}
Cell count_cell(std::size_t n) {
  return Cell(fmt::format("{}", n));
}
Cell bytes_cell(std::size_t n) {
  return Cell(n ? count_text(n) : "");
}
Cell model_cell(std::string_view id) {
  const auto cell = form_cell(id);
  return cell.aside.empty()
             ? Cell{fmt::format("`{}`", id.starts_with("model.") ? id.substr(6) : id)}
             : cell;
}
std::string best_set(const CostRows& all) {
  return all.machine.instruction_sets.empty() ? "" : all.machine.instruction_sets.back();
}
std::string in_memory(const CostRows& all, std::string_view memory) {
  return memory == "cache" ? "in cache" : long_columns(all.options);
}
/// "avx2, in cache"
std::string place_of(const CostRows& all, const std::string& isa, std::string_view memory) {
  return fmt::format("{}, {}", isa, in_memory(all, memory));
}

// --- What it costs to switch
std::string with_sign(double x, int digits) {
  return (x > 0 ? "+" : x < 0 ? "−" : "±") + significant(std::abs(x), digits);
}
Table switch_table(const CostRows& all, std::string_view number) {
  const auto best = best_set(all);
  Table t{columns("from, to|>[ns]|>|>[ns]|>|>a 1080p frame [ms]|>operations|>RMS error from|>to")};
  t.above = {
      {"", 1}, {best + ", in cache", 2}, {best + ", " + long_columns(all.options), 2}, {"", 4}};
  for (const auto& q : unique(all.switches, &CostSwitch::question)) {
    const auto of = [&](std::string_view isa, std::string_view memory) -> const CostSwitch* {
      for (const auto& s : all.switches)
        if (s.question == q && s.isa == isa && s.memory == memory && s.number == number) return &s;
      return nullptr;
    };
    const auto* s = of(best, "cache");
    for (const auto& x : all.switches)
      if (!s && x.question == q) s = &x;
    auto& row = t.rows.emplace_back(std::vector{
        Cell{q + (s->way.empty() ? "" : ", " + std::string(s->way)), {}, {}, "because"}});
    for (const auto* x : {of(best, "cache"), of(best, "streaming")}) {
      row.push_back(x ? (x->ns > 0 ? "+" : "") + ns_text(x->ns, x->ns_spread) : "–");
      row.push_back(!x ? "–" : x->differs ? "×" + significant(x->ratio, 2) : "a tie");
    }
    row.insert(row.end(),
               {s->differs ? with_sign(s->ns * frame_samples * 1e-6, 2) : "a tie",
                with_sign(s->operations, 3), error_cell(s->error_from), error_cell(s->error_to)});
  }
  return t;
}
/// A choice between tables of both numbers.
template <class Make>
Choice in_both_numbers(Make make) {
  Slot slot;
  for (const char* n : numbers) slot.each.push_back({{n}, {make(n)}});
  return {{by_number}, {std::move(slot)}, ""};
}
Section what_it_costs(const CostRows& all) {
  return {"What does it cost to switch?",
          fmt::format(
              "The time that one sample takes more, with the spread between processes, and how "
              "many times as long it takes. A difference that is not there in every process is a "
              "tie. A frame is one sample each pixel in cache, on one processor. In {}, memory "
              "hides what is computed while it waits. Terms are timed as a model uses them; "
              "operations are those of the term itself.",
              long_columns(all.options)),
          {in_both_numbers([&](const char* n) { return switch_table(all, n); })},
          "switches"};
}

// --- Time against error
bool has_choice(const Figure& f, std::string_view key) {
  return std::ranges::any_of(f.choices, [&](const auto& c) { return c.first == key; });
}
Section against_time(const CostReport& r) {
  const auto& all = r.rows;
  Choice c;
  c.controls = {
      by_number, {"set", "Instruction set", best_set(all)}, {"memory", "Columns", "cache"}};
  c.controls[2].called = {{"cache", "in cache"}, {"streaming", long_columns(all.options)}};
  std::vector<std::string> families;
  page::Group others{"panels", {}};
  for (const auto& f : r.pictures.figures) {
    if (has_choice(f, "set")) {
      if (std::ranges::find(families, f.family) == families.end()) families.push_back(f.family);
    } else if (f.family != "quadrature") {
      others.parts.emplace_back(Shown{f.family, f.choices, 400});
    }
  }
  for (const auto& family : families) {
    c.slots.push_back(slot_of(r.pictures, family, c.controls, 400));
    c.slots.back().on_paper = false;
  }
  Section s{"Time against error",
            "Each point is a form; further left is faster, further down is more exact. The line "
            "joins those that nothing dominates: nothing that is as exact is faster in every "
            "process that measured. A form that ties with a better one is not on it. Errors of 0 "
            "in double are drawn at 10⁻¹⁷. Masking is compared with Smith of its distribution, "
            "height-correlated; Fresnel terms with the exact form that they stand for; whole "
            "models with correlated Smith and exact Fresnel of glass and gold, or of the one that "
            "they stand for, under their own distribution, roughness 0.1 to 1.",
            {}};
  if (!families.empty()) s.parts.emplace_back(std::move(c));
  if (!others.parts.empty()) s.parts.emplace_back(std::move(others));
  if (has_family(r.pictures, "quadrature")) {
    Choice q;
    q.controls = {{"case", "Albedo of", "", true}};
    for (const auto& v : values_of(r.pictures, "quadrature", "case"))
      if (q.controls[0].chosen.empty() && v.find("0.5") != v.npos) q.controls[0].chosen = v;
    q.slots = {slot_of(r.pictures, "quadrature", q.controls, 400)};
    s.parts.emplace_back(std::move(q));
  }
  return s.parts.empty() ? Section{} : s;
}

// --- Whole models
Table model_table(const CostRows& all, std::string_view number) {
  const auto best = best_set(all);
  Table t{
      columns("model|>channels|>by hand [ns]|>fused [ns]|>over by hand|>composed [ns]|>over by "
              "hand|>by hand [ns]|>fused [ns]|>composed [ns]")};
  t.above = {{"", 2}, {"in cache", 5}, {long_columns(all.options), 3}};
  const auto text = [](const CostRow* r) { return r ? time_cell(r->time) : Cell("–"); };
  const auto over = [](const CostRow* a, const CostRow* b) {
    return Cell(a && b ? "×" + significant(a->time.ns / b->time.ns, 3) : "");
  };
  std::vector<std::string> ids;
  for (const auto& r : all.rows)
    if (r.kind == "model" && std::ranges::find(ids, r.id) == ids.end()) ids.push_back(r.id);
  for (const auto& id : ids) {
    const auto of = [&](std::string_view way, std::string_view memory) {
      return find_row(all.rows, id, number, best, memory, way);
    };
    const auto *hand = of("by_hand", "cache"), *fused = of("fused", "cache"),
               *composed = of("composed", "cache");
    t.add(model_cell(id), composed ? fmt::format("{}", composed->channels) : "", text(hand),
          text(fused), over(fused, hand), text(composed), over(composed, hand),
          text(of("by_hand", "streaming")), text(of("fused", "streaming")),
          text(of("composed", "streaming")));
  }
  for (const auto& r : all.rows) {
    if (r.kind != "bound" || r.isa != best || r.memory != "cache" || r.number != number) continue;
    const Cell none;
    t.add(
        r.id == "bound.columns" ? "four columns read and one written" : "a division and two roots",
        none, text(&r), none, none, none, none,
        text(find_row(all.rows, r.id, number, best, "streaming")), none, none);
  }
  return t;
}
Section whole_models(const CostRows& all) {
  return {"Whole models, and what bounds them",
          fmt::format("In columns of {}: written out by hand for that model only, as the terms of "
                      "the catalogue fused into one loop, and composed of the columns of its terms "
                      "at run time. Beside them stands what the arithmetic and the memory allow, "
                      "measured in the same run. Models that ship are evaluated in three channels.",
                      best_set(all)),
          {in_both_numbers([&](const char* n) { return model_table(all, n); })}};
}

// --- Every entry
Section every_entry(const CostRows& all) {
  Choice c;
  c.controls = {by_number, {"place", "Place", place_of(all, best_set(all), "cache"), true}};
  Slot slot;
  for (const auto& r : all.rows) {
    constexpr std::string_view others[] = {"bound", "by_hand", "sampling", "split_sum"};
    if (std::ranges::find(others, r.kind) != std::end(others)) continue;
    const std::vector<std::string> of{std::string(r.number), place_of(all, r.isa, r.memory)};
    auto at = std::ranges::find(slot.each, of, &Alternative::chosen);
    if (at == slot.each.end())
      at = slot.each.insert(
          at,
          {of,
           {Table{columns(
               "|kind|>channels|>time [ns]|>operations|>of the parameters|>divisions|>roots|>exp, "
               "log|>table [bytes]|>largest error|>RMS|>ΔE2000 of gold|of|against|front")}}});
    const bool known = !r.error.truth.empty();
    const auto& ops = r.operations.by_kind;
    std::get<Table>(at->parts[0].is)
        .add(r.way.empty() ? form_cell(r.id)
                           : Cell{fmt::format("{}, {}", model_cell(r.id).text, r.way)},
             std::string(r.kind), count_cell(r.channels), time_cell(r.time),
             count_cell(r.operations.total()), count_cell(r.block_operations.total()),
             count_cell(ops[2]), count_cell(ops[3]), count_cell(ops[4] + ops[5]),
             bytes_cell(r.bytes),
             error_cell(known ? r.error.max : std::numeric_limits<double>::quiet_NaN()),
             error_cell(known ? r.error.rms : std::numeric_limits<double>::quiet_NaN()),
             std::isfinite(r.error.delta_e) ? significant(r.error.delta_e, 2) : "",
             Cell{r.error.measure, {}, {}, "because small"},
             Cell{form_cell(r.error.truth).text, {}, {}, "because small"},
             known && r.pareto ? (r.tie ? "a tie" : "yes") : "");
  }
  c.slots = {std::move(slot)};
  c.look = "";
  return {
      "Every entry",
      "Times are of one sample in all its channels. Operations of the parameters, such as a root "
      "of roughness, are made once per block here and hardly count in these times; a shader whose "
      "roughness varies makes them for each sample. Errors are absolute: of terms over the "
      "directions and parameters that the audit looks at, D over its peak; of whole models as "
      "above. On the front are forms that nothing of their kind, channels and truth dominates.",
      {c}};
}

// --- Studies
Section light_sampling(const CostRows& all) {
  const auto& rows = all.studies.sampling;
  if (rows.empty()) return {};
  std::vector<std::string> names;
  std::vector<std::pair<double, double>> places;
  for (const auto& r : rows) {
    if (std::ranges::find(names, r.name) == names.end()) names.push_back(r.name);
    if (std::ranges::find(places, std::pair(r.roughness, r.mu)) == places.end())
      places.emplace_back(r.roughness, r.mu);
  }
  const auto at = [&](const std::string& name, std::pair<double, double> place) {
    return std::ranges::find_if(rows, [&](const auto& r) {
      return r.name == name && std::pair(r.roughness, r.mu) == place;
    });
  };
  Table t{columns("roughness, NoV")};
  for (const auto& n : names) t.head.push_back({n + ": σ", true});
  for (const auto& n : names) t.head.push_back({n + " [µs to 1 %]", true});
  for (const auto& place : places) {
    auto& row =
        t.rows.emplace_back(std::vector{Cell{plain(place.first) + ", " + plain(place.second)}});
    for (const auto& n : names) row.push_back(error_cell(at(n, place)->deviation));
    for (const auto& n : names) {
      const auto r = at(n, place);
      const double us = us_to_percent(*r);
      row.push_back(std::isfinite(us) ? fmt::format("{} ({} % below)", significant(us, 2),
                                                    significant(100 * r->below, 2))
                                      : "–");
    }
  }
  auto& row = t.rows.emplace_back(std::vector{Cell{"time of a sample [ns]"}});
  for (const auto& n : names) row.push_back(time_cell(at(n, places[0])->time));
  row.resize(t.head.size());
  return {
      "Light drawn for GGX",
      fmt::format(
          "One light and its weight, f NoL over its density at F = 1, in float columns of {} in "
          "cache. A sample's standard deviation is over E. The last columns are the time until the "
          "error is 1 % of E, variance at equal time, with the share of lights below the horizon.",
          best_set(all)),
      {t},
      "sampling"};
}
Section tables_and_formulas(const CostRows& all) {
  if (all.studies.lookup.empty()) return {};
  Table t{columns(
      "|>size [bytes]|>fetched [bytes]|>time [ns]|>RMS of A|>of B|>of 0.04 A + B|>of A + B|>most")};
  for (const auto& r : all.studies.lookup)
    t.add(r.name, bytes_cell(r.bytes), bytes_cell(r.fetched), time_cell(r.time),
          error_cell(r.a_rms), error_cell(r.b_rms), error_cell(r.plastic_rms),
          error_cell(r.mirror_rms), error_cell(r.mirror_max));
  return {
      "Table or formula",
      fmt::format("A and B of the split sum against quadrature, roughness from 0.05 and NoV from "
                  "1/32 on. Times are of float columns of {} in cache, where a table's texels are "
                  "fetched one by one: a GPU has a unit for that, this processor does not.",
                  best_set(all)),
      {t},
      "lookups"};
}
Section as_shaders(const CostRows& all) {
  if (all.studies.shaders.empty()) return {};
  Table t{columns(
      "model|>operations|>instructions|>sums|>products|>divisions|>roots|>exp, log|>choices")};
  bool compiled = false;
  for (const auto& r : all.studies.shaders) {
    compiled = compiled || !r.instructions.empty();
    const auto of = [&](std::initializer_list<std::string_view> kinds) {
      std::size_t n = 0;
      for (const auto& [kind, count] : r.instructions)
        if (std::ranges::find(kinds, kind) != kinds.end()) n += count;
      return Cell(r.instructions.empty() ? "–" : count_text(n));
    };
    t.add(model_cell(r.id), count_text(r.operations.total()),
          of({"add", "mul", "fma", "div", "sqrt", "exp", "log", "min_max", "compare", "select"}),
          of({"add"}), of({"mul", "fma"}), of({"div"}), of({"sqrt"}), of({"exp", "log"}),
          of({"min_max", "compare", "select"}));
  }
  return {"In a shader",
          std::string("Each model as `gonio shader` writes it in GLSL, in float and three "
                      "channels, all its parameters arguments. Operations are of the formula: what "
                      "is shared counts once, operations on a colour count three times. ") +
              (compiled ? "Instructions are of its SPIR-V after spirv-opt -O, without loads and "
                          "copies; one on a colour counts once. One version of these compilers "
                          "gives the same on every machine."
                        : "Where glslangValidator and spirv-opt are on PATH, the instructions of "
                          "its SPIR-V stand beside them."),
          {t},
          "shaders"};
}

// --- The machine
Section the_machine(const CostRows& all) {
  const auto& o = all.options;
  const auto& m = all.machine;
  std::vector<std::string> caches;
  for (const auto& c : m.caches)
    caches.push_back(fmt::format("L{} {}", c.level,
                                 c.bytes >= 1U << 20U
                                     ? plain(static_cast<double>(c.bytes) / 1048576) + " MiB"
                                     : plain(static_cast<double>(c.bytes) / 1024) + " KiB"));
  return {
      "How it was measured",
      fmt::format(
          "{} Kernels: the time of the thread. In cache: {} samples again and again. Long columns: "
          "{} samples, {} MiB of floats each; a term reads and writes one to four columns and a "
          "model more. A last cache as large as that may hold them. How columns lie to each other "
          "in memory matters in cache: each process measures three ways.",
          all.processes > 1 ? fmt::format("Times are medians over {} processes, each of which "
                                          "measured everything in an order of its own; the spread "
                                          "is half the distance of the quartiles between them.",
                                          all.processes)
                            : fmt::format("Times are medians of {} repetitions in one process; the "
                                          "spread is half the distance of the quartiles and does "
                                          "not hold what differs from process to process.",
                                          o.timing.repetitions),
          count_text(o.cache_samples), count_text(o.stream_samples),
          plain(static_cast<double>(o.stream_samples) * 4 / 1048576)),
      {Pairs{{{"processor", m.cpu},
              {"threads", fmt::format("{}", m.threads)},
              {"other programs meanwhile",
               all.others ? fmt::format("kept {} processors busy", plain(*all.others, 2))
                          : "not known"},
              {"arithmetic in half", m.native_half
                                         ? "there, used by no kernel"
                                         : "none (AVX512-FP16): times are of float and double"},
              {"caches", fmt::format("{}", fmt::join(caches, ", "))},
              {"instruction sets", fmt::format("{}", fmt::join(m.instruction_sets, ", "))},
              {"compiler", m.compiler},
              {"flags", m.flags}}}}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const CostReport& r) {
  using namespace page;
  const auto& all = r.rows;
  Page out{"cost", "report cost", "What accuracy costs in time", "What accuracy costs in time",
           r.findings.sentences};
  out.full = r.full;
  for (const char* family : {"masking", "fresnel"})
    if (out.first.empty())
      out.first = opening(r.pictures, family,
                          {{"number", "float"}, {"set", best_set(all)}, {"memory", "cache"}}, 360);
  out.sections = {what_it_costs(all),       against_time(r), whole_models(all), light_sampling(all),
                  tables_and_formulas(all), as_shaders(all), every_entry(all),  the_machine(all)};
  if (!r.full)
    out.setting = "`--full` measures long columns in every instruction set, by more processes.";
  return out;
}

}  // namespace gonio
