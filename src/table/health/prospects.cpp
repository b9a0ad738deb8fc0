#include "table/health/prospects.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/quantile.h"
#include "base/text.h"
#include "brdf/model/evaluate.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using enum Verdict;

/// Figures that the prospects ask of the samples, of up to 200,000 of them.
struct Survey {
  double highlight_from_deg = 180,
         highlight_to_deg = -1;       ///< θ_d of valid samples in the highlight
  double darkest = 0, brightest = 0;  ///< a hundredth of the values lies below, above [1/sr]
  double in_noise = 0;                ///< share of values below three times the noise floor
  bool computed = false;              ///< see one_value_per_angle()
  bool peak_is_noise = false;         ///< see TableFacts::is_noise()
  double tail = 0;  ///< of a GGX lobe as wide as the highlight, where the base is, over its height
};

/// Height of a GGX lobe in a profile's base, over that of its top: the mean over these samples.
double tail_of(double alpha, const std::vector<Angles<double>>& base) {
  if (base.empty()) return 0;
  const auto lobe =
      bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1);
  const std::vector top{angles(SinCos(), SinCos(25 * degree), 0)};
  const auto values = evaluate(lobe, base);
  const double sum = std::accumulate(values[0].begin(), values[0].end(), 0.0);
  return sum / static_cast<double>(base.size()) / evaluate(lobe, top)[0][0];
}

Survey survey(TableFacts& facts, const Health& h) {
  const Table& t = facts.table();
  const SampleAngles at(t);
  const std::size_t step = t.size() / 200'000 + 1;
  const double within = h.peak ? std::max(h.peak->half_width_deg, 3.0) : 3.0;
  Survey s;
  s.computed = facts.computed();
  s.peak_is_noise = h.peak && facts.is_noise(*h.peak);
  std::vector<double> values;
  std::vector<Angles<double>> base;
  std::size_t in_noise = 0;
  for (std::size_t i = 0; i < t.size(); i += step) {
    const auto a = at(i);
    const std::size_t before = values.size();
    for (const auto& plane : t.values)
      if (mask(a, plane[i]) == Mask::valid) {
        values.push_back(plane[i]);
        in_noise += plane[i] < 3 * h.noise_floor;
      }
    if (values.size() == before) continue;
    const double half = std::atan2(std::sqrt(a.sin2_theta_h), a.noh) / degree,
                 difference = std::acos(std::min(a.voh, 1.0)) / degree;
    if (half <= within) {
      s.highlight_from_deg = std::min(s.highlight_from_deg, difference);
      s.highlight_to_deg = std::max(s.highlight_to_deg, difference);
    }
    if (h.peak && difference >= 5 && difference <= 45 && std::abs(half - h.peak->base_deg) < 5)
      base.push_back(a);
  }
  if (values.empty()) return s;
  s.in_noise = static_cast<double>(in_noise) / static_cast<double>(values.size());
  s.darkest = quantile(values, 0.01);
  s.brightest = quantile(values, 0.99);
  if (h.peak) s.tail = tail_of(std::clamp(h.peak->alpha, 1e-4, 1.0), base);
  return s;
}

/// True where noise alone, and a quarter, could spread the values that far: 98 % of a normal deviate's lie
/// within 4.65 σ.
bool flat(const Health& h, const Survey& s) {
  const double sigma = h.noise.sigma && !h.noise.bound ? *h.noise.sigma : 0;
  return s.brightest <= s.darkest * 1.25 * std::exp(1.3 * 4.65 * sigma);
}

Prospect alpha(const Health& h, const Survey& s) {
  const auto say = [](Verdict v, std::string why) { return Prospect{"alpha", v, std::move(why)}; };
  if (s.computed)
    return say(no,
               "each incident angle holds one constant: the table was computed, and shows no lobe");
  if (h.retro && h.peak)
    return say(
        weakly,
        fmt::format("two highlights: the larger ({:.3g} 1/sr) sits at wo = wi, where a "
                    "microfacet lobe has none; the other, at the half vector ({:.3g} 1/sr): {}",
                    h.retro->height, h.peak->height, peak_in_words(*h.peak)));
  if (h.retro)
    return say(no,
               fmt::format("the highlight sits at wo = wi ({:.3g} 1/sr there) and not at the half "
                           "vector: a microfacet lobe cannot describe it",
                           h.retro->height));
  if (h.peak_profiles == 0)
    return say(weakly,
               "no run of samples from the half vector outwards at theta_d from 5 to 45° shows a "
               "highlight's height and foot");
  if (!h.peak && s.brightest == 0)
    return say(no,
               fmt::format("no highlight: {} the values are 0", h.largest > 0 ? "98 % of" : "all"));
  if (!h.peak && flat(h, s))
    return say(no, fmt::format("no highlight: 98 % of the values lie within a factor of {:.3g}",
                               s.brightest / s.darkest));
  if (!h.peak)
    return say(
        weakly,
        fmt::format("no highlight: the values nearest the half vector are {:.3g} times the "
                    "base; a lobe, if there is one, is wide, and a fit must part it from the base",
                    h.peak_contrast));
  if (s.peak_is_noise)
    return say(weakly,
               fmt::format("the highlight, {:.3g} times the base, may be noise", h.peak_contrast));
  return say(h.peak->limit == PeakLimit::none ? yes : weakly, peak_in_words(*h.peak));
}

