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
/// The value in the middle, of an even number the mean of the two there; reorders them.  \param values  not empty, no NaN
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace gonio
