#pragma once
/// \file
/// Robust statistics of a bag of numbers.

#include <algorithm>
#include <cmath>
#include <vector>

namespace gonio {

/// The q-th quantile, one of the values themselves; reorders them.  \param values  not empty, no NaN
inline double quantile(std::vector<double>& values, double q) {
  const auto k = std::lround(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}
inline double median(std::vector<double>& values) {
  return quantile(values, 0.5);
}

}  // namespace gonio
