// The report on Schlick's approximation in sentences: made from its figures alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "optics/refractive_index.h"
#include "reports/finding/words.h"
#include "reports/schlick/claims.h"
#include "reports/schlick/schlick.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr std::string_view schlick = "fresnel.schlick", ue = "fresnel.schlick.ue",
                           gaussian = "fresnel.schlick.spherical_gaussian",
                           outer = "fresnel.schlick, outer angle",
                           linear = "fresnel.linear.as_written";

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
std::string at(const FresnelRow& r) {
  return fmt::format("{:.3g} ({} at {:.3g}°)", r.max_abs, r.name, r.max_abs_theta_deg);
}

void below_one_percent(Findings& to, const SchlickRows& r) {
  const auto outside = by_index(r, "dielectric", schlick), metals = rows_with(r, "metal", schlick);
  const auto* g = glass(outside);
  if (!g || metals.empty()) return;
  const auto within = [](const FresnelRow& x) { return x.max_abs < 0.01; };
  const auto relative = [](const FresnelRow& x) { return x.max_rel < 0.01; };
  to.headline = fmt::format(
      "Schlick's F of glass is off by up to {:.2g}, towards the rim; of a metal by up to {:.2g}.",
      g->max_abs, worst(metals)->max_abs);
  const std::size_t some = how_many(outside, within), channels = how_many(metals, within),
                    all = outside.size() + metals.size();
  to.judge(
      "Schlick's error is below 1 %", "seed 000, Schlick's approximation",
      verdict(some + channels == all, 2 * (some + channels) > all),
      fmt::format("glass: up to {:.2g} of full light, {} of F", g->max_abs, percent(g->max_rel, 2)),
      fmt::format("for glass (IOR 1.5) F is off by up to {:.3g} at "
                  "{:.3g}°, and by {} of itself at {:.3g}°; within 0.01 it stays up to {:.3g}°; "
                  "RMS over the "
                  "angle {:.3g}. At all angles it stays below 0.01 for {} indices from {:g} to "
                  "{:g} and for {} "
                  "channels of metals; within 1 % of the exact F it stays for {} of them all.",
                  g->max_abs, g->max_abs_theta_deg, percent(g->max_rel), g->max_rel_theta_deg,
                  g->within_deg, g->rms, of_all(some, outside.size()), index(*outside.front()),
                  index(*outside.back()), of_all(channels, metals.size()),
                  of_all(how_many(outside, relative) + how_many(metals, relative), all)));
}

void only_near_one(Findings& to, const SchlickRows& r) {
  const auto outside = by_index(r, "dielectric", schlick), metals = rows_with(r, "metal", schlick);
  const auto *g = glass(outside), *best = least(outside), *metal = worst(metals);
  if (!g || !metal) return;
  constexpr double poor = 0.05;
  Rows good;
  std::ranges::copy_if(outside, std::back_inserter(good),
                       [](const FresnelRow* x) { return x->max_abs < poor; });
  const auto &low = *outside.front(), &high = *outside.back();
  const bool near = low.max_abs > poor, only = near && high.max_abs < poor && metal->max_abs < poor;
  to.judge(
      "Schlick is accurate enough; only near IOR 1 is it poor",
      "seed 001, Disney's Fresnel term of 2015", verdict(only, near),
      fmt::format("up to {:.2g} for {}", metal->max_abs, metal->material),
      fmt::format(
          "its greatest error "
          "is {:.3g} at IOR {:g}, {:.3g} at IOR {:g}, where it is least, and {:.3g} at IOR {:g}; "
          "{}. "
          "For {} channels of metals it is greater than for glass, at worst {}.",
          low.max_abs, index(low), best->max_abs, index(*best), high.max_abs, index(high),
          good.empty() ? fmt::format("nowhere is it below {:g}", poor)
                       : fmt::format("it is below {:g} from IOR {:g} to {:g}", poor,
                                     index(*good.front()), index(*good.back())),
          of_all(how_many(metals, [&](const FresnelRow& x) { return x.max_abs > g->max_abs; }),
                 metals.size()),
          at(*metal)));
}

