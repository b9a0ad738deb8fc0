#include "fitting/judge/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/quantile.h"
#include "fitting/judge/regression.h"
#include "fitting/judge/warnings.h"

namespace gonio {
namespace {

constexpr double significant = 0.01;    ///< probability below which a misfit is one
constexpr double worth_telling = 0.01;  ///< of f
constexpr double of_an_interval = 1;    ///< squares beyond noise, of those of noise
constexpr double surely = 0.001;        ///< probability of what no test of the angles finds
constexpr double beside_noise =
    1.5;  ///< squares of what is left over those of neighbours' differences
constexpr double most_of_a_scale =
    0.15;  ///< RMS error of an angle's scale that instruments may have

using namespace misfit;

/// Mean square of what is left, of f.
double mean_square(const Left& left) {
  double sum = 0, n = 0;
  for (const auto& v : left.values)
    if (v.change > 0) sum += v.r * v.r / (v.change * v.change), ++n;
  return sum / std::max(n, 1.0);
}
/// That of the noise by the median of what neighbours differ by, which no highlight between them moves; or NaN.
double noise_square(const Left& left) {
  std::vector<double> sizes;
  for (const auto& v : left.values)
    if (!std::isnan(v.noise)) sizes.push_back(std::abs(v.noise));
  return 2 * sizes.size() > left.values.size() ? std::pow(1.4826 * median(sizes), 2) : std::nan("");
}

/// A file of another scale shows so.  A wrong model misses several angles, and within one angle not by one factor.
std::optional<OddAngle> odd_angle(const Left& left, const Sampling& s) {
  constexpr std::size_t few_angles = 5, most_angles = 64, few_values = 8;
  constexpr double least = 0.05;      // of a scale
  constexpr double stands_out = 3;    // times as far as any other angle
  constexpr double of_one_kind = .5;  // of the deviation, by which its values scatter
  if (left.angles < few_angles || left.angles > most_angles) return {};
  std::vector<std::vector<double>> off(left.angles);  // ln of data over model
  std::vector<std::size_t> sample(left.angles);
  for (const auto& v : left.values) {
    if (!(v.change > 0)) continue;
    const std::size_t a = left.units[v.unit].angle;
    off[a].push_back(-v.whole / v.change);
    sample[a] = v.sample;
  }
  std::vector<double> scale;
  for (auto& values : off) {
    if (values.size() < few_values) return {};
    scale.push_back(median(values));
  }
  std::vector<double> sorted = scale;
  const double typical = median(sorted);
  for (double& x : scale) x -= typical;
  const auto farther = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto odd = std::ranges::max_element(scale, farther);
  const double deviation = std::exchange(*odd, 0.0);
  const auto a = static_cast<std::size_t>(odd - scale.begin());
  if (std::abs(deviation) < least ||
      std::abs(deviation) < stands_out * std::abs(*std::ranges::max_element(scale, farther)))
    return {};
  for (double& x : off[a]) x = std::abs(x - deviation - typical);
  if (1.4826 * median(off[a]) > of_one_kind * std::abs(deviation)) return {};
  return OddAngle{SampleAngles(s.table()).theta_i(sample[a]) / degree, std::exp(deviation)};
}

/// Regressions that decide, the first of which is of single values where there is one.
struct Tests {
  std::vector<std::pair<Errors, Regression>> all;
  double p_of_scales = 1, of_scales = 0;  ///< probability by chance, and their mean square
};
Tests test(const Left& left, bool measured, bool by_angle) {
  Tests t;
  const auto add = [&](Errors e) { t.all.emplace_back(e, regress(left, e)); };
  if (!measured) return add(Errors::none), t;
  Regression open = regress(left, Errors::scale);
  const bool enough = enough_angles(left.angles);
  if (open.scales > 0) {
    Regression alone = regress(left, Errors::none);
    constexpr double scatters = 0.05;
    t.p_of_scales = alone.rounded ? 1 : luck_of_scales(alone, open);
    t.of_scales =
        mean_square(left) - open.left * (1 + static_cast<double>(open.scales) / left.samples);
    if (alone.rounded || (!by_angle && t.p_of_scales > scatters)) {
      t.all.emplace_back(Errors::none, std::move(alone));
      return t;
    }
    t.all.emplace_back(Errors::scale, std::move(open));
    if (enough) add(Errors::any);
  } else {
    add(enough && (by_angle || 2 * static_cast<double>(left.angles) < left.directions)
            ? Errors::any
            : Errors::none);
  }
  return t;
}

}  // namespace

LackOfFit lack_of_fit(
    const Sampling& s, const Problem& p, const Fitted& f, double samples_used, TableFacts& facts) {
  LackOfFit found;
  Misfit& m = found.misfit;
  bool by_logarithms = s.metric() == Metric::log;
  Left left = left_over(s, p, f, facts);
  if (!s.table().truth) found.odd_angle = odd_angle(left, s);
  if (!by_logarithms && p.free.size() > 0 && !only_rounded(left.values) && find_variances(left) &&
      100 * left.without_logarithm <= left.values.size()) {
    // Whose squares weigh such noise unequally the highlight alone determines the parameters, whose
    // errors move faint values by far more than these are wrong: and none of that is a misfit.
    const Sampling logs = s.by(Metric::log, p.offset);
    left = left_over(logs, p, compared_by(logs, p, scan_samples, f), facts);
    by_logarithms = true;
  }
  const bool by_angle = p.options.intervals == Intervals::by_angle;
  const Tests tests =
      test(left, by_angle || (!s.table().truth && p.options.intervals != Intervals::independent),
           by_angle);
  const Regression& first = tests.all[0].second;
  if (first.rounded && tests.all.size() == 1) {
    m.note = "what is left is no more than the values' own rounding";
    return found;
  }
  // Of all values, noise is as much less as there are more of them than were looked at; what values
  // share is not.
  const double more = std::max(1.0, samples_used / left.samples);
  double excess = 0;
  const Regression* likeliest = nullptr;
  for (const auto& [errors, r] : tests.all) {
    if (!r.tested) continue;
    if (!likeliest || r.p < likeliest->p) likeliest = &r;
    m.size = m.tested ? std::max(m.size, r.size) : r.size;
    m.tested = true;
    if (r.noise > 0)
      excess = std::max(excess, r.excess / r.noise * (errors == Errors::any ? 1 : more));
  }
  if (m.tested) {
    m.p = std::min(1.0, likeliest->p * static_cast<double>(tests.all.size()));
    m.told = m.p < significant && m.size > likeliest->rounding &&
             (m.size > worth_telling || excess > of_an_interval);
  }
  const double within = first.left > 0 ? first.left : mean_square(left);
  if (first.p_beside_noise < surely && first.beside_noise > beside_noise &&
      first.left > worth_telling * worth_telling) {
    m.told = true;
    m.p = std::min(m.tested ? m.p : 1.0, first.p_beside_noise);
    excess = std::max(excess, 1 - 1 / first.beside_noise);
  }
  if (tests.p_of_scales < surely && tests.of_scales > most_of_a_scale * most_of_a_scale) {
    m.told = true;
    m.p = std::min(m.tested ? m.p : 1.0, tests.p_of_scales);
    excess = std::max(excess, tests.of_scales / mean_square(left));
  }
  if (!m.told) {
    const bool few_angles = tests.all[0].first == Errors::scale && !enough_angles(left.angles) &&
                            tests.of_scales > worth_telling * worth_telling;
    if (!m.tested || first.limited || few_angles) {
      m.tested = false;
      m.too_few = true;
      m.note = few_angles || (!first.tested && tests.all[0].first == Errors::any)
                   ? "the incident angles, whose values share errors, are too few to tell"
                   : "the values are too few to tell";
    }
    return found;
  }
  m.tested = true;
  // What the noise does not explain, as far as it is known; else what the functions and the scales
  // do.
  const double all = mean_square(left), noise = noise_square(left);
  const double seen = m.size > 0 ? m.size * m.size : 0;
  const double beyond =
      std::isnan(noise) ? seen + std::max(0.0, all - within) : std::max(seen, all - noise);
  m.size = std::sqrt(std::min(all, beyond));
  m.worst_cell = worst_cell(left);
  if (auto& cell = m.worst_cell) {  // of the data, where it was of f
    const double off = cell->difference;
    cell->difference = by_logarithms ? std::expm1(off) : off / (1 - std::min(off, 0.99));
  }
  if (likeliest) {
    const double most = std::ranges::max(likeliest->follows);
    for (std::size_t g = 1; g < names.size(); ++g)
      if (likeliest->follows[g] > 0.5 * most) m.follows.emplace_back(names[g]);
  }
  found.widening = std::sqrt(1 + 16 * excess);
  return found;
}

double widened(double error, double widening, double seen_against) {
  return std::hypot(error, std::sqrt(widening * widening - 1) *
                               (std::isnan(seen_against) ? error : seen_against));
}

void widen(Uncertainty& u, const LackOfFit& l, std::span<const double> seen_against) {
  for (std::size_t i = 0; i < u.std_error.size(); ++i) {
    double& e = u.std_error[i];
    const double wider = widened(e, l.widening, seen_against[i]);
    u.variance[i] *= wider * wider / (e * e);
    e = wider;
  }
}

}  // namespace gonio
