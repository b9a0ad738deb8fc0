#include "integrate/light/irradiance.h"

#include <cmath>

#include "constants.h"
#include "geometry/sampling.h"
#include "integrate/lights.h"

namespace gonio {
namespace {

using test::pi;

/// L = 1 + z:  E(n) = π + 2π/3 n_z
const Radiance sky = [](const Direction& d) { return Rgb{1 + d.z, 1 + d.z, 1 + d.z}; };
Rgb of_sky(const Direction& n) {
  const double e = pi + 2 * pi / 3 * n.z;
  return {e, e, e};
}
const Radiance even = [](const Direction&) { return Rgb{1, 1, 1}; };

TEST(Irradiance, OfEvenLightIsPi) {
  for (const std::size_t height : {1U, 3U, 32U}) {
    const auto map = test::gradient(height, {0, 0, 0});
    for (std::size_t i = 0; i < 7; ++i)
      for (const double v : irradiance(map, spiral_direction(i, 7))) EXPECT_NEAR(v, pi, 1e-5);
    for (const double z : {1.0, -1.0}) EXPECT_NEAR(irradiance(map, {0, 0, z})[0], pi, 1e-12);
  }
}

TEST(Irradiance, OfAGradientComesToTheClosedFormAsTexelsShrink) {
  const Direction d = direction(1, 2);
  double before = 1;
  for (const std::size_t height : {8U, 32U, 128U}) {
    const auto map = test::gradient(height, d);
    double worst = 0;
    for (std::size_t i = 0; i < 9; ++i) {
      const Direction n = spiral_direction(i, 9);
      const Rgb e = irradiance(map, n);
      worst = std::max({worst, std::abs(e[0] - pi - 2 * pi / 3 * dot(n, d)),
                        std::abs(e[2] - pi + 2 * pi / 3 * dot(n, d))});
    }
    EXPECT_LT(worst, before / 14) << height;
    before = worst;
  }
}

TEST(Irradiance, OfOneTexelIsItsSolidAngleTimesTheCosine) {
  Environment map{64, 32, std::vector<std::array<float, 3>>(64 * 32)};
  map.radiance[10 * 64 + 5] = {1, 2, 3};
  const double theta = map.theta(10.5), phi = map.phi(5.5);
  const double omega = 2 * pi / 64 * (std::cos(map.theta(10)) - std::cos(map.theta(11)));
  for (std::size_t i = 0; i < 9; ++i) {
    const Direction n = spiral_direction(i, 9);
    const double cosine = dot(n, direction(theta, phi));
    if (std::abs(cosine) < 0.1) continue;
    const Rgb e = irradiance(map, n);
    EXPECT_NEAR(e[0], omega * std::max(cosine, 0.0), 1e-3 * omega);
    EXPECT_NEAR(e[2], 3 * e[0], 1e-15);
  }
}

TEST(SampledIrradiance, EachRuleComesToTheClosedFormOfASky) {
  constexpr std::size_t counts[] = {64, 1024, 16384};
  const auto rows = irradiance_errors(sky, of_sky, counts, 8);
  ASSERT_EQ(rows.size(), 9U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& e = rows[k];
    EXPECT_EQ(e.samples, counts[k % 3]);
    EXPECT_LE(std::abs(e.bias), e.rms + 1e-15);
    EXPECT_LE(e.rms, e.max);
    if (k % 3 > 0) {
      EXPECT_LT(e.rms, rows[k - 1].rms / 6) << name_of(e.rule);
    }
  }
  EXPECT_EQ(rows[0].rule, IrradianceRule::riemann);
  EXPECT_EQ(rows[3].rule, IrradianceRule::riemann_midpoint);
  EXPECT_EQ(rows[6].rule, IrradianceRule::cosine);
}

/// As if only normals from 0.2 below the horizon upwards had any light: six of ten.
TEST(SampledIrradiance, IsNotJudgedWhereNoLightComes) {
  constexpr std::size_t counts[] = {1024};
  const auto of_upper = [](const Direction& n) {
    const double e = n.z > -0.2 ? pi : 0;
    return Rgb{e, e, e};
  };
  for (const auto& e : irradiance_errors(even, of_upper, counts, 10)) {
    EXPECT_EQ(e.normals, 6U) << name_of(e.rule);
    EXPECT_LT(e.max, 0.01);
  }
  const auto black = [](const Direction&) { return Rgb{}; };
  for (const auto& e : irradiance_errors(black, black, counts, 4)) {
    EXPECT_EQ(e.normals, 0U);
    for (const double v : {e.rms, e.max, e.bias}) EXPECT_TRUE(std::isnan(v)) << name_of(e.rule);
  }
}

TEST(SampledIrradiance, TheCosineIsExactForEvenLight) {
  EXPECT_NEAR(sampled_irradiance(even, {}, IrradianceRule::cosine, 7).value[0], pi, 1e-14);
}

}  // namespace
}  // namespace gonio
