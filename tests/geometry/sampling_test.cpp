#include "geometry/sampling.h"

#include <algorithm>

namespace gonio {
namespace {

TEST(Sampling, RadicalInverseMirrorsBinaryDigits) {
  EXPECT_EQ(radical_inverse(0), 0);
  EXPECT_EQ(radical_inverse(1), 0.5);
  EXPECT_EQ(radical_inverse(6), 0.375);  // 110 → 0.011
  EXPECT_EQ(radical_inverse(0xffffffff), 1 - 0x1p-32);
}

/// Moments of cos θ/π over the hemisphere: cos θ 2/3, x² 1/4, x 0.
TEST(Sampling, CosineDirectionsHaveItsMoments) {
  double z = 0, x2 = 0, x = 0;
  constexpr std::uint32_t n = 4096;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Direction d = cosine_direction(hammersley(i, n));
    EXPECT_NEAR(dot(d, d), 1, 1e-14);
    z += d.z / n;
    x2 += d.x * d.x / n;
    x += d.x / n;
  }
  EXPECT_NEAR(z, 2.0 / 3, 1e-3);
  EXPECT_NEAR(x2, 0.25, 1e-3);
  EXPECT_NEAR(x, 0, 1e-3);
}

TEST(Sampling, SpiralDirectionsAreEvenAndApart) {
  constexpr std::size_t n = 100;
  Direction sum{0, 0, 0};
  double nearest = 2;
  for (std::size_t i = 0; i < n; ++i) {
    const Direction d = spiral_direction(i, n);
    EXPECT_NEAR(dot(d, d), 1, 1e-14);
    sum = {sum.x + d.x, sum.y + d.y, sum.z + d.z};
    for (std::size_t k = 0; k < i; ++k)
      nearest = std::min(nearest, std::acos(dot(d, spiral_direction(k, n))));
  }
  EXPECT_LT(std::hypot(sum.x, sum.y, sum.z) / n, 0.01);
  EXPECT_GT(nearest, 0.25);  // n caps of 4π/n have the radius 0.2
}

TEST(Sampling, AFrameIsRightHandedAroundAnyNormal) {
  for (std::size_t i = 0; i < 50; ++i)
    for (const double turn : {0.0, 1.0}) {
      const Frame f(i < 48 ? spiral_direction(i, 48) : Direction{0, 0, i == 48 ? 1.0 : -1.0}, turn);
      EXPECT_NEAR(dot(f.x, f.x), 1, 1e-14);
      EXPECT_NEAR(dot(f.x, f.y), 0, 1e-14);
      EXPECT_NEAR(dot(f.x, f.z), 0, 1e-14);
      EXPECT_NEAR(f.x.y * f.y.z - f.x.z * f.y.y, f.z.x, 1e-14);
      EXPECT_NEAR(f.x.z * f.y.x - f.x.x * f.y.z, f.z.y, 1e-14);
      EXPECT_NEAR(f.x.x * f.y.y - f.x.y * f.y.x, f.z.z, 1e-14);
      const Direction d = direction(0.7, 2), back = f.inside(f.outside(d));
      EXPECT_NEAR(dot(back, d), 1, 1e-14);
    }
}

}  // namespace
}  // namespace gonio
