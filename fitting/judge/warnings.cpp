#include "fitting/judge/warnings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "brdf/model/roughness.h"
#include "table/health/health.h"
#include "table/health/peak.h"

#include <fmt/format.h>

namespace gonio {

bool enough_angles(std::size_t clusters) {
  return clusters >= 8;
}

std::vector<std::string> warnings(const FitOptions& o,
                                  const Table& t,
                                  const FitDocument& d,
                                  std::size_t angles,
                                  std::size_t free) {
  std::vector<std::string> all;
  if (d.misfit.told) all.push_back(misfit_in_words(d.misfit));
  for (auto& w : physics_in_words(d.physics)) all.push_back(std::move(w));
  if (d.values_used <= free)
    all.push_back(
        fmt::format("{} values cannot tell the errors of {} unknowns", d.values_used, free));
  else if (!d.misfit.tested && d.misfit.note.find("too few") != std::string::npos)
    all.push_back("whether the model is the right one is not known: " + d.misfit.note);
  if (!t.truth && o.intervals != Intervals::independent && !enough_angles(angles))
    all.push_back(fmt::format(
        "{} incident angle{}: errors that the values of one angle share can hardly be told", angles,
        angles == 1 ? "" : "s are few"));
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

std::vector<std::string> physics_in_words(const Physics& p) {
  std::vector<std::string> all;
  double most = 1.001, at = 0, table = 0;  // to what its integral is known
  for (std::size_t k = 0; k < p.theta_i_deg.size(); ++k)
    for (std::size_t c = 0; c < p.model_albedo[k].size(); ++c)
      if (p.model_albedo[k][c] > most) {
        most = p.model_albedo[k][c];
        at = p.theta_i_deg[k];
        table = p.data_albedo[k][c];
      }
  if (most > 1.001)
    all.push_back(fmt::format(
        "the fitted model returns {:.4g} times the light that arrives at theta_i {:.3g}°{}, more "
        "than there is",
        most, at, std::isnan(table) ? "" : fmt::format(" (the table {:.3g} times)", table)));
  constexpr double far_above = 1.5;
  const double ratio = p.peak_ratio.empty() ? 0 : std::ranges::max(p.peak_ratio);
  if (ratio > far_above)
    all.push_back(fmt::format(
        "the fitted model rises to {:.2g} times the table's greatest value where that has samples",
        ratio));
  return all;
}

std::string misfit_in_words(const Misfit& m) {
  if (!m.told) return "";
  std::string s = m.size > 0.5 ? std::string("the model misses the table by more than half")
                               : fmt::format("the model misses the table by {:.2g} % beyond noise",
                                             100 * m.size);
  if (!m.follows.empty()) {
    s += ", along ";
    for (std::size_t k = 0; k < m.follows.size(); ++k) s += (k == 0 ? "" : " and ") + m.follows[k];
  }
  if (const auto& c = m.worst_cell)
    s += fmt::format(", most at theta_h {:.3g}° to {:.3g}°, theta_d {:.3g}° to {:.3g}° ({:+.2g} %)",
                     c->theta_h_from_deg, c->theta_h_to_deg, c->theta_d_from_deg, c->theta_d_to_deg,
                     100 * c->difference);
  static const std::map<std::string, std::string_view> causes{
      {"theta_h", "the highlight's shape, as another distribution or a second lobe has it"},
      {"theta_d", "the Fresnel form, or what couples the diffuse to it"},
      {"grazing angles", "masking, or the diffuse form"}};
  std::string usual;
  for (const auto& f : m.follows)
    usual += fmt::format("{}{}", usual.empty() ? "" : "; ", causes.at(f));
  if (!usual.empty()) s += "; the usual cause is " + usual;
  return s + "; the intervals allow for it";
}

}  // namespace gonio
