#include "geometry/direction.h"

#include <limits>

namespace gonio {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

TEST(Direction, IsBuiltFromZenithAndAzimuth) {
  const auto x = direction(90 * degree, 0), y = direction(90 * degree, 90 * degree);
  EXPECT_NEAR(x.x, 1, rounding);
  EXPECT_NEAR(x.y, 0, rounding);
  EXPECT_NEAR(y.y, 1, rounding);
  EXPECT_NEAR(y.x, 0, rounding);
  EXPECT_EQ(direction(0, 1).z, 1);
}

TEST(Direction, GivesItsAnglesBackEvenAtThePole) {
  for (const double theta : {0.0, 1e-200, 1e-12, 1e-5, 0.3, 1.57, 2.0, 3.14})
    for (const double phi : {-3.0, -0.5, 0.0, 1e-9, 2.5}) {
      const auto d = direction(theta, phi);
      EXPECT_NEAR(theta_of(d), theta, 4 * rounding * theta);
      if (theta > 0) {
        EXPECT_NEAR(phi_of(d), phi, 4 * rounding * std::abs(phi));
      }
    }
  EXPECT_EQ(phi_of(direction(0, 0)), 0);
}

}  // namespace
}  // namespace gonio
