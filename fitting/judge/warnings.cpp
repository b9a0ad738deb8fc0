#include "fitting/judge/warnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "brdf/model/roughness.h"
#include "table/health/health.h"
#include "table/health/lost_values.h"

#include <fmt/format.h>

namespace gonio {

std::string typical_factor(double log_rms) {
  const double x = std::exp(log_rms), above = x - 1;
  if (x > 1e5) return fmt::format("{:.1e}", x);
  return fmt::format("{:.{}f}", x,
                     x > 9.95        ? 0
                     : above >= 1    ? 1
                     : above >= 0.1  ? 2
                     : above >= 0.01 ? 3
                                     : 4);
}

bool enough_angles(std::size_t clusters) {
  return clusters >= 8;
}

namespace {

/// Factor of two digits, or of whole numbers.
std::string factor(double x) {
  return x < 9.95 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x);
}
std::string percent(double share) {
  return factor(100 * share) + " %";
}

/// Angles that only repeat another; "" of none.
std::string copies_in_words(const Table& t) {
  std::string s;
  for (const auto& [axis, name] : {std::pair{std::size_t{0}, "incident"}, {1, "outgoing"}})
    if (const std::size_t n = copied_rows(t, axis))
      s += (s.empty() ? "" : " and ") + counted(n, std::string(name) + " angle");
  return s.empty() ? s : s + " only repeat another value for value";
}

/// " of channel b" where the others have no negative values.
std::string only_negative_channel(const Table& t) {
  std::vector<std::string> negative;
  for (std::size_t c = 0; c < t.values.size(); ++c)
    if (std::ranges::any_of(t.values[c], [](double v) { return v < 0; }))
      negative.push_back(t.channels[c]);
  return negative.size() == 1 && t.values.size() > 1 ? " of channel " + printable(negative[0], 40)
                                                     : "";
}

/// True where a parameter has an interval that the data bound.
bool has_intervals(const FitDocument& d) {
  return std::ranges::any_of(d.parameters, [](const FittedParameter& p) {
    return std::ranges::find(p.status, ParameterStatus::free) != p.status.end();
  });
}

/// Bias of relative errors, of the values: the mean of 1/y is above 1/f by s² for noise of size s; 0 where
/// it is little beside every interval.
double telling_bias(const FitOptions& o, const FitDocument& d) {
  if (o.metric != Metric::relative || d.misfit.told) return 0;
  const double bias = d.residuals.log_rms * d.residuals.log_rms;
  constexpr double little = 0.5;  // of half an interval
  for (const auto& p : d.parameters)
    for (std::size_t c = 0; c < p.value.size(); ++c)
      if (bias * std::abs(p.value[c]) > little * (p.ci95_high[c] - p.ci95_low[c]) / 2) return bias;
  return 0;
}

}  // namespace

FitFacts with_table(FitFacts f, const FitOptions& o, TableFacts& table, const FitDocument& d) {
  const Table& t = table.table();
  f.few_angles = !t.truth && o.intervals != Intervals::independent && !enough_angles(f.angles);
  f.copies = !copies_in_words(t).empty();
  f.offset = table.negative_offset() > 0;
  f.clipped = f.dark_bias > 0 && is_clipped(table);
  if (!d.misfit.reproduces()) f.retro = table.retro();
  // Asked of narrow lobes alone: looking for the peak takes as long as a fit.
  const auto narrow = [](const FittedParameter& p) {
    return is_alpha(p.name) && p.status[0] != ParameterStatus::fixed &&
           (p.value[0] < 0.1 || p.limit[0] < 0.1);
  };
  if (!t.aperture && std::ranges::any_of(d.parameters, narrow)) {
    f.unresolved = table.peak().peak;
    if (f.unresolved && f.unresolved->resolved) f.unresolved.reset();
  }
  return f;
}

