// The report on Schlick's approximation in sentences: made from its figures alone.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "optics/refractive_index.h"
#include "optics/spectrum.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/schlick/claims.h"
#include "reports/schlick/schlick.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view ue = "fresnel.schlick.ue",
                           gaussian = "fresnel.schlick.spherical_gaussian",
                           outer = "fresnel.schlick, outer angle";

using Rows = std::vector<const FresnelRow*>;

Rows rows_with(const SchlickRows& r, std::string_view kind, std::string_view form) {
  Rows out;
  for (const auto& row : r.smooth)
    if (row.kind == kind && row.form == form) out.push_back(&row);
  return out;
}
/// Rows of the indices that are gone through, ascending.
Rows by_index(const SchlickRows& r, std::string_view kind, std::string_view form) {
  auto out = rows_with(r, kind, form);
  std::erase_if(out, [](const FresnelRow* row) { return !row->name.starts_with("IOR "); });
  return out;
}
double index(const FresnelRow& r) {
  return std::max(r.eta, 1 / r.eta);
}
const FresnelRow* worst(const Rows& rows) {
  return rows.empty() ? nullptr : *std::ranges::max_element(rows, {}, &FresnelRow::max_abs);
}
const FresnelRow* least(const Rows& rows) {
  return rows.empty() ? nullptr : *std::ranges::min_element(rows, {}, &FresnelRow::max_abs);
}
const FresnelRow* glass(const Rows& rows) {
  const auto it = std::ranges::find(rows, "IOR 1.5", &FresnelRow::name);
  return it == rows.end() ? nullptr : *it;
}
std::size_t how_many(const Rows& rows, const std::function<bool(const FresnelRow&)>& what) {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [&](const FresnelRow* r) { return what(*r); }));
}

void below_one_percent(Findings& to, const SchlickRows& r) {
  const auto outside = rows_with(r, "dielectric", form_id::schlick),
             metals = rows_with(r, "metal", form_id::schlick);
  const auto* g = glass(outside);
  if (!g || metals.empty()) return;
  const auto within = [](const FresnelRow& x) { return x.max_abs < 0.01; };
  const std::size_t some = how_many(outside, within) + how_many(metals, within),
                    all = outside.size() + metals.size();
  to.judge(
      "Schlick's error is below 1 %", "", verdict(some == all, 2 * some > all),
      fmt::format("glass: absolute error up to {}, relative error up to {}", rounded_up(g->max_abs),
                  percent_at_most(g->max_rel)),
      fmt::format("{} IORs of dielectrics and channels of metals are within 0.01 at all angles.",
                  of_all(some, all)));
}

void only_near_one(Findings& to, const SchlickRows& r) {
  const auto outside = by_index(r, "dielectric", form_id::schlick),
             metals = rows_with(r, "metal", form_id::schlick);
  const auto *best = least(outside), *metal = worst(metals);
  if (!glass(outside) || !metal) return;
  constexpr double poor = 0.05;
  const auto &low = *outside.front(), &high = *outside.back();
  const bool near = low.max_abs > poor, only = near && high.max_abs < poor && metal->max_abs < poor;
  to.judge("Schlick is accurate enough; near a relative IOR of 1 its error is larger",
           "Disney, SIGGRAPH 2015", verdict(only, near),
           fmt::format("absolute error up to {} at IOR {:g}, {} for {}", rounded_up(low.max_abs),
                       index(low), rounded_up(metal->max_abs), metal->material),
           fmt::format("from IOR {:g} on the error grows again, to {} at IOR {:g}.", index(*best),
                       rounded_up(high.max_abs), index(high)));
}

void from_inside(Findings& to, const SchlickRows& r) {
  const auto *inside = glass(by_index(r, "dielectric_inside", form_id::schlick)),
             *there = glass(by_index(r, "dielectric_inside", outer));
  if (!inside || !there) return;
  to.say(fmt::format(
      "Inside glass (IOR 1.5) Schlick is off by up to {}, where total reflection begins; asked "
      "at the angle outside, by up to {}.",
      rounded_up(inside->max_abs), rounded_up(there->max_abs)));
}

