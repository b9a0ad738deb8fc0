// The page of the atlas of numerical stability: which alpha is safe in which number, what clamps
// save and cost.
#include <algorithm>
#include <cmath>
#include <map>

#include "brdf/catalogue/registry.h"
#include "reports/finding/words.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"
#include "reports/stability/stability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using page::Group;
using page::Table;

constexpr const char* dense = "in-cards dense";

/// How a form's angles are given, in words.
std::string given(std::string_view form) {
  static const std::map<std::string_view, const char*> words{
      {"cross", "|n × h|²"},       {"cosine", "only NoH"},
      {"frame", "h in the frame"}, {"facet", "VoH"},
      {"cosines", "NoL, NoV"},     {"directions", "two directions"},
      {"turned", "two directions"}};
  const auto at = words.find(form);
  return at == words.end() ? std::string() : at->second;
}
std::string evidence_text(stability::Evidence e) {
  using enum stability::Evidence;
  return e == exhaustive ? "every input"
         : e == searched ? "search"
         : e == proved   ? "proved"
                         : "open";
}
std::string error_text(std::optional<double> x) {
  if (!x || !std::isfinite(*x)) return "–";
  return *x >= 10 ? "×" + significant(*x + 1, 2) : percent(*x);
}
std::string place(const StabilityRow& r) {
  return r.at + (r.at.empty() || r.inputs_hex.empty() ? "" : "; ") + r.inputs_hex;
}
Cell error_cell(std::optional<double> x, std::string title = {}) {
  return Cell(error_text(x), std::move(title));
}
Cell count_cell(std::uint64_t n, std::string title = {}) {
  return Cell(n ? count_text(n) : "none", std::move(title));
}
std::string form_text(const std::string& id) {
  return form_cell(id).text;
}
/// A slot with a table by the first control's value, or by both.
Choice tables(std::vector<Control> controls, Slot slot) {
  return {std::move(controls), {std::move(slot)}, ""};
}

// --- The question that people come with ----------------------------------------------------------
Section clamp_question(const StabilityRows& all) {
  std::vector<StabilityRow> widths;
  for (const auto& r : all.rows)
    if (r.decides == "alpha" && r.id.starts_with("ndf.")) widths.push_back(r);
  Slot slot;
  for (const auto& number : unique(widths, &StabilityRow::number)) {
    Table t{columns("distribution|given|>alpha from|>worst|>from 0.05 on|>without a value|>finite: "
                    "proved from|take instead|>operations|by"),
            {},
            dense};
    for (const auto& r : widths) {
      if (r.number != number) continue;
      const auto* better = better_form(widths, r);
      t.add(form_cell(r.id), given(r.form), r.safe_from ? rounded_up(*r.safe_from) : "nowhere",
            error_cell(r.worst_rel, place(r)), error_cell(r.worst_from_usual),
            count_cell(r.nonfinite + r.overflow, r.nonfinite_at),
            r.finite_from ? significant(*r.finite_from, 2) : "–",
            better ? (better->id == r.id ? std::string("from |n × h|²") : form_text(better->id))
                   : "–",
            !better || r.stable.empty() ? fmt::format("{}", r.operations)
                                        : fmt::format("{} → {}", r.operations, r.stable_operations),
            evidence_text(r.evidence));
    }
    slot.each.push_back({{number}, {std::move(t)}});
  }
  return {
      "Which alpha is safe",
      "From this alpha on, every input that was tried keeps the tolerance: 2 % in half and "
      "mixed numbers, 0.0001 in float, 10⁻¹⁰ in double. Inputs count as exact: a NoH that is "
      "rounded to half on its way adds an error of its own, as ggx.mobile shows in mixed "
      "numbers. The pointer shows the worst input, also in bits. “Worst” is that of results which "
      "the number holds as normal ones, over the whole range. “From 0.05 on” is the worst "
      "from that alpha on, for forms that do not keep 2 % there.",
      {tables({{"number", "Number", "half"}}, std::move(slot))}};
}

// --- Pictures
Section by_alpha(const Pictures& p) {
  if (!has_family(p, "error_by_alpha")) return {};
  Choice c;
  c.controls = {{"number", "Number"}, {"kind", "Kind"}};
  c.slots = {slot_of(p, "error_by_alpha", c.controls, 380)};
  c.look = "";
  return {
      "How errors grow as surfaces get smooth", "The worst over all angles, at each alpha.", {c}};
}
Section where(const Pictures& p) {
  if (!has_family(p, "error")) return {};
  Choice c;
  c.controls = {{"form", "Form", "ggx from NoH", true}, {"number", "Number", "half"}};
  for (const auto& form : values_of(p, "error", "form")) {
    const auto id = form.substr(0, form.find(' '));
    for (const char* role : {"ndf.", "masking.", "fresnel.", "model."})
      if (const auto cell = form_cell(role + id); !cell.aside.empty()) {
        c.controls[0].called.emplace_back(form, cell.text + form.substr(id.size()));
        break;
      }
  }
  c.slots = {slot_of(p, "error", c.controls)};
  c.slots[0].on_paper = false;
  c.look = "";
  return {"Where errors are", "By alpha and angle, both in logarithms.", {c}};
}