std::vector<std::string> warnings(const FitOptions& o,
                                  const Table& t,
                                  const FitDocument& d,
                                  const FitFacts& f) {
  std::vector<std::string> all;
  if (const auto& alone = f.outliers; alone && alone->retro) {
    all.push_back(fmt::format(
        "about {} near wo = wi {} brighter than those around {}, typically by a factor of {}: a "
        "highlight that the model lacks",
        counted(alone->values, "value"), alone->values == 1 ? "is" : "are",
        alone->values == 1 ? "it" : "them", typical_factor(std::log(alone->typical))));
  } else if (alone) {
    all.push_back(fmt::format(
        "about {} ({}) {} off those around {}, typically by a factor of {}: outliers, which the "
        "fit follows",
        counted(alone->values, "value"), percent(alone->share), alone->values == 1 ? "is" : "are",
        alone->values == 1 ? "it" : "them", typical_factor(std::log(alone->typical))));
    const auto [l, v] = SampleAngles(t).directions(alone->farthest);
    all.push_back(fmt::format("the farthest outlier is at theta_i {:.3g}°, theta_o {:.3g}°",
                              std::acos(std::clamp(l.z, -1.0, 1.0)) / degree,
                              std::acos(std::clamp(v.z, -1.0, 1.0)) / degree));
  }
  if (d.log_offset > 0 && !f.offset && f.dark_bias == 0)
    all.push_back(fmt::format(
        "negative values{} betray a noise floor of {:.2g} 1/sr: masking them lifts what is fitted "
        "to dark places",
        only_negative_channel(t), d.log_offset));
  for (auto& w : misfit_in_words(d.misfit, has_intervals(d))) all.push_back(std::move(w));
  for (auto& w : physics_in_words(d.physics, d.misfit.told)) all.push_back(std::move(w));
  if (const auto& odd = f.odd_angle)
    all.push_back(fmt::format(
        "values at theta_i {:.3g}° are {:.3g} × what the model and the other angles say: another "
        "scale?",
        odd->theta_i_deg, odd->factor));
  if (const auto& chi2 = d.residuals.chi2_per_freedom; chi2 && f.beyond_stated)
    all.push_back(fmt::format("what is left is {:.2g} times the stated uncertainties: {}",
                              std::sqrt(*chi2),
                              d.misfit.told ? "the model misses the table, or they are too small"
                                            : "they are too small for the scatter"));
  else if (chi2 && *chi2 < 0.25)
    all.push_back(
        fmt::format("what is left is {:.2g} times the stated uncertainties: they are too large, or "
                    "hold what all values share",
                    std::sqrt(*chi2)));
  if (d.values_used <= f.free)
    all.push_back(fmt::format("{} cannot tell the errors of {}", counted(d.values_used, "value"),
                              counted(f.free, "unknown")));
  else if (d.misfit.too_few)
    all.push_back("whether the model is right is not known: " + d.misfit.note);
  if (f.few_angles)
    all.push_back(fmt::format(
        "{} incident angle{}: an error common to all values of one angle is hard to estimate",
        f.angles, f.angles == 1 ? "" : "s are few"));
  if (f.retro)
    all.push_back(
        fmt::format("the highlight ({:.3g} 1/sr) sits at wo = wi and not at the half vector: a "
                    "microfacet lobe cannot describe it",
                    f.retro->height));
  if (const auto& peak = f.unresolved)
    all.push_back(
        fmt::format("the table does not resolve its highlight ({} within its half width of "
                    "{:.2g}°): it may be narrower",
                    counted(static_cast<std::size_t>(std::lround(peak->samples_within)), "sample"),
                    peak->half_width_deg));
  if (const auto copies = copies_in_words(t); !copies.empty())
    all.push_back(copies + (o.copies ? ", though fitted as measurements" : ", and are left out"));
  if (const double bias = telling_bias(o, d); bias > 0)
    all.push_back(
        fmt::format("relative errors shift values by about {}, more than intervals allow for: "
                    "--metric log does not",
                    percent(bias)));
  if (f.dark_bias > 0)
    all.push_back(fmt::format(
        "noise lowers the logarithms of the darkest values by about {}, kd with them: intervals "
        "include it",
        percent(f.dark_bias)));
  if (f.cost_of_fewer < d.cost)
    all.push_back(
        fmt::format("with fewer lobes the model meets the table better (cost {:.6g} for {:.6g}): a "
                    "lobe whose F is 1 at 90° cannot vanish",
                    f.cost_of_fewer, d.cost));
  if (f.needless)
    all.emplace_back(
        d.misfit.told
            ? "the model misses the table with and without its lobe: nothing is known of the lobe"
            : "without its lobe the model meets the table as well or better: nothing is known of "
              "the lobe");
  return all;
}