void from_inside(Findings& to, const SchlickRows& r) {
  const auto inside = by_index(r, "dielectric_inside", schlick),
             there = by_index(r, "dielectric_inside", outer);
  const auto *g = glass(inside), *o = glass(there);
  if (!g || !o) return;
  to.say(
      fmt::format("From inside, asked at the angle within the medium, Schlick knows no total "
                  "reflection: glass is "
                  "off by {:.3g} at {:.3g}°, the worst by {}. Asked at the angle outside, and 1 "
                  "beyond, it is as "
                  "good as from outside: {:.3g} for glass.",
                  g->max_abs, g->max_abs_theta_deg, at(*worst(inside)), o->max_abs));
}

void metal_forms(Findings& to, const SchlickRows& r) {
  struct Form {
    std::string name;
    double median;
    const FresnelRow* worst;
  };
  std::map<std::string, Rows> by_form;
  for (const auto& row : r.smooth)
    if (row.kind == "metal") by_form[row.form].push_back(&row);
  std::vector<Form> forms;
  std::vector<std::string> exact;
  for (auto& [form, rows] : by_form) {
    const std::string name = form.substr(form.find('.') + 1);
    if (worst(rows)->max_abs < 1e-9) {
      exact.push_back(name);
      continue;
    }
    std::ranges::sort(rows, {}, &FresnelRow::rms);
    forms.push_back({name, rows[rows.size() / 2]->rms, worst(rows)});
  }
  if (forms.empty()) return;
  std::ranges::stable_sort(forms, {}, &Form::median);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    // forms that come to the same for metals are named together
    const auto& f = forms[i];
    const bool same = i + 1 < forms.size() && forms[i + 1].median - f.median < 1e-9 &&
                      std::abs(forms[i + 1].worst->max_abs - f.worst->max_abs) < 1e-9;
    if (same)
      forms[i + 1].name = fmt::format("{} = {}", f.name, forms[i + 1].name);
    else
      parts.push_back(
          fmt::format("{} {:.2g} (at most {:.2g})", f.name, f.median, f.worst->max_abs));
  }
  to.say(fmt::format(
      "Metals, RMS of the median channel: {}{}. F82 has its tint from the exact value at 82°, F90 "
      "and Lazányi's correction are fitted.",
      fmt::join(parts, ", "),
      exact.empty() ? ""
                    : fmt::format("; the exact one in other words: {}", fmt::join(exact, ", "))));
}

void variants(Findings& to, const SchlickRows& r) {
  const auto a = by_index(r, "dielectric", schlick), b = by_index(r, "dielectric", ue),
             c = by_index(r, "dielectric", gaussian), d = by_index(r, "dielectric", linear);
  if (a.empty() || a.size() != b.size() || a.size() != c.size() || !glass(d)) return;
  std::size_t differs = a.size();  // the last index where Unreal's is another
  double apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i]->max_abs - b[i]->max_abs) > 1e-6) differs = i;
    apart = std::max(apart, c[i]->max_abs - a[i]->max_abs);
  }
  const std::string of_ue =
      differs == a.size()
          ? "is Schlick's at every index"
          : fmt::format(
                "is another up to IOR {:g} alone, where F0 is below 0.02: there the grazing "
                "reflection is lost, and it is off by {} in place of {:.3g}",
                index(*a[differs]), at(*worst(b)),
                a[static_cast<std::size_t>(std::ranges::find(b, worst(b)) - b.begin())]->max_abs);
  to.say(
      fmt::format("Unreal Engine's 50 F0_g {}. The spherical Gaussian adds {:.1g} to Schlick's "
                  "greatest error at "
                  "most. The linear form is off by {:.2g} for glass.",
                  of_ue, apart, glass(d)->max_abs));
}

