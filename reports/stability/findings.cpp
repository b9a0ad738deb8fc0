// The atlas in sentences: made from its rows alone.
#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "brdf/catalogue/registry.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/stability/measure.h"
#include "stability/prove_relative.h"
#include "stability/search.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using stability::without_gappa;

using Rows = std::vector<const StabilityRow*>;

const StabilityRow* find(const StabilityRows& r,
                         std::string_view id,
                         std::string_view form,
                         std::string_view number) {
  const auto at = std::ranges::find_if(r.rows, [&](const StabilityRow& row) {
    return row.id == id && row.form == form && row.number == number;
  });
  return at == r.rows.end() ? nullptr : &*at;
}
Rows in_number(const StabilityRows& r, std::string_view number) {
  Rows out;
  for (const auto& row : r.rows)
    if (row.number == number) out.push_back(&row);
  return out;
}

/// "alpha 0.036", "no alpha"
std::string from_text(const StabilityRow& r) {
  return r.safe_from ? fmt::format("{} {}", r.decides, rounded_up(*r.safe_from))
                     : "no " + r.decides;
}
/// Doubt that a search leaves, which refutes and does not establish.
std::string_view evidence_text(const StabilityRow& r) {
  return r.evidence == stability::Evidence::searched ? ", as far as a search found" : "";
}
/// "errors up to 3.6 %", "values up to 3900 times too large"
std::string worst_text(double relative) {
  if (relative <= 1) return fmt::format("errors up to {}", percent_at_most(relative));
  if (relative > 1e6) return "values more than a million times too large";
  const double unit = std::pow(10, std::floor(std::log10(relative)) - 1);
  return fmt::format("values up to {:g} times too large", std::round((1 + relative) / unit) * unit);
}

/// Which alpha a distribution may be clamped to, in half.
void which_alpha(Findings& to, const StabilityRows& r) {
  const auto* cross = find(r, "ndf.ggx", "cross", "half");
  if (!cross) return;
  const auto* flushed = find(r, "ndf.ggx", "cross", "half, flushed");
  to.say(
      fmt::format("In half precision, D of GGX is off by at most {} for {} or more, if the shader "
                  "computes |n × h|²{}.",
                  percent(cross->tolerance, 1), from_text(*cross),
                  flushed ? " and the processor keeps subnormals" : ""));
  std::string answer;
  if (flushed)
    answer =
        fmt::format("Where the processor flushes subnormals, D needs {}. ", from_text(*flushed));
  if (const auto& from = (flushed ? flushed : cross)->safe_from)
    answer += fmt::format("A clamp there changes only surfaces of a roughness below {}.",
                          rounded_up(std::sqrt(*from)));
  if (!answer.empty()) to.say(std::move(answer));
  if (const auto* mobile = find(r, "ndf.ggx.mobile", "cosine", "mixed"))
    to.say(
        fmt::format("With NoH rounded to half in the place of |n × h|², and the rest in float, D "
                    "stays within it from "
                    "{} on{}.",
                    from_text(*mobile), evidence_text(*mobile)));
  for (const auto& h : r.highlights)
    if (h.number == "half" && h.safe_from && h.finite_from && cross->safe_from) {
      to.say(
          fmt::format("The whole highlight on metal (F0 from {:g}), D V F and then NoL, stays "
                      "within {} in half from "
                      "alpha {} on, as far as a search found.",
                      h.least_f0, percent(h.tolerance, 2), rounded_up(*h.safe_from)));
      to.say(fmt::format("That is for light and view up to {:.0f}°.", h.zenith_deg));
      to.say(fmt::format("Below alpha {} the product is too large for half.",
                         rounded_up(*h.finite_from)));
    }
  struct Named {
    std::string_view name, id, form;
  };
  static constexpr Named others[] = {
      {"Beckmann from |n × h|²", "ndf.beckmann", "cross"},
      {"Blinn–Phong from |n × h|²", "ndf.blinn_phong", "cross"},
      {"GTR of all gammas from |n × h|²", "ndf.gtr", "cross"},
      {"The mobile form with a cross product", "ndf.ggx.mobile.cross", "cross"},
      {"The mobile form from NoH", "ndf.ggx.mobile", "cosine"},
      {"Unreal's mobile GGX", "ndf.ggx.ue_mobile", "cosine"}};
  for (const auto& o : others)
    if (const auto* row = find(r, o.id, o.form, "half")) {
      // All but the whole range is lost: what matters is by how much.
      const bool nowhere = !row->safe_from || *row->safe_from > 0.9;
      const auto keeps = percent(row->tolerance, 1);
      if (nowhere)
        to.say(fmt::format("{} in half does not stay within {}: {} there are {}{}.", o.name, keeps,
                           row->worst_from_usual ? "even from alpha 0.05 on" : "somewhere",
                           worst_text(row->worst_from_usual.value_or(row->worst_rel)),
                           evidence_text(*row)));
      else {
        // Half's NoH is taken for exact: its own rounding is that of mixed numbers.
        std::string given = o.form == "cosine" ? ", of a NoH that half holds" : "";
        if (const auto* if_flushed = find(r, o.id, o.form, "half, flushed");
            if_flushed && if_flushed->safe_from.value_or(1) > 2 * *row->safe_from)
          given += ", if the processor keeps subnormals";
        to.say(fmt::format("{} in half stays within {} {}{}{}.", o.name, keeps,
                           *row->safe_from < 1e-5 ? std::string("for every alpha")
                                                  : fmt::format("from {} on", from_text(*row)),
                           given, evidence_text(*row)));
      }
    }
}

