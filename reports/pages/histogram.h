#pragma once
/// \file
/// How many values lie where, as a curve of steps.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "reports/picture/figure.h"

namespace gonio {

/// Counts of the values in bins that are equally wide from `low` to `high`, or equally many times as wide (log); values outside are left out.
inline FigureCurve histogram_curve(std::string name,
                                   const std::vector<double>& values,
                                   double low,
                                   double high,
                                   std::size_t bins,
                                   bool log = false) {
  const auto to = [&](double v) { return log ? std::log(v) : v; };
  const auto from = [&](double v) { return log ? std::exp(v) : v; };
  low = to(low), high = to(high);
  if (high - low < 1e-9) low -= 0.5, high += 0.5;
  std::vector<double> count(bins);
  const double step = (high - low) / static_cast<double>(bins);
  for (const double v : values)
    if (to(v) >= low && to(v) <= high)
      ++count[std::min(bins - 1, static_cast<std::size_t>((to(v) - low) / step))];
  FigureCurve c{std::move(name), {}, {}};
  for (std::size_t i = 0; i < bins; ++i)
    for (const double end : {0.0, 0.999}) {
      c.x.push_back(from(low + (static_cast<double>(i) + end) * step));
      c.y.push_back(count[i]);
    }
  return c;
}

}  // namespace gonio
