#include "reports/measure/fresnel_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/direction.h"

namespace gonio {
namespace {

constexpr double one_percent = 0.01;

/// Steps of θ, and where total reflection begins: there F has a corner, between any steps.
struct SteppedAngles {
  AngleSteps at;
  std::size_t even;  ///< so many are steps

  SteppedAngles(const FresnelSurface& s, std::size_t steps)
      : at(angle_steps(steps)), even(steps + 1) {
    const double eta = s.index[0].n;
    if (s.kind != "dielectric_inside") return;
    at.theta_deg.push_back(std::asin(eta) / degree);
    at.cosine.push_back(std::sqrt((1 - eta) * (1 + eta)) * (1 - 1e-14));
  }
};

FresnelRow row_of(const std::string& form,
                  const FresnelSurface& s,
                  std::size_t channel,
                  const SteppedAngles& angles,
                  const std::vector<double>& exact,
                  const std::vector<double>& value) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto& i = s.index[channel];
  const std::string of = s.channel(channel);
  FresnelRow r{form,
               s.kind,
               of.empty() ? s.material : s.material + ", " + of,
               s.material,
               of,
               s.spectrum ? unknown : i.n,
               s.spectrum ? unknown : i.k,
               0,
               0,
               0,
               0,
               0,
               0,
               90};
  const double step = 90.0 / static_cast<double>(angles.even - 1) * degree;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const double off = value[k] - exact[k], theta = angles.at.theta_deg[k];
    if (std::abs(off) > r.max_abs) r.max_abs = std::abs(off), r.max_abs_theta_deg = theta;
    if (const double rel = std::abs(off) / std::abs(exact[k]); exact[k] != 0 && rel > r.max_rel)
      r.max_rel = rel, r.max_rel_theta_deg = theta;
    if (std::abs(off) > one_percent) r.within_deg = std::min(r.within_deg, theta);
    if (k >= angles.even) continue;
    const double weight = (k == 0 || k + 1 == angles.even ? 0.5 : 1) * step,
                 c = angles.at.cosine[k];
    r.rms += weight * off * off / (std::numbers::pi / 2);
    r.bias += weight * 2 * c * std::sqrt((1 - c) * (1 + c)) * off;
  }
  r.rms = std::sqrt(r.rms);
  return r;
}

}  // namespace

std::vector<FresnelRow> fresnel_errors(const FresnelSurface& s, std::size_t steps) {
  const SteppedAngles angles(s, steps);
  const auto forms = forms_for(s);
  const auto exact = exact_values(s, angles.at.cosine);
  std::vector<FresnelRow> out;
  for (std::size_t c = 0; c < s.channels(); ++c)
    for (const auto& f : forms)
      out.push_back(row_of(f.name, s, c, angles, exact[c], form_values(f, s, c, angles.at.cosine)));
  return out;
}

}  // namespace gonio
