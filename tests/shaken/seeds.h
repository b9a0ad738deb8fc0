#pragma once
/// \file
/// Results of the program rounded at random (number/shaken.h), from several seeds: by as much as they differ, no digit
/// of them was known.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "brdf/kernel/kernels.h"
#include "number/shaken.h"

#include <gtest/gtest.h>

/// Nothing to look at in a build whose kernels round to nearest.
#define GONIO_NEEDS_SHAKEN()                        \
  if (gonio::instruction_sets().back() != "shaken") \
  GTEST_SKIP() << "nothing is shaken but in a build of the preset 'shaken'"

namespace gonio::test {

/// Results of `run` by seed.
auto by_seed(auto&& run) {
  std::vector<decltype(run())> results;
  for (shaken_seed = 1; shaken_seed <= 8; ++shaken_seed) results.push_back(run());
  shaken_seed = 0;
  return results;
}

/// A figure of several results: its mean and how far apart they are.
struct Spread {
  double mean = 0, width = 0;

  template <class Result>
  Spread(const std::vector<Result>& results, auto&& figure) {
    double low = figure(results[0]), high = low;
    for (const auto& r : results) {
      const double x = figure(r);
      mean += x / static_cast<double>(results.size());
      low = std::min(low, x);
      high = std::max(high, x);
    }
    width = high - low;
  }
  /// Decimal digits that they share; those of double where they are equal.
  double digits() const { return width > 0 ? std::log10(std::abs(mean) / width) : 16; }
};

}  // namespace gonio::test
