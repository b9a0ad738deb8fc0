#include "fitting/judge/warnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "brdf/model/roughness.h"
#include "table/health/health.h"
#include "table/health/peak.h"

#include <fmt/format.h>

namespace gonio {

bool enough_angles(std::size_t clusters) {
  return clusters >= 8;
}

namespace {

std::string percent(double share) {
  return share < 0.0995 ? fmt::format("{:.2g} %", 100 * share)
                        : fmt::format("{:.0f} %", 100 * share);
}

/// Angles that only repeat another; "" of none.
std::string copies_in_words(const Table& t) {
  std::string s;
  for (const auto& [axis, name] : {std::pair{std::size_t{0}, "incident"}, {1, "outgoing"}})
    if (const std::size_t n = copied_rows(t, axis))
      s += fmt::format("{}{} {} angle{}", s.empty() ? "" : " and ", n, name, n == 1 ? "" : "s");
  return s.empty() ? s : s + " only repeat another value for value";
}

}  // namespace

std::vector<std::string> warnings(const FitOptions& o,
                                  const Table& t,
                                  const FitDocument& d,
                                  std::size_t angles,
                                  std::size_t free) {
  std::vector<std::string> all;
  for (auto& w : misfit_in_words(d.misfit)) all.push_back(std::move(w));
  for (auto& w : physics_in_words(d.physics)) all.push_back(std::move(w));
  if (d.values_used <= free)
    all.push_back(fmt::format("{} value{} cannot tell the errors of {} unknown{}", d.values_used,
                              d.values_used == 1 ? "" : "s", free, free == 1 ? "" : "s"));
  else if (!d.misfit.tested && d.misfit.note.find("too few") != std::string::npos)
    all.push_back("whether the model is right is not known: " + d.misfit.note);
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
          "the table does not resolve its highlight ({:.0f} samples within its half width of "
          "{:.2g}°): it may be narrower",
          peak->samples_within, peak->half_width_deg));
  if (const auto copies = copies_in_words(t); !copies.empty())
    all.push_back(copies + (o.copies ? ", though fitted as measurements" : ", and are left out"));
  if (d.log_offset > 0)
    all.push_back(fmt::format(
        "negative values betray a noise floor of {:.2g} 1/sr: masking them lifts what is fitted "
        "to dark places",
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
        "the fitted model returns {:.4g} of the light that arrives at theta_i {:.3g}°{}: more than "
        "there is",
        most, at, std::isnan(table) ? "" : fmt::format(" (the table {:.3g})", table)));
  constexpr double far_above = 1.5;
  const double ratio = p.peak_ratio.empty() ? 0 : std::ranges::max(p.peak_ratio);
  if (ratio > far_above)
    all.push_back(fmt::format(
        "the fitted model rises to {:.2g} times the table's greatest value where that has samples",
        ratio));
  return all;
}

std::vector<std::string> misfit_in_words(const Misfit& m) {
  if (!m.told) return {};
  std::string size =
      m.size > 0.5 ? std::string("more than half") : percent(m.size) + " beyond noise";
  for (std::size_t k = 0; k < m.follows.size(); ++k)
    size += (k == 0 ? ", along " : k + 1 < m.follows.size() ? ", " : " and ") + m.follows[k];
  std::vector<std::string> all{"the model misses the table by " + size +
                               "; the intervals allow for it"};
  if (const auto& c = m.worst_cell)
    all.push_back(
        fmt::format("it is furthest off near theta_h {:.2g}°, theta_d {:.2g}°: {}",
                    (c->theta_h_from_deg + c->theta_h_to_deg) / 2,
                    (c->theta_d_from_deg + c->theta_d_to_deg) / 2,
                    c->difference > 9   ? fmt::format("{:.0f} times as bright", 1 + c->difference)
                    : c->difference > 1 ? fmt::format("{:.2g} times as bright", 1 + c->difference)
                    : c->difference > 0 ? percent(c->difference) + " too bright"
                                        : percent(-c->difference) + " too dark"));
  return all;
}

}  // namespace gonio