void without_a_value(Findings& to, const StabilityRows& r) {
  for (const std::string_view number : {"half", "float", "double"}) {
    const auto all = in_number(r, number);
    if (all.empty()) continue;
    const auto fails = static_cast<std::size_t>(std::ranges::count_if(
        all, [](const StabilityRow* row) { return row->nonfinite + row->overflow > 0; }));
    std::set<std::string_view> formulas;
    for (const auto* row : all) formulas.insert(row->id);
    const auto proved = static_cast<std::size_t>(std::ranges::count_if(
        all, [](const StabilityRow* row) { return row->finite_from.has_value(); }));
    to.say(
        fmt::format("In {}, {} ways to compute {} formulas give no value, or infinity, for some "
                    "inputs. From some alpha, F0 or index on, a value is proved for every input of "
                    "{}.",
                    number, of_all(fails, all.size()), formulas.size(), number_or_none(proved)));
  }
}

/// Sentences on what is proved under all that Vulkan allows a GPU.
void any_gpu(Findings& to, const StabilityRows& r) {
  const auto find = [&](std::string_view id, std::string_view form, std::string_view number) {
    const auto at = std::ranges::find_if(r.any_gpu, [&](const AnyGpuRow& row) {
      return row.id == id && row.form == form && row.number == number;
    });
    return at == r.any_gpu.end() ? nullptr : &*at;
  };
  for (const std::string_view number : {"float", "half"}) {
    std::size_t all = 0, keep = 0;
    for (const auto& row : r.any_gpu) {
      if (row.number != number) continue;
      if (row.why == without_gappa) {
        to.say(fmt::format("No error is proved on any GPU: {} here.", without_gappa));
        return;
      }
      ++all;
      if (row.keeps) ++keep;
    }
    if (all == 0) continue;
    std::string text = fmt::format("On any GPU {} in {} is proved for {} forms.",
                                   percent(any_gpu_tolerance, 1), number, of_all(keep, all));
    const auto bound = [&](const char* form) -> std::optional<double> {
      const auto* row = find("ndf.ggx", form, number);
      return row ? row->proved_rel : std::nullopt;
    };
    const auto cross = bound("cross"), cosine = bound("cosine");
    if (cross)
      text += fmt::format(" GGX from |n × h|² errs by {} at most", percent_at_most(*cross));
    if (cross && cosine)
      text += fmt::format("; only from NoH, {} is all that is proved.", percent_at_most(*cosine));
    else if (cross)
      text += "; only from NoH, nothing is proved.";
    to.say(std::move(text));
  }
}

/// Sentences on forms that a compiler which regroups moves beyond the tolerance.
void orders(Findings& to, const StabilityRows& r) {
  for (const Number number : {Number::float_, Number::half}) {
    std::size_t all = 0, need = 0;
    const OrderRow* worst = nullptr;
    for (const auto& row : r.orders) {
      if (row.number != name_of(number)) continue;
      ++all;
      if (!row.needs_precise()) continue;
      ++need;
      if (!worst || row.regrouped > worst->regrouped) worst = &row;
    }
    if (all == 0) continue;
    const auto keeps = percent(stability::usual_tolerance(number), 1);
    to.say(fmt::format(
        "A compiler that regroups sums and products takes {}'s {} from {} forms, over inputs on "
        "which they keep it as written.",
        name_of(number), keeps, of_all(need, all)));
    if (!worst) continue;
    to.say(worst->lost > 0 ? std::string("The worst of them even loses values.")
                           : fmt::format("The worst of them errs by {} in place of {}.",
                                         percent(worst->regrouped, 2), percent(worst->written, 2)));
  }
}

/// "0.0022", and of less "0.00000006", which is read as one number.
std::string small_text(double x) {
  if (x >= 1e-4) return fmt::format("{:.2g}", x);
  return fmt::format("{:.{}f}", x, static_cast<int>(std::ceil(-std::log10(x))));
}

void clamps(Findings& to, const StabilityRows& r) {
  for (const auto& c : r.clamps) {
    if (c.number != "half") continue;
    const auto up_to = [&](const std::optional<double>& x) {
      return x ? fmt::format("up to {} {}", c.by, small_text(*x)) : std::string("nowhere");
    };
    const auto without = up_to(c.no_value_without), with = up_to(c.no_value_with);
    const auto missing =
        with == without ? fmt::format("values are missing {}, with it or without", without)
        : !c.no_value_with
            ? fmt::format("without it values are missing {}, with it nowhere", without)
            : fmt::format("values are missing {}", with);
    auto form = in_text(c.where);
    std::ranges::replace(form, '_', ' ');
    to.say(fmt::format("{} in half, in {}: {}. It changes values by more than 1\u00a0% {}.",
                       c.clamp, form, missing, up_to(c.changed_to)));
  }
}

}  // namespace

Findings findings(const StabilityRows& r) {
  Findings f;
  which_alpha(f, r);
  without_a_value(f, r);
  any_gpu(f, r);
  orders(f, r);
  clamps(f, r);
  stabilities::judge_f_and_g_in_half(f, r);
  return f;
}

}  // namespace gonio
