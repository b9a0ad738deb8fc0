// The energy report in sentences: made from its figures alone.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/energy/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

std::string angle(double mu) {
  return mu == 0 ? "on average" : mu == 1 ? "at normal incidence" : fmt::format("at mu = {:g}", mu);
}

std::string range(const Crossing::Range& r, const std::string& word) {
  if (r.to >= 1) return fmt::format("from {}{:.2f} on", word, r.from);
  return fmt::format("from {}{:.2f} to {:.2f}", word, r.from, r.to);
}

/// "1 % from roughness 0.42 on, 5 % from 0.57 to 0.8, 10 % nowhere"
std::string thresholds(const std::vector<Crossing>& all, double mu) {
  std::vector<std::string> parts;
  for (const auto& c : all) {
    if (c.mu != mu) continue;
    std::vector<std::string> ranges;
    for (const auto& r : c.ranges)
      ranges.push_back(range(r, parts.empty() && ranges.empty() ? "roughness " : ""));
    parts.push_back(
        fmt::format("{:g}\u00a0% {}", 100 * c.share,
                    ranges.empty() ? "nowhere" : fmt::format("{}", fmt::join(ranges, " and "))));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string place(const EnergyForm::At& at) {
  return fmt::format("roughness {:g}, mu {:g}", at.roughness, at.mu);
}

}  // namespace

const EnergyForm* find_form(const EnergyReport& r, std::string_view name) {
  const auto it = std::ranges::find(r.forms, name, &EnergyForm::name);
  return it == r.forms.end() ? nullptr : &*it;
}

const EnergyForm::At& brightest(const EnergyForm& f) {
  return *std::ranges::max_element(f.rows, {}, &EnergyForm::At::albedo);
}

bool makes_light(const EnergyForm& f) {
  const auto& at = brightest(f);
  return at.albedo - at.error > 1 + 1e-6;
}

std::string percent(double share) {
  return fmt::format("{:.3g}\u00a0%", 100 * share);
}

void add_findings(EnergyReport& r) {
  auto& say = r.findings;
  if (const auto* f = find_form(r, "masking.smith_ggx.correlated")) {
    say.push_back(
        fmt::format("With nothing but its masking (F = 1), GGX under Smith, correlated, loses {}: "
                    "{}; {}: {}; {}: {}.",
                    angle(1), thresholds(f->crossings, 1), angle(0), thresholds(f->crossings, 0),
                    angle(0.1), thresholds(f->crossings, 0.1)));
    r.questions.push_back(
        {"From which roughness on does single scattering lose too much?", say.back(), ""});
    const auto& rough = f->averages.back();
    const auto normal = std::ranges::find_if(
        f->rows, [](const auto& at) { return at.roughness == 1 && at.mu == 1; });
    const auto* other = find_form(r, "masking.smith_ggx.separable");
    if (other && normal != f->rows.end())
      say.push_back(
          fmt::format("At roughness 1 that is {} at normal incidence and {} on average; the "
                      "separable form loses {} on "
                      "average.",
                      percent(1 - normal->albedo), percent(1 - rough.albedo),
                      percent(1 - other->averages.back().albedo)));
  }
  for (const auto& m : r.materials)
    if (m.name == "F0 = 0.04" || m.name == "gold, red")
      say.push_back(fmt::format("Of what {} should reflect there is missing {}: {}; {}: {}.",
                                m.name, angle(1), thresholds(m.crossings, 1), angle(0),
                                thresholds(m.crossings, 0)));
  if (!r.compensations.empty()) {
    std::vector<std::string> parts;
    for (const auto& c : r.compensations)
      parts.push_back(
          fmt::format("{} {:.2g} (at worst {:+.2g}: {})", c.id, c.rms, c.worst, c.worst_at));
    say.push_back(
        fmt::format("RMS distance of the albedo from the truth, F0 from 0.04 to 1 under Schlick's "
                    "Fresnel together: {}.",
                    fmt::join(parts, "; ")));
  }
  std::vector<std::string> gains;
  for (const auto& f : r.forms)
    if (const auto& at = brightest(f); makes_light(f))
      gains.push_back(fmt::format("{} (E = {:.3g} at {})", f.name, at.albedo, place(at)));
  if (!gains.empty()) say.push_back(fmt::format("Light is made by {}.", fmt::join(gains, ", ")));
  if (r.albedo_forms.size() == 3)
    say.push_back(fmt::format(
        "E as a formula: {} operations are off by {:.2g} at most (RMS {:.2g}), where MaterialX's "
        "fit takes {} and is off "
        "by {:.2g} ({:.2g}).",
        r.albedo_forms[0].operations, std::abs(r.albedo_forms[0].worst), r.albedo_forms[0].rms,
        r.albedo_forms[1].operations, std::abs(r.albedo_forms[1].worst), r.albedo_forms[1].rms));
  for (const auto& t : r.tables)
    if (t.size == 32 && t.stored == "half")
      say.push_back(
          fmt::format("A split-sum table of 32 × 32 texels in half reproduces A + B to {:.2g} RMS "
                      "by bilinear lookup, {:.2g} "
                      "at most (at grazing angles, beyond the outermost centres; between them "
                      "{:.2g}); half takes {:.1g}.",
                      t.lookup_rms, t.lookup, t.between, t.storage));
  if (!r.lit.empty()) {
    const auto range = [&](double nov) {
      double high = 0, spread = 0;
      for (const auto& l : r.lit)
        if (l.nov == nov && l.of_mean > high) high = l.of_mean, spread = l.of_mean_spread;
      return high < 0.1 ? fmt::format("{:.2g} ± {:.1g}\u00a0%", 100 * high, 100 * spread)
                        : fmt::format("{:.0f} ± {:.0f}\u00a0%", 100 * high, 100 * spread);
    };
    say.push_back(
        fmt::format("Under the environments given the split sum is off by up to {} of the mean at "
                    "NoV = 1 and up to {} at NoV = "
                    "0.1 (RMS over {} views; ±: what half of them say).",
                    range(1), range(0.1), r.views));
  }
}

}  // namespace gonio
