// Short descents end at the bottom of the valley that they begin in.
#include "fitting/solve/descend.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// A width whose cost has a valley at every 23rd part of the one before, the lowest at 1: residuals sin ln x and 0.05 ln x.
NormalEquations valleys(const std::vector<double>& x) {
  const double u = std::log(x[0]), j[]{std::cos(u) / x[0], 0.05 / x[0]}, r[]{std::sin(u), 0.05 * u};
  return {
      {j[0] * j[0] + j[1] * j[1]}, {j[0] * r[0] + j[1] * r[1]}, (r[0] * r[0] + r[1] * r[1]) / 2};
}

/// End of a descent of a width, whose origin is 0, from exp(u), as a logarithm.
double end_from(double u) {
  constexpr std::array origin{0.0};
  std::vector<double> x{std::exp(u)};
  EXPECT_TRUE(descend(valleys, x, {{1e-9}, {1e9}}, {60, 1e-9}, origin).settled) << u;
  return std::log(x[0]);
}

TEST(Descend, EndsAtTheBottomOfTheValleyThatItBeginsIn) {
  for (const double u : {-1.4, -0.7, 0.3, 0.9, 1.4}) {
    EXPECT_NEAR(end_from(u), 0, 1e-3) << u;
    // The valley of u near π is not the lowest one; it has a bottom all the same.
    EXPECT_NEAR(end_from(3 + u), end_from(3), 1e-3) << u;
  }
}

}  // namespace
}  // namespace gonio