/// The form for metals with the least RMS of the median channel, beside Schlick.
void metal_forms(Findings& to, const SchlickRows& r) {
  struct Form {
    std::string_view form;
    double median;
  };
  std::map<std::string_view, std::vector<double>> by_form;
  for (const auto& row : r.smooth)
    if (row.kind == "metal") by_form[row.form].push_back(row.rms);
  std::optional<Form> best, plain;
  std::vector<std::string> same;
  for (auto& [form, rms] : by_form) {
    std::ranges::sort(rms);
    const Form f{form, rms[rms.size() / 2]};
    if (form == form_id::schlick) plain = f;
    if (rms.back() < 1e-9) {  // exact, in other words
      same.push_back(in_text(form));
      continue;
    }
    if (!best || f.median < best->median) best = f;
  }
  if (!best || !plain || best->form == form_id::schlick) return;
  to.say(fmt::format(
      "Among the forms that approximate smooth metals {} is nearest: its RMS over the angle is "
      "{:.2g} for the median channel, Schlick's {:.2g}.",
      in_text(best->form), best->median, plain->median));
  if (!same.empty())
    to.say(
        fmt::format("The exact equation in other parameters has no error where a channel has one n "
                    "and one k: {}.",
                    list_text(same)));
}

void variants(Findings& to, const SchlickRows& r) {
  const auto a = by_index(r, "dielectric", form_id::schlick), b = by_index(r, "dielectric", ue),
             c = by_index(r, "dielectric", gaussian);
  if (a.empty() || a.size() != b.size() || a.size() != c.size()) return;
  std::size_t differs = a.size();  // the last index where Unreal's is another
  double apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i]->max_abs - b[i]->max_abs) > 1e-6) differs = i;
    apart = std::max(apart, c[i]->max_abs - a[i]->max_abs);
  }
  to.say(
      differs == a.size()
          ? "Unreal's form of Schlick is Schlick's at every index."
          : fmt::format("Unreal's form of Schlick loses grazing reflection up to IOR {:g}. It is "
                        "off most at IOR {:g}, by up to {}.",
                        index(*a[differs]), index(*worst(b)), rounded_up(worst(b)->max_abs)));
  to.say(fmt::format("The spherical Gaussian adds at most {} to Schlick's greatest error.",
                     rounded_up(apart, 1)));
}

struct Seen {
  double delta_e = 0;
  std::string_view material{};
};
/// The greatest ΔE2000 of a form, over roughness and views.
/// \param material  that one alone; empty: every metal, or glass
Seen most_seen(const SchlickRows& r,
               std::string_view form,
               bool metals,
               std::string_view material = {}) {
  Seen most;
  for (const auto& c : r.rough.colours) {
    const bool metal = !c.material.starts_with("IOR ");
    if (c.form != form || c.delta_e.empty() || metal != metals ||
        (!metal && c.material != "IOR 1.5") || (!material.empty() && c.material != material))
      continue;
    if (const double e = *std::ranges::max_element(c.delta_e); e > most.delta_e)
      most = {e, c.material};
  }
  return most;
}