void rough_surfaces(Findings& to, const SchlickRows& r) {
  struct Worst {
    double off = 0;
    std::string where;
  };
  Worst of_glass, of_metal;
  for (const auto& a : r.rough.albedos) {
    if (a.form != schlick) continue;
    auto& w = a.material == "IOR 1.5" ? of_glass : of_metal;
    if (a.channel.empty() && a.material != "IOR 1.5") continue;
    for (std::size_t i = 0; i < a.albedo.size(); ++i)
      if (const double off = a.albedo[i] / a.exact[i] - 1; std::abs(off) > std::abs(w.off))
        w = {off, (a.channel.empty() ? "" : fmt::format("{}, {}, ", a.material, a.channel)) +
                      place(r.rough.roughness[i], a.mu)};
  }
  if (of_glass.off == 0 || of_metal.off == 0) return;
  // over metals, as what is seen
  std::map<std::string, Worst> differences;
  for (const auto& c : r.rough.colours)
    for (std::size_t i = 0; i < c.delta_e.size(); ++i)
      if (auto& w = differences[c.form]; !c.material.starts_with("IOR ") && c.delta_e[i] > w.off)
        w = {c.delta_e[i], fmt::format("{}, {}", c.material, place(r.rough.roughness[i], c.mu))};
  std::vector<std::string> seen;
  for (const auto form :
       {schlick, std::string_view("fresnel.f82"), std::string_view("fresnel.lazanyi, corrected")})
    if (const auto it = differences.find(std::string(form)); it != differences.end())
      seen.push_back(fmt::format("{} {:.2g} ({})", form.substr(form.find('.') + 1), it->second.off,
                                 it->second.where));
  to.say(
      fmt::format("With Schlick in place of the exact F the albedo of rough GGX is off most by {} "
                  "for glass ({}) "
                  "and by {} for metals ({}). As a colour, ΔE2000 of metals is at most: {}.",
                  percent(of_glass.off), of_glass.where, percent(of_metal.off), of_metal.where,
                  fmt::join(seen, "; ")));
}

void three_wavelengths(Findings& to, const SchlickRows& r) {
  std::set<std::string> metals;
  for (const auto& row : r.smooth)
    if (row.kind == "metal") metals.insert(row.material);
  std::size_t dearer = 0;
  Rows short_cuts;
  for (const auto& m : metals) {
    const auto of = [&](std::string_view form) {
      auto rows = rows_with(r, "spectral", form);
      std::erase_if(rows, [&](const FresnelRow* x) { return x->material != m; });
      return worst(rows);
    };
    const auto *short_cut = of("fresnel.conductor, three wavelengths"), *approximate = of(schlick);
    if (!short_cut || !approximate) return;
    short_cuts.push_back(short_cut);
    dearer += short_cut->max_abs > approximate->max_abs;
  }
  if (short_cuts.empty()) return;
  to.say(fmt::format(
      "Against the spectrum's colour in linear RGB, the exact equation at three wavelengths is off "
      "by up to {}; for {} metals that is more than Schlick with the spectrum's colour as F0.",
      at(*worst(short_cuts)), of_all(dearer, metals.size())));
}

/// F0 of what lies in the tables of refractive indices, at 550 nm or by channel.
void ranges_of_f0(Findings& to) {
  struct Value {
    std::string name;
    double f0;
  };
  std::vector<Value> dielectric, metal;
  for (const auto& m : dielectrics())
    dielectric.push_back({std::string(m.name), f0_of_index(m.at(550))});
  static constexpr std::array channels{"red", "green", "blue"};
  for (const auto& m : metals())
    for (std::size_t c = 0; c < channels.size(); ++c)
      metal.push_back({fmt::format("{}, {}", m.name, channels[c]), f0_of_index(m.rgb()[c])});
  const auto within = [](const std::vector<Value>& all, double low, double high) {
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [&](const Value& v) { return low <= v.f0 && v.f0 <= high; }));
  };
  const auto span = [](const std::vector<Value>& all) {
    const auto [low, high] = std::ranges::minmax_element(all, {}, &Value::f0);
    return fmt::format("from {:.3f} ({}) to {:.3f} ({})", low->f0, low->name, high->f0, high->name);
  };
  const std::size_t d = within(dielectric, 0.02, 0.04), m = within(metal, 0.7, 1);
  to.judge(
      "dielectrics have F0 0.02 to 0.04, metals 0.7 to 1.0", "seed 001, Fresnel reflectance",
      verdict(d == dielectric.size() && m == metal.size(),
              2 * (d + m) > dielectric.size() + metal.size()),
      fmt::format("{} measured materials lie there",
                  of_all(d + m, dielectric.size() + metal.size())),
      fmt::format("of the measured materials here {} dielectrics and {} channels of metals lie "
                  "there; F0 goes {} and {}.",
                  of_all(d, dielectric.size()), of_all(m, metal.size()), span(dielectric),
                  span(metal)));
}

}  // namespace

Findings findings(const SchlickRows& r) {
  Findings all;
  below_one_percent(all, r);
  only_near_one(all, r);
  ranges_of_f0(all);
  from_inside(all, r);
  metal_forms(all, r);
  variants(all, r);
  rough_surfaces(all, r);
  three_wavelengths(all, r);
  judge_what_stands_beside_f(all, r);
  return all;
}

}  // namespace gonio