// --- Clamps
Section clamps(const StabilityRows& all) {
  if (all.clamps.empty()) return {};
  Table t{columns("clamp|in|number|>no value up to, without|>with|>worst, without|>with|>changes "
                  "values up to|>by at most"),
          {},
          dense};
  for (const auto& c : all.clamps) {
    const auto up_to = [&](std::optional<double> x) {
      return Cell(x ? c.by + " " + significant(*x, 2) : "nowhere");
    };
    t.row_looks.emplace_back(!t.rows.empty() && t.rows.back()[0].text != c.clamp ? "first" : "");
    t.add(c.clamp, "`" + c.where + "`", c.number, up_to(c.no_value_without), up_to(c.no_value_with),
          error_cell(c.worst_without), error_cell(c.worst_with), up_to(c.changed_to),
          error_cell(c.changed_most));
  }
  return {"What shipped clamps save and cost",
          "The same inputs with the clamp and without it. It saves inputs without a value, and the "
          "worst error of the others. It changes values by more than 1 % up to the width or cosine "
          "given. Cosine is the smaller of NoL and NoV.",
          {t}};
}

// --- On any GPU
Section on_any_gpu(const StabilityRows& all) {
  if (all.any_gpu.empty()) return {};
  Slot slot;
  for (const auto& number : unique(all.any_gpu, &AnyGpuRow::number))
    for (const auto evidence : {stability::Evidence::proved, stability::Evidence::open}) {
      std::vector<AnyGpuRow> rows;
      for (const auto& r : all.any_gpu)
        if (r.number == number && r.evidence == evidence) rows.push_back(r);
      std::ranges::stable_sort(rows, {}, [](const auto& r) { return r.proved_rel.value_or(0); });
      Table t{columns("form|given|>error at most|1 %|a value|over|why not"), {}, dense};
      for (const auto& r : rows) {
        auto domain = r.domain;
        if (const auto at = domain.find("sin2_theta_h"); at != domain.npos)
          domain.replace(at, 12, "sin²θ_h");
        t.add(form_cell(r.id), given(r.form), error_cell(r.proved_rel),
              r.keeps ? "kept" : "not proved", r.finite ? "always" : "not proved", domain,
              r.why.empty() ? "–" : r.why);
      }
      if (!t.rows.empty())
        slot.each.push_back(
            {{number, evidence == stability::Evidence::proved ? "with a bound" : "open"},
             {std::move(t)}});
    }
  return {"On any GPU",
          "Proved for every GPU that keeps Vulkan 1.4, in all cases that Vulkan leaves open: "
          "rounding up or down, division within 2.5 units, subnormals kept or dropped. The shader "
          "declares no float controls, and its expressions are “precise”, so that nothing is fused "
          "or reordered. Domains are smaller than the hard one.",
          {tables({{"number", "Number"}, {"bound", "Forms"}}, std::move(slot))}};
}

// --- Without precise
Section in_other_orders(const StabilityRows& all) {
  if (all.orders.empty()) return {};
  Slot slot;
  for (const auto& number : unique(all.orders, &OrderRow::number)) {
    std::vector<OrderRow> rows;
    for (const auto& r : all.orders)
      if (r.number == number) rows.push_back(r);
    std::ranges::stable_sort(rows, std::greater{}, &OrderRow::regrouped);
    Table t{
        columns("form|given|>as written|>regrouped|>times|>no value|>values lost|needs precise"),
        {},
        dense};
    for (const auto& r : rows)
      t.add(form_cell(r.id), given(r.form), error_cell(r.written), error_cell(r.regrouped, r.at),
            r.written > 0 ? significant(r.regrouped / r.written, 2) : "–", count_cell(r.no_value),
            count_cell(r.lost), r.needs_precise() ? "yes" : "no");
    slot.each.push_back({{number}, {std::move(t)}});
  }
  return {"What a compiler costs that regroups",
          "Without the word “precise” a compiler may add and multiply in any order, and replace a "
          "quotient by a product with the reciprocal. Each form was computed in sixteen orders "
          "drawn at random. Other liberties, such as taking factors out, may cost more. A form "
          "needs the word where it keeps the tolerance as it is written, 0.0001 in float and 2 % "
          "in half, and in some order it does not. Domains are those of the section above.",
          {tables({{"number", "Number"}}, std::move(slot))}};
}

