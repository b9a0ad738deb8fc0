// The half vector where light and view are almost opposite: all that is left of their sum is in its
// last digits.
#include "geometry/half_vector.h"

#include <cmath>

#include "number/half.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

template <class B>
FrameAngles<double> angles_in(const Coordinates<double>& l, const Coordinates<double>& v) {
  const auto in = [](const Coordinates<double>& d) {
    return Coordinates<B>{static_cast<B>(d.x), static_cast<B>(d.y), static_cast<B>(d.z)};
  };
  const auto a = angles_between<B>(in(l), in(v));
  const auto out = [](const B& x) { return static_cast<double>(x); };
  return {{out(a.nol), out(a.nov), out(a.noh), out(a.voh), out(a.sin2_theta_h)},
          out(a.xoh),
          out(a.yoh),
          out(a.xol),
          out(a.yol),
          out(a.xov),
          out(a.yov)};
}

/// A coordinate as a half holds it.
double h(double x) {
  return static_cast<double>(Half(x));
}

TEST(HalfVector, OfAlmostOppositeDirectionsKeepsTheDigitsOfHalf) {
  for (const double height : {3e-4, 1e-3, 4e-3, 0.02, 0.1})
    for (const double aside : {0.0, 5e-4, 1e-3, 0.01}) {
      const Coordinates<double> l{h(0.8), h(0.6), h(height)},
          v{h(-0.8) + h(aside), h(-0.6), h(height * 1.5)};
      const Coordinates<double> rounded{h(v.x), v.y, v.z};
      const auto half = angles_in<Half>(l, rounded), truth = angles_in<double>(l, rounded);
      EXPECT_NEAR(half.noh, truth.noh, 0.004 * truth.noh) << height << " " << aside;
      EXPECT_NEAR(half.voh, truth.voh, 0.004 * truth.voh) << height << " " << aside;
      EXPECT_NEAR(half.sin2_theta_h, truth.sin2_theta_h, 0.004 * truth.sin2_theta_h + 1e-7);
      EXPECT_NEAR(half.xoh, truth.xoh, 0.004 * std::abs(truth.xoh)) << height << " " << aside;
    }
}

TEST(HalfVector, OfAlmostOppositeDirectionsIsThatOfTheirCoordinatesToTheLastDigits) {
  constexpr double eps = 2.3e-16;
  for (double height = 1e-12; height < 0.1; height *= 7)
    for (const double aside : {0.0, 1e-13, 1e-9, 1e-4}) {
      const Coordinates<double> l{0.8, 0.6, height}, v{-0.8 + aside, -0.6, height * 1.5};
      const auto a = angles_between<double>(l, v);
      using L = long double;
      const L x = L(l.x) + v.x, y = L(l.y) + v.y, z = L(l.z) + v.z;
      const L length2 = x * x + y * y + z * z, length = std::sqrt(length2);
      const auto near = [&](double value, L truth) {
        EXPECT_LE(std::abs(value - truth), 4 * eps * std::abs(truth)) << height << " " << aside;
      };
      near(a.noh, z / length);
      near(a.voh, length / 2);
      near(a.sin2_theta_h, (x * x + y * y) / length2);
      near(a.xoh, x / length);
    }
}

TEST(HalfVector, OfOppositeDirectionsIsNone) {
  const auto a = angles_between<double>({0.6, 0, 0.0}, {-0.6, 0, 0.0});
  EXPECT_EQ(a.noh, 0);
  EXPECT_EQ(a.voh, 0);
  EXPECT_EQ(a.sin2_theta_h, 1);
}

}  // namespace
}  // namespace gonio