/// What is seen of it: the answer to whether it is enough.
void rough_surfaces(Findings& to, const SchlickRows& r) {
  const auto of_glass = most_seen(r, form_id::schlick, false),
             of_metal = most_seen(r, form_id::schlick, true);
  if (of_glass.delta_e == 0 || of_metal.delta_e == 0) return;
  to.headline = fmt::format(
      "With Schlick in place of exact Fresnel, rough glass (IOR 1.5) is off by up to ΔE2000 {}, "
      "and the worst metal, {}, by up to {}.",
      rounded_up(of_glass.delta_e), of_metal.material, rounded_up(of_metal.delta_e));
  to.say(to.headline);
  for (const auto& [form, words] :
       {std::pair<std::string_view, std::string_view>{"fresnel.f82", "F82"},
        {"fresnel.conductor, three wavelengths", "The exact equation at three wavelengths"}})
    if (const auto other = most_seen(r, form, true); other.delta_e > 0)
      to.say(
          fmt::format("{} changes rough metals by up to ΔE2000 {} ({}). Schlick with the colour as "
                      "F0 changes that metal by up to {}.",
                      words, rounded_up(other.delta_e), other.material,
                      rounded_up(most_seen(r, form_id::schlick, true, other.material).delta_e)));
  for (const auto& c : r.rough.colours)
    if (c.form == form_id::schlick && c.mu == 1 && !c.material.starts_with("IOR ") &&
        !c.delta_e.empty())
      // F0 is exact there, but for what lies beyond the gamut
      if (const double cut = *std::ranges::min_element(c.delta_e); cut > 0.5)
        to.say(
            fmt::format("The colour of {} lies beyond sRGB: cut to it, F0 by itself changes it by "
                        "ΔE2000 {} or more, seen head on.",
                        c.material, rounded_down(cut)));
  double most = 0;
  for (const auto& a : r.rough.albedos)
    if (a.form == form_id::schlick && a.material == "IOR 1.5")
      for (std::size_t i = 0; i < a.albedo.size(); ++i)
        most = std::max(most, std::abs(a.albedo[i] / a.exact[i] - 1));
  to.say(fmt::format(
      "With Schlick the albedo of rough glass (IOR 1.5) is off by up to {} at the three cosines "
      "that are shown.",
      percent_at_most(most)));
}

void three_wavelengths(Findings& to, const SchlickRows& r) {
  std::set<std::string> metals;
  for (const auto& row : r.smooth)
    if (row.kind == "metal") metals.insert(row.material);
  std::size_t dearer = 0;
  double most = 0;
  for (const auto& m : metals) {
    const auto of = [&](std::string_view form) {
      auto rows = rows_with(r, "spectral", form);
      std::erase_if(rows, [&](const FresnelRow* x) { return x->material != m; });
      return worst(rows);
    };
    const auto *short_cut = of("fresnel.conductor, three wavelengths"),
               *approximate = of(form_id::schlick);
    if (!short_cut || !approximate) return;
    most = std::max(most, short_cut->max_abs);
    dearer += short_cut->max_abs > approximate->max_abs;
  }
  if (most == 0) return;
  to.say(
      fmt::format("The exact equation at three wavelengths is off by up to {} from the "
                  "metal's colour; for {} metals Schlick with that colour is nearer.",
                  rounded_up(most), of_all(dearer, metals.size())));
}

/// F0 of what was measured, by the rows: of dielectrics at one wavelength, of metals in each channel.
void ranges_of_f0(Findings& to, const SchlickRows& r) {
  const auto judge = [&](std::string_view claim, std::string_view kind, std::string_view what,
                         double low, double high) {
    std::vector<double> all;
    for (const auto* row : rows_with(r, kind, form_id::schlick))
      if (!row->name.starts_with("IOR ")) all.push_back(f0_of_index({row->eta, row->k}));
    if (all.empty()) return;
    const auto within = static_cast<std::size_t>(
        std::ranges::count_if(all, [&](double f0) { return low <= f0 && f0 <= high; }));
    const auto [least, most] = std::ranges::minmax_element(all);
    to.judge(
        claim, "", verdict(2 * within > all.size()),
        fmt::format("{} {} lie there", of_all(within, all.size()), what),
        fmt::format("the {} measured here have F0 from {:.2g} to {:.3g}.", what, *least, *most));
  };
  judge("most non-metals have F0 0.02 to 0.04", "dielectric", "dielectrics", 0.02, 0.04);
  judge("most metals have F0 0.7 to 1.0", "metal", "channels of metals", 0.7, 1);
}

}  // namespace

Findings findings(const SchlickRows& r) {
  Findings all;
  rough_surfaces(all, r);
  three_wavelengths(all, r);
  below_one_percent(all, r);
  only_near_one(all, r);
  ranges_of_f0(all, r);
  from_inside(all, r);
  metal_forms(all, r);
  variants(all, r);
  judge_what_stands_beside_f(all, r);
  return all;
}

}  // namespace gonio
