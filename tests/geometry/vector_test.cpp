#include "geometry/vector.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Vector, CrossIsPerpendicularAndRightHanded) {
  const Vector a{1, 2, 3}, b{-2, 0.5, 1}, c = cross(a, b);
  EXPECT_EQ(dot(a, c), 0);
  EXPECT_EQ(dot(b, c), 0);
  const Vector z = cross(Vector{1, 0, 0}, Vector{0, 1, 0});
  EXPECT_EQ(z.z, 1);
}

TEST(Vector, HasADirectionHoweverShortOrLongItIs) {
  for (const double size : {1e-300, 1.0, 1e300}) {
    const Direction d = direction(size * Vector{3, 0, -4});
    EXPECT_DOUBLE_EQ(d.x, 0.6);
    EXPECT_EQ(d.y, 0);
    EXPECT_DOUBLE_EQ(d.z, -0.8);
  }
}

}  // namespace
}  // namespace gonio
