#include "scene/plan/confidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "number/distributions.h"

namespace gonio::scene {
namespace {

/// Probability of at most k among n.
double at_most(std::size_t k, std::size_t n, double p) {
  return binomial_at_most(static_cast<double>(k), static_cast<double>(n), p);
}

}  // namespace

double exceedance_bound(std::size_t exceeding, std::size_t n, double confidence) {
  if (exceeding >= n) return 1;
  return beta_quantile(confidence, static_cast<double>(exceeding) + 1,
                       static_cast<double>(n - exceeding));
}

double exceedance_lower_bound(std::size_t exceeding, std::size_t n, double confidence) {
  return 1 - exceedance_bound(n - exceeding, n, confidence);
}

std::size_t draws_needed(double quantile, double confidence) {
  return static_cast<std::size_t>(std::ceil(std::log1p(-confidence) / std::log(quantile)));
}

double quantile_bound(std::vector<double>& values, double quantile, double confidence) {
  const std::size_t n = values.size();
  // Draw k of the order, from 0, lies below the quantile only where more than k of n do.
  std::size_t low = 0, high = n;
  while (low < high) {
    const std::size_t k = (low + high) / 2;
    if (at_most(k, n, quantile) >= confidence)
      high = k;
    else
      low = k + 1;
  }
  if (low >= n) return std::numeric_limits<double>::infinity();
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(low));
  return values[low];
}

double share_that_passes(double quantile, std::size_t n, double confidence) {
  // Most that may exceed.
  std::size_t most = 0, beyond = n + 1;
  if (exceedance_bound(0, n, confidence) > 1 - quantile) return 0;
  while (most + 1 < beyond) {
    const std::size_t x = (most + beyond) / 2;
    (exceedance_bound(x, n, confidence) <= 1 - quantile ? most : beyond) = x;
  }
  // Share by which at most so many do, with the confidence.
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double p = (low + high) / 2;
    (at_most(most, n, p) >= confidence ? low : high) = p;
  }
  return low;
}

}  // namespace gonio::scene
