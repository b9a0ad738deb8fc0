// The energy report in sentences: made from its figures alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/energy/distribution_claims.h"
#include "reports/energy/energy.h"
#include "reports/finding/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

/// "1 % from roughness 0.42 on, 5 % from 0.57 to 0.8, 10 % nowhere"
std::string thresholds(const std::vector<Crossing>& all, double mu) {
  std::vector<std::string> parts;
  for (const auto& c : all) {
    if (c.mu != mu) continue;
    std::vector<std::string> ranges;
    for (const auto& r : c.ranges)
      ranges.push_back(
          range_text(r.from, r.to, parts.empty() && ranges.empty() ? "roughness " : ""));
    parts.push_back(
        fmt::format("{:g}\u00a0% {}", 100 * c.share,
                    ranges.empty() ? "nowhere" : fmt::format("{}", fmt::join(ranges, " and "))));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Place where a form reflects most.
const EnergyForm::At& brightest(const EnergyForm& f) {
  return *std::ranges::max_element(f.rows, {}, &EnergyForm::At::albedo);
}

/// More than comes in is reflected somewhere, beyond its error.
bool makes_light(const EnergyForm& f) {
  const auto& at = brightest(f);
  return at.albedo - at.error > 1 + 1e-6;
}

/// Findings from the rows, beside the claims.
void measured(Findings& to, const EnergyRows& r) {
  if (const auto* f = find_form(r.forms, "masking.smith_ggx.correlated")) {
    to.say(
        fmt::format("With nothing but its masking (F = 1), GGX under Smith, correlated, loses {}: "
                    "{}; {}: {}; {}: {}.",
                    at_angle(1), thresholds(f->crossings, 1), at_angle(0),
                    thresholds(f->crossings, 0), at_angle(0.1), thresholds(f->crossings, 0.1)));
    const auto& rough = f->averages.back();
    for (const auto& c : f->crossings)
      if (c.mu == 0 && c.share == 0.05 && !c.ranges.empty())
        to.headline = fmt::format(
            "Rough metal goes dark: one bounce under GGX loses {} of white light from roughness "
            "{:.2f} on, and {} where it is roughest.",
            percent(c.share), c.ranges[0].from, percent(1 - rough.albedo, 2));
    const auto normal = std::ranges::find_if(
        f->rows, [](const auto& at) { return at.roughness == 1 && at.mu == 1; });
    const auto* other = find_form(r.forms, "masking.smith_ggx.separable");
    if (other && normal != f->rows.end())
      to.say(
          fmt::format("At roughness 1 that is {} at normal incidence and {} on average; the "
                      "separable form loses {} on "
                      "average.",
                      percent(1 - normal->albedo), percent(1 - rough.albedo),
                      percent(1 - other->averages.back().albedo)));
  }
  for (const auto& m : r.materials)
    if (m.name == "F0 = 0.04" || m.name == "gold, red")
      to.say(fmt::format("Of what {} should reflect there is missing {}: {}; {}: {}.", m.name,
                         at_angle(1), thresholds(m.crossings, 1), at_angle(0),
                         thresholds(m.crossings, 0)));
  if (!r.compensations.empty()) {
    std::vector<std::string> parts;
    for (const auto& c : r.compensations)
      parts.push_back(
          fmt::format("{} {:.2g} (at worst {:+.2g}: {})", c.id, c.rms, c.worst, c.worst_at));
    to.say(
        fmt::format("RMS distance of the albedo from the truth, F0 from 0.04 to 1 under Schlick's "
                    "Fresnel together: {}.",
                    fmt::join(parts, "; ")));
  }
  std::vector<std::string> gains;
  for (const auto& f : r.forms)
    if (const auto& at = brightest(f); makes_light(f))
      gains.push_back(
          fmt::format("{} (E = {:.3g} at {})", f.name, at.albedo, place(at.roughness, at.mu)));
  if (!gains.empty()) to.say(fmt::format("Light is made by {}.", fmt::join(gains, ", ")));
  if (r.albedo_forms.size() == 3)
    to.say(fmt::format(
        "E as a formula: {} operations are off by {:.2g} at most (RMS {:.2g}), where MaterialX's "
        "fit takes {} and is off "
        "by {:.2g} ({:.2g}).",
        r.albedo_forms[0].operations, std::abs(r.albedo_forms[0].worst), r.albedo_forms[0].rms,
        r.albedo_forms[1].operations, std::abs(r.albedo_forms[1].worst), r.albedo_forms[1].rms));
  for (const auto& t : r.light.tables)
    if (t.size == 32 && t.stored == "half")
      to.say(
          fmt::format("A split-sum table of 32 × 32 texels in half reproduces A + B to {:.2g} RMS "
                      "by bilinear lookup, {:.2g} "
                      "at most (at grazing angles, beyond the outermost centres; between them "
                      "{:.2g}); half takes {:.1g}.",
                      t.lookup_rms, t.lookup, t.between, t.storage));
  if (!r.light.lit.empty()) {
    const auto range = [&](double nov) {
      double high = 0, spread = 0;
      for (const auto& l : r.light.lit)
        if (l.nov == nov && l.of_mean > high) high = l.of_mean, spread = l.of_mean_spread;
      return high < 0.1 ? fmt::format("{:.2g} ± {:.1g}\u00a0%", 100 * high, 100 * spread)
                        : fmt::format("{:.0f} ± {:.0f}\u00a0%", 100 * high, 100 * spread);
    };
    to.say(
        fmt::format("Under the environments given the split sum is off by up to {} of the mean at "
                    "NoV = 1 and up to {} at NoV = "
                    "0.1 (RMS over {} views; ±: what half of them say).",
                    range(1), range(0.1), r.light.views));
  }
}

void no_light_is_made(Findings& to, const EnergyRows& r) {
  if (r.forms.empty()) return;
  std::vector<std::pair<double, std::string>> makers;
  double largest = 0;  // of those that do not
  for (const auto& f : r.forms) {
    const auto& at = brightest(f);
    if (makes_light(f))
      makers.emplace_back(at.albedo, fmt::format("{} {:.3g} times at {}", f.name, at.albedo,
                                                 place(at.roughness, at.mu)));
    else
      largest = std::max(largest, at.albedo);
  }
  std::ranges::sort(makers, std::greater{});
  std::vector<std::string> words;
  for (const auto& [value, text] : makers)
    if (words.size() < 3) words.push_back(text);
  to.judge("reflected energy never exceeds incoming", "seeds 000 and 001, conservation of energy",
           verdict(makers.empty(), true),
           fmt::format("{} forms exceed it", of_all(makers.size(), r.forms.size())),
           fmt::format("at F = 1, {} forms reflect more than comes in somewhere{}{}; the "
                       "others reflect {:.4f} of it at most.",
                       of_all(makers.size(), r.forms.size()), words.empty() ? "" : ", most ",
                       fmt::join(words, ", "), largest));
}

void energy_does_not_stay(Findings& to, const EnergyRows& r) {
  const auto* f = find_form(r.forms, "masking.smith_ggx.correlated");
  if (!f || f->averages.empty()) return;
  const auto &smooth = f->averages.front(), &rough = f->averages.back();
  to.judge("as roughness grows the highlight widens and dims so that energy stays",
           "seed 001, conservation of energy", verdict(rough.albedo > 0.99),
           fmt::format("{} leaves at roughness {:g}", percent(rough.albedo), rough.roughness),
           fmt::format(
               "it widens and dims more than that. With nothing absorbed (GGX, Smith "
               "correlated, F = 1, one bounce, average over the hemisphere) {} of the light "
               "leaves at roughness {:g} and {} at roughness {:g}; what is missing met a "
               "second facet.",
               percent(smooth.albedo), smooth.roughness, percent(rough.albedo), rough.roughness));
}

void fixed_coat(Findings& to, const EnergyRows& r) {
  const auto *coat = find_form(r.forms, "masking.disney_coat, gamma 1"),
             *smith = find_form(r.forms, "masking.smith_gtr.separable, gamma 1");
  if (!coat || !smith) return;
  double most = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < coat->rows.size(); ++i) {  // the same rows, as far as the coat's go
    const double off = std::abs(coat->rows[i].albedo - smith->rows[i].albedo);
    if (coat->rows[i].mu >= 0.1 && off > most) most = off, at = i;
  }
  const auto& row = coat->rows[at];
  to.judge(
      "the coat needs only a fixed 0.25 G", "seed 001, Disney's secondary lobe",
      verdict_on_small(most),
      fmt::format("{} in place of {}", percent(row.albedo), percent(smith->rows[at].albedo)),
      fmt::format("as it ships (GTR of gamma 1, alpha up to 0.1) it is, from mu = 0.1 on, "
                  "furthest from its own Smith masking at roughness {:g}, mu {:g}: before "
                  "Fresnel it reflects {} instead of {}.",
                  row.roughness, row.mu, percent(row.albedo), percent(smith->rows[at].albedo)));
}

void clamped_at_2048(Findings& to, const EnergyRows& r) {
  if (r.claims.clamped.empty()) return;
  // D without 1/π is 1/α² at its peak.
  const double reached = std::pow(2048.0, -0.25);
  std::vector<std::string> words;
  double most = 0;
  for (const auto& [roughness, lost] : r.claims.clamped) {
    most = std::max(most, lost);
    words.push_back(fmt::format("{} at {:g} (the peak to {})", percent(lost), roughness,
                                percent(2048 * std::pow(roughness, 4))));
  }
  to.judge("the clamp at 2048 hardly shows", "seed 004, D_GGX_R2", verdict_on_small(most),
           fmt::format("up to {} of the highlight is lost", percent(most)),
           fmt::format("it is reached below roughness {:.3f} alone. There it takes light from the "
                       "highlight, at normal incidence {}.",
                       reached, fmt::join(words, ", ")));
}

void look_of_the_simple_form(Findings& to, const EnergyRows& r) {
  if (!find_form(r.forms, "model.ue_mobile_simple")) return;
  std::vector<std::string> words;
  double most = 0;
  for (const auto& l : r.claims.simple_form) {
    most = std::max(most, l.delta_e);
    words.push_back(
        fmt::format("F0 {:g} and mu {:g} by {:.3g} (roughness {:g}: {} reflected for {})", l.f0,
                    l.mu, l.delta_e, l.roughness, percent(l.shipped), percent(l.exact)));
  }
  to.judge(
      "the simple mobile form keeps the look", "seed 004, SpecularGGXSimple", verdict(most <= 1),
      fmt::format("ΔE2000 up to {:.2g}", most),
      fmt::format("from roughness {:g} on (below, its clamp takes over) its ΔE2000 under even "
                  "light from GGX with Smith, correlated, and Schlick is at most, for {}. It has "
                  "no Fresnel, and no angles in its visibility.",
                  unclamped_roughness, fmt::join(words, ", for ")));
}

void deviation_of_slopes(Findings& to, const EnergyRows& r) {
  if (r.claims.ggx_slopes.empty()) return;
  std::vector<std::string> words;
  double last = 0, growth = 0;
  for (const auto& s : r.claims.ggx_slopes) {
    growth = s.deviation - last, last = s.deviation;
    words.push_back(fmt::format("{:.3g} α", s.deviation));
  }
  to.judge("alpha is the standard deviation of the slopes", "seed 000, definition of alpha",
           verdict(growth < 1e-3 && std::abs(last - 1) < 1e-3),
           fmt::format("{:.2f} α for Beckmann, none for GGX", r.claims.beckmann_deviation),
           fmt::format("along an axis it is {:.4f} α for Beckmann, α/√2. GGX has none: of its "
                       "slopes up to 10, 100 and 1000 α it is {}, and it goes on growing.",
                       r.claims.beckmann_deviation, fmt::join(words, ", ")));
}

void solid_angle_of_half(Findings& to, const EnergyRows& r) {
  if (!r.claims.half_angle) return;
  const auto& [pairs, step, off] = *r.claims.half_angle;
  to.judge("dω_h = dω_l/(4 VoH)", "seed 000, the factor 4 of the BRDF", verdict(off < 1e-5),
           fmt::format("equal to {:.1g}", off),
           fmt::format("for {} pairs of directions the solid angle of the half vector, by "
                       "differences of {:g} rad in l, is that to {:.1g} of itself.",
                       pairs, step, off));
}

}  // namespace

Findings findings(const EnergyRows& r) {
  Findings all;
  measured(all, r);
  no_light_is_made(all, r);
  energy_does_not_stay(all, r);
  fixed_coat(all, r);
  clamped_at_2048(all, r);
  look_of_the_simple_form(all, r);
  deviation_of_slopes(all, r);
  solid_angle_of_half(all, r);
  judge_distributions_and_sums(all, r);
  return all;
}

}  // namespace gonio
