#include "fitting/judge/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/quantile.h"

namespace gonio::misfit {
namespace {

constexpr std::size_t around = 12;
constexpr double far_off = 6;           ///< robust standard deviations: two in 10⁹ if normal
constexpr double worth_telling = 0.05;  ///< ln of a factor
constexpr double to_sigma = 1.4826;

/// Values of a channel by where they are, and how far off.
struct Placed {
  double theta_h, theta_d, grazing;  ///< smooth functions of these angles
  double off;                        ///< ln of data over model
  double rounded;                    ///< standard deviation of that by the datum's digits

  /// How far off it must be to stand out from others of a robust standard deviation.
  double far(double sigma) const {
    return std::max(far_off * std::max(sigma, rounded), worth_telling);
  }
};
double distance(const Placed& a, const Placed& b) {
  const double h = a.theta_h - b.theta_h, d = a.theta_d - b.theta_d;
  return h * h + d * d;
}

/// Median and robust standard deviation.
struct Spread {
  double middle, sigma;
};
Spread spread(std::vector<double> x) {
  const double middle = median(x);
  for (double& v : x) v = std::abs(v - middle);
  return {middle, to_sigma * median(x)};
}

/// How far one value is from those around it, ln of a factor; 0 where these differ by as much, or lie on one side.
double alone(std::span<const Placed> all, std::size_t i, double sigma) {
  std::vector<std::size_t> near(all.size());
  for (std::size_t k = 0; k < near.size(); ++k) near[k] = k;
  std::swap(near[0], near[i]);
  const auto by_distance = [&](std::size_t k) { return distance(all[k], all[i]); };
  std::ranges::nth_element(near.begin() + 1, near.begin() + around, near.end(), {}, by_distance);
  near.resize(around + 1);
  std::array<int, 2> beyond{};
  std::vector<double> off;
  for (const std::size_t k : std::span(near).subspan(1)) {
    off.push_back(all[k].off);
    beyond[0] += all[k].theta_h <= all[i].theta_h;
    beyond[1] += all[k].grazing <= all[i].grazing;
  }
  constexpr int some = 2;
  if (std::ranges::min(beyond) < some) return 0;
  const Spread there = spread(off);
  const double by = all[i].off - there.middle;
  return std::abs(by) > all[i].far(std::max(sigma, there.sigma)) ? by : 0;
}

}  // namespace

std::optional<Outliers> outliers(const Left& left) {
  constexpr double few = 0.2, most_squares = 0.5;
  constexpr std::size_t most_asked = 2048;
  std::vector<std::vector<Placed>> placed(left.unknowns.size());
  std::vector<std::vector<std::size_t>> number(placed.size());
  std::vector<double> all;
  double squares = 0;
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    const Value& v = left.values[i];
    if (!(v.change > 0)) continue;
    const auto& of = left.units[v.unit].functions;
    placed[v.channel].push_back({of[1], of[2], of[8], -v.whole / v.change, v.rounding / v.change});
    number[v.channel].push_back(i);
    all.push_back(placed[v.channel].back().off);
    squares += v.whole * v.whole;
  }
  if (all.empty()) return {};
  const auto [middle, sigma] = spread(all);
  std::vector<std::array<std::size_t, 2>> far;
  for (std::size_t c = 0; c < placed.size(); ++c)
    for (std::size_t i = 0; placed[c].size() > 2 * around && i < placed[c].size(); ++i)
      if (std::abs(placed[c][i].off - middle) > placed[c][i].far(sigma)) far.push_back({c, i});
  // Each costs one pass over its channel: of many some are asked, and speak for the others.
  const std::size_t step = far.size() / most_asked + 1;
  double of_them = 0, farthest = 0, of_retro = 0;
  std::vector<double> factors;
  Outliers found{};
  for (std::size_t k = 0; k < far.size(); k += step) {
    const auto [c, i] = far[k];
    const double by = alone(placed[c], i, sigma);
    if (by == 0) continue;
    const Value& v = left.values[number[c][i]];
    of_them += static_cast<double>(step) * v.whole * v.whole;
    constexpr double near = 10 * degree;
    if (placed[c][i].theta_d < near && by > 0)
      of_retro += static_cast<double>(step) * v.whole * v.whole;
    factors.push_back(std::abs(by));
    if (std::abs(by) > farthest) farthest = std::abs(by), found.farthest = v.sample;
  }
  found.values = step * factors.size();
  found.share = static_cast<double>(found.values) / static_cast<double>(all.size());
  if (found.values == 0 || found.share > few || of_them < most_squares * squares) return {};
  found.typical = std::exp(median(factors));
  constexpr std::size_t some = 4;
  found.retro = 2 * of_retro > of_them && found.values >= some;
  return found;
}

}  // namespace gonio::misfit
