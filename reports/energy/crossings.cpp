#include "reports/energy/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "base/whole_loop.h"

#include <boost/math/tools/toms748_solve.hpp>

namespace gonio {
namespace {

constexpr double narrow = 1e-5;  ///< of a bracket that is narrow enough

/// A roughness, and the most that it is off by.
struct Place {
  double roughness, error;
};

/// Place between two roughnesses, whose losses lie on either side of the share.
Place crossing(
    double low, double high, double at_low, double at_high, double share, const LossAt& at) {
  double most = 0;
  const auto beyond = [&](double roughness) {
    const auto loss = at(roughness);
    most = std::max(most, loss.error);
    return loss.value - share;
  };
  std::uintmax_t steps = 60;
  const auto [from, to] = boost::math::tools::toms748_solve(
      beyond, low, high, at_low - share, at_high - share,
      [](double a, double b) { return b - a < narrow; }, steps);
  const double slope = std::abs(at_high - at_low) / (high - low);
  return {(from + to) / 2, (to - from) / 2 + most / slope};
}

}  // namespace

std::vector<Crossing> crossings_at(double mu,
                                   std::span<const double> roughness,
                                   std::span<const double> loss,
                                   const LossAt& at) {
  std::vector<Crossing> out;
  const std::size_t n = roughness.size();
  for (const double share : crossing_shares) {
    Crossing c{share, mu, {}, 0};
    const auto above = [&](std::size_t i) { return loss[i] > share; };
    const auto end = [&](std::size_t i) {  // between i and i + 1
      const auto found = crossing(roughness[i], roughness[i + 1], loss[i], loss[i + 1], share, at);
      c.error = std::max(c.error, found.error);
      return found.roughness;
    };
    for (std::size_t i = 0; i < n; ++i) {
      if (!above(i)) continue;
      const double from = i == 0 ? roughness[0] : end(i - 1);
      while (i + 1 < n && above(i + 1)) ++i;
      c.ranges.push_back({from, i + 1 == n ? roughness[n - 1] : end(i)});
    }
    out.push_back(std::move(c));
  }
  return out;
}

std::vector<Crossing> gather_crossings(
    const std::function<KnownLosses(double mu)>& known,
    const std::function<Bounded(double mu, double roughness)>& at) {
  constexpr std::array mus{1.0, 0.5, 0.1, 0.0};
  std::array<std::vector<Crossing>, mus.size()> found;
  for_each_whole(mus.size(), [&](std::size_t i) {
    const auto [roughness, loss] = known(mus[i]);
    if (!roughness.empty())
      found[i] = crossings_at(mus[i], roughness, loss, [&](double r) { return at(mus[i], r); });
  });
  std::vector<Crossing> out;
  for (auto& of_mu : found) std::ranges::move(of_mu, std::back_inserter(out));
  return out;
}

}  // namespace gonio