namespace {
constexpr double all_light = 1.001;  // to what its integral is known
}

bool returns_too_much(const Physics& p) {
  return std::ranges::any_of(p.model_albedo, [](const auto& of_angle) {
    return std::ranges::any_of(of_angle, [](double a) { return a > all_light; });
  });
}

std::vector<std::string> physics_in_words(const Physics& p, bool misfit) {
  std::vector<std::string> all;
  double most = all_light, at = 0, table = 0;
  for (std::size_t k = 0; k < p.theta_i_deg.size(); ++k)
    for (std::size_t c = 0; c < p.model_albedo[k].size(); ++c)
      if (p.model_albedo[k][c] > most) {
        most = p.model_albedo[k][c];
        at = p.theta_i_deg[k];
        table = p.data_albedo[k][c];
      }
  if (most > all_light)
    all.push_back(fmt::format(
        "the fitted model returns {:.4g} of the light that arrives at theta_i {:.3g}°{}: more than "
        "there is",
        most, at, std::isnan(table) ? "" : fmt::format(" (the table {:.3g})", table)));
  // As far below alone is no fault: logarithms weigh few values little.
  constexpr double far_above = 1.5;
  double ratio = 0;  // of channels that are dark in the model too there is none
  bool dark = false;
  for (const double r : p.peak_ratio)
    if (std::isinf(r))
      dark = true;
    else
      ratio = std::max(ratio, r);
  if (dark)
    all.emplace_back("the fitted model is not dark where a channel of the table is 0 everywhere");
  if (ratio > far_above || (misfit && ratio > 0 && ratio < 1 / far_above))
    all.push_back(
        fmt::format("at the table's own samples the model's greatest value is {} times the table's",
                    factor(ratio)));
  return all;
}

std::string deviation_in_words(double ratio) {
  if (!(ratio > 0)) return "dark beside the table";
  return fmt::format("too {} by a factor of {}", ratio > 1 ? "bright" : "dark",
                     typical_factor(std::abs(std::log(ratio))));
}

std::vector<std::string> misfit_in_words(const Misfit& m, bool allowed_for) {
  if (!m.told) return {};
  std::string size = typical_factor(m.size);
  constexpr std::size_t every = 3;  // what they may follow
  if (m.follows.size() >= every) size += ", varying with every angle";
  for (std::size_t k = 0; k < m.follows.size() && m.follows.size() < every; ++k)
    size += std::string(k == 0 ? ", varying " : " and ") +
            (m.follows[k].starts_with("grazing") ? "at " : "with ") + m.follows[k];
  std::vector<std::string> all{"beyond noise the model is off by a factor of " + size +
                               (allowed_for ? "; intervals are widened" : "")};
  if (const auto& c = m.worst_cell)
    all.push_back(fmt::format(
        "for instance, around theta_h {:.2g}°, theta_d {:.2g}° the model is on average {}",
        (c->theta_h_from_deg + c->theta_h_to_deg) / 2,
        (c->theta_d_from_deg + c->theta_d_to_deg) / 2, deviation_in_words(1 + c->difference)));
  return all;
}

}  // namespace gonio
