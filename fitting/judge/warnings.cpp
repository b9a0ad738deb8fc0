#include "fitting/judge/warnings.h"

#include <algorithm>
#include <cmath>

#include "brdf/model/roughness.h"
#include "table/health/health.h"
#include "table/health/noise.h"
#include "table/health/peak.h"

#include <fmt/format.h>

namespace gonio {

bool enough_angles(std::size_t clusters, std::size_t free) {
  return clusters >= std::max<std::size_t>(8, 2 * free);
}

std::vector<std::string> warnings(const FitOptions& o,
                                  const Table& t,
                                  const FitDocument& d,
                                  std::size_t angles,
                                  std::size_t free) {
  std::vector<std::string> all;
  constexpr double far_off = 0.25;
  if (d.residuals.log_rms > far_off)
    all.push_back(
        fmt::format("model and table differ by a typical factor of {:.3g}: unless that is noise, "
                    "the model does "
                    "not describe the table, and the intervals say nothing of it",
                    std::exp(d.residuals.log_rms)));
  else if (t.list())  // of a large grid the estimate takes longer than its fit
    if (const Noise noise = estimate_noise(t);
        noise.sigma && !noise.bound && d.residuals.log_rms > 3 * *noise.sigma)
      all.push_back(fmt::format(
          "model and table differ by {:.2g} %, values and their neighbours by {:.2g} %: "
          "most of it is the model's error, of which the intervals know nothing",
          100 * d.residuals.log_rms, 100 * *noise.sigma));
  if (d.values_used <= free)
    all.push_back(
        fmt::format("{} values cannot tell the errors of {} unknowns", d.values_used, free));
  if (!t.truth && o.intervals != Intervals::independent && !enough_angles(angles, free))
    all.push_back(fmt::format(
        "{} incident angles are few for {} unknowns: errors that the values of one angle share "
        "make the intervals too narrow",
        angles, free));
  if (const auto retro = retro_peak(t))
    all.push_back(
        fmt::format("the highlight ({:.3g} 1/sr) sits at wo = wi and not at the half vector: a "
                    "microfacet lobe cannot describe it",
                    retro->height));
  // Asked of narrow lobes alone: looking for the peak takes as long as a fit.
  const auto narrow = [](const FittedParameter& p) {
    return is_alpha(p.name) && p.value[0] < 0.1 && p.status[0] != ParameterStatus::fixed;
  };
  if (std::ranges::any_of(d.parameters, narrow))
    if (const auto peak = find_peak(t, t.bins()).peak; peak && !peak->resolved)
      all.push_back(fmt::format(
          "the table does not resolve its highlight ({:.0f} samples within the half width of "
          "{:.2g}°): the width found is that of the samples or the instrument",
          peak->samples_within, peak->half_width_deg));
  if (const std::size_t in = copied_rows(t, 0), out = copied_rows(t, 1); in || out)
    all.push_back(
        fmt::format("{} incident and {} outgoing angles of the table repeat another value for "
                    "value: no measurements of their own, {}",
                    in, out, o.copies ? "though fitted like such" : "and left out"));
  if (d.log_offset > 0)
    all.push_back(fmt::format(
        "negative values betray a noise floor of {:.2g} 1/sr; they are masked, which lifts what "
        "is fitted where the signal is not well above it",
        d.log_offset));
  return all;
}

}  // namespace gonio
