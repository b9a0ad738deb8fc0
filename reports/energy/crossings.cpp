#include "reports/energy/crossings.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gonio {
namespace {

/// Roughness between those of i and k, where the loss is on either side of the share.
double between(std::span<const double> x,
               std::span<const double> y,
               std::size_t i,
               std::size_t k,
               double share) {
  const bool powers = x[i] > 0 && y[i] > 0 && y[k] > 0;
  const auto scale = [&](double v) { return powers ? std::log(v) : v; };
  const double part = (scale(share) - scale(y[i])) / (scale(y[k]) - scale(y[i]));
  const double at = scale(x[i]) + part * (scale(x[k]) - scale(x[i]));
  return powers ? std::exp(at) : at;
}

}  // namespace

std::vector<Crossing> crossings_at(double mu,
                                   std::span<const double> roughness,
                                   std::span<const double> loss) {
  std::vector<Crossing> out;
  const std::size_t n = roughness.size();
  for (const double share : crossing_shares) {
    Crossing c{share, mu, {}, 0};
    const auto above = [&](std::size_t i) { return loss[i] > share; };
    const auto end = [&](std::size_t i) {  // between i and i + 1
      const double at = between(roughness, loss, i, i + 1, share);
      double other = roughness[i];
      if (i > 0 && above(i - 1) == above(i))
        other = between(roughness, loss, i - 1, i + 1, share);
      else if (i + 2 < n && above(i + 2) == above(i + 1))
        other = between(roughness, loss, i, i + 2, share);
      c.error = std::max(c.error, std::abs(at - other));
      return at;
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
    const std::function<void(double, const std::function<void(double, double)>&)>& gather) {
  std::vector<Crossing> out;
  for (const double mu : {1.0, 0.5, 0.1, 0.0}) {
    std::vector<double> roughness, loss;
    gather(mu, [&](double r, double l) {
      roughness.push_back(r);
      loss.push_back(l);
    });
    if (!roughness.empty())
      std::ranges::move(crossings_at(mu, roughness, loss), std::back_inserter(out));
  }
  return out;
}

}  // namespace gonio