Prospect f0(const Health& h, const Survey& s, Verdict of_alpha) {
  const auto say = [](Verdict v, std::string why) { return Prospect{"f0", v, std::move(why)}; };
  if (of_alpha == no) return say(no, "it scales a lobe that these values do not show");
  if (h.retro)
    return say(
        no,
        "it scales the smaller of two highlights; none of the larger, at wo = wi, is the lobe's");
  if (!h.peak || s.peak_is_noise) return say(weakly, "it scales a lobe that is hardly seen");
  if (h.peak->limit == PeakLimit::samples)
    return say(weakly,
               "the peak is not resolved: its height depends on the instrument as much as on the "
               "surface");
  return say(
      s.highlight_from_deg <= 45 ? yes : weakly,
      fmt::format("the highlight is {:.3g} times the base and seen from theta_d = {:.0f}° on",
                  h.peak_contrast, s.highlight_from_deg));
}

Prospect fresnel(const Survey& s, Verdict of_alpha, bool highlight) {
  if (of_alpha == no) return {"fresnel", no, "there is no highlight to rise towards grazing"};
  const double to = std::max(s.highlight_to_deg, 0.0);
  return {"fresnel",
          to < 60                 ? no
          : to < 75 || !highlight ? weakly
                                  : yes,
          fmt::format("samples near the mirror direction reach theta_d = {:.0f}°; Fresnel forms "
                      "only differ beyond 60°",
                      to)};
}

Prospect kd(const Health& h, const Survey& s) {
  const auto say = [](Verdict v, std::string why) { return Prospect{"kd", v, std::move(why)}; };
  if (s.computed)
    return say(weakly,
               fmt::format("each incident angle holds one constant, from {:.3g} to {:.3g} 1/sr",
                           s.darkest, s.brightest));
  if (!h.peak)
    return say(
        flat(h, s) ? yes : weakly,
        fmt::format("98 % of the values lie between {:.3g} and {:.3g} 1/sr, with no highlight "
                    "to part from the base",
                    s.darkest, s.brightest));
  const double base = h.peak->base;
  if (!(base > 0)) return say(no, "away from the highlight the values are not above zero");
  if (base < h.noise_floor)
    return say(weakly, fmt::format("the base, {:.3g} 1/sr, is below the noise floor of {:.3g} 1/sr",
                                   base, h.noise_floor));
  const double tail = std::min(1.0, (h.peak->height - base) * s.tail / base);
  return say(
      tail <= 0.2      ? yes
      : tail < 2.0 / 3 ? weakly
                       : no,
      fmt::format(
          "far from the highlight, at theta_h = {2:.0f}°, values are {0:.3g} 1/sr; the highlight's "
          "tail, if GGX, would be {1:.3g} % of that",
          base, 100 * tail, h.peak->base_deg));
}

Prospect precision(const Health& h, const Survey& s) {
  std::string why =
      fmt::format("98 % of the values lie between {:.3g} and {:.3g} 1/sr", s.darkest, s.brightest);
  Verdict v = weakly;
  if (h.noise.sigma) {
    v = *h.noise.sigma <= 0.05 ? yes : *h.noise.sigma <= 0.3 ? weakly : no;
    why += fmt::format(", each with {} {:.2g} % noise", h.noise.bound ? "at most" : "about",
                       100 * std::max(*h.noise.sigma, 1e-4));
  } else {
    why += "; the table does not show how noisy they are";
  }
  if (h.noise_floor > 0) {
    why += fmt::format("; {:.0f} % of them below three times the noise floor of {:.2g} 1/sr",
                       100 * s.in_noise, h.noise_floor);
    if (s.in_noise > 0.5 && v == yes) v = weakly;
  }
  return {"precision", v, why};
}

Prospect intervals(const Table& t) {
  if (const Grid* g = t.grid(); g && g->kind == Grid::Kind::half_difference)
    return {"intervals", yes,
            "bins of half and difference angle hold all incident angles; a fit takes each whole "
            "degree as one"};
  // Told apart as the fit does for its intervals.
  const std::size_t n =
      t.list() ? incident_angles(*t.list()).count : t.grid()->axes[0].size - copied_rows(t, 0);
  return {"intervals",
          n >= 8   ? yes
          : n >= 2 ? weakly
                   : no,
          fmt::format("{}; at least 8 are needed", counted(n, "incident angle"))};
}

}  // namespace

std::vector<Prospect> prospects(TableFacts& facts, const Health& h) {
  if (h.valid == 0) return {{"alpha", no, "no value is valid"}};
  const Survey s = survey(facts, h);
  std::vector<Prospect> all{alpha(h, s)};
  const Verdict of_alpha = all[0].verdict;
  all.push_back(f0(h, s, of_alpha));
  all.push_back(fresnel(s, of_alpha, h.peak.has_value()));
  all.push_back(kd(h, s));
  all.push_back(precision(h, s));
  all.push_back(intervals(facts.table()));
  return all;
}

}  // namespace gonio