// --- Targets
Section missed(const StabilityRows& all) {
  struct Missed {
    std::string id, reason;
    std::vector<std::string> numbers;
    double worst, beyond;
  };
  std::vector<Missed> groups;
  for (const auto& r : all.rows) {
    if (!r.misses) continue;
    auto at = std::ranges::find_if(
        groups, [&](const Missed& g) { return g.id == r.id && g.reason == r.reason; });
    if (at == groups.end()) at = groups.insert(at, {r.id, r.reason, {}, 0, 0});
    if (std::ranges::find(at->numbers, r.number) == at->numbers.end())
      at->numbers.push_back(r.number);
    if (r.worst_rel > at->worst) at->worst = r.worst_rel;
    if (r.ulp_beyond > at->beyond) at->beyond = r.ulp_beyond;
  }
  if (groups.empty()) return {};
  Table t{columns("form|in|>worst|>units beyond its inputs|because"), {}, dense};
  for (const auto& g : groups)
    t.add(form_cell(g.id), fmt::format("{}", fmt::join(g.numbers, ", ")), error_cell(g.worst),
          significant(g.beyond, 2), Cell{g.reason, {}, {}, "reason"});
  return {"What misses its target, and why",
          "Targets: in float and double 8 units of the last digit beyond what a unit of the inputs "
          "is worth there, and a value that is not negative; in half and mixed numbers 2 % from "
          "alpha 0.05 on, for other forms everywhere.",
          {t}};
}

// --- Everything
Section every_form(const StabilityRows& all) {
  Slot slot;
  const auto kind_of = [](const StabilityRow& r) { return r.id.substr(0, r.id.find('.')); };
  for (const auto& kind : unique(all.rows, kind_of))
    for (const auto& number : unique(all.rows, &StabilityRow::number)) {
      Table t{columns("form|given|>worst|>ulp|>condition there|>ulp beyond it|half "
                      "raised|>proved|>no value|>negative|>overflow|>vanished|>wrong "
                      "way|>irreciprocal|safe from|>looked at|by"),
              {},
              dense};
      for (const auto& r : all.rows)
        if (r.number == number && kind_of(r) == kind)
          t.add(form_cell(r.id), given(r.form), error_cell(r.worst_rel, place(r)),
                significant(r.worst_ulp, 2), significant(r.condition, 2),
                significant(r.ulp_beyond, 2), r.flags.empty() ? "–" : r.flags,
                error_cell(r.proved_rel), count_cell(r.nonfinite, r.nonfinite_at),
                count_cell(r.negative), count_cell(r.overflow), count_cell(r.vanished),
                count_cell(r.not_monotone), count_cell(r.irreciprocal),
                r.decides.empty() ? "–"
                : r.safe_from     ? r.decides + " " + rounded_up(*r.safe_from)
                                  : "nowhere",
                count_text(r.evaluations),
                evidence_text(r.evidence) + (r.settled ? "" : ", not settled"));
      if (!t.rows.empty()) slot.each.push_back({{kind, number}, {std::move(t)}});
    }
  return {"Every form in every number",
          "Over the hard domain: alpha from 10⁻⁶, cosines from 10⁻⁸, extinction up to 1000. “Every "
          "input”: each half there is was evaluated. “Search”: the worst that seeds and climbing "
          "found from two starts; there may be worse. Results below 2⁻⁶⁴, 5·10⁻²⁰, count as black "
          "in float, double and mixed numbers, and errors below a half's least normal number are "
          "measured against that, which “worst” leaves out. A Fresnel term in half or mixed "
          "numbers keeps 0.002 absolute, since "
          "it may be next to 0. Vanished: 0 where a value should be. Wrong way: neighbours "
          "between which the value rises where it should fall. Irreciprocal: another value with "
          "light and view exchanged. Half raised: flags on the way to the worst input.",
          {tables({{"kind", "Kind"}, {"number", "Number"}}, std::move(slot))}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

const StabilityRow* better_form(const std::vector<StabilityRow>& all, const StabilityRow& r) {
  const auto at = std::ranges::find_if(all, [&](const StabilityRow& x) {
    return x.number == r.number && x.form == "cross" &&
           x.id == (r.stable.empty() ? r.id : r.stable);
  });
  const bool better =
      at != all.end() && at->safe_from && (!r.safe_from || *at->safe_from < *r.safe_from);
  return better ? &*at : nullptr;
}

page::Page report_page(const StabilityReport& r) {
  using namespace page;
  Page out{"stability", "report stability", "Numerical stability",
           "Which formulas stay stable in few bits", r.findings.sentences};
  out.full = r.full;
  out.first = opening(r.pictures, "error_by_alpha", {{"number", "half"}}, 340);
  out.sections = {clamp_question(r.rows), by_alpha(r.pictures), where(r.pictures),
                  clamps(r.rows),         on_any_gpu(r.rows),   in_other_orders(r.rows),
                  missed(r.rows),         every_form(r.rows)};
  out.setting = "Truths are computed in double, the worst of them again in fifty digits.";
  out.most_shipped = {"ggx", "ggx.mobile", "beckmann", "gtr", "schlick", "smith_ggx.correlated"};
  return out;
}

}  // namespace gonio
