#include "integrate/light/prefiltered.h"

#include <cmath>
#include <numbers>

#include "geometry/sampling.h"
#include "integrate/light/irradiance.h"
#include "integrate/light/split_sum_light.h"
#include "integrate/lights.h"
#include "support.h"

namespace gonio {
namespace {

constexpr std::size_t views = 12;

TEST(Prefiltered, IsExactUnderEvenLightOfAnySize) {
  for (const std::size_t height : {1, 3, 300}) {
    const LightPyramid even(test::gradient(height, {0, 0, 0}));
    for (const double alpha : {0.05, 0.7}) {
      const auto light = prefiltered(even, alpha);
      for (std::size_t i = 0; i < views; ++i)
        EXPECT_NEAR(light(spiral_direction(i, views))[1], 1, 1e-6);
    }
    EXPECT_NEAR(mean_radiance(even)({0, 0, -1})[1], 1, 1e-6);
  }
}

TEST(LightPyramid, KeepsAllLightInEveryLevel) {
  const auto map = test::random_texels(48, 3);
  const LightPyramid light(map);
  ASSERT_GT(light.levels().size(), 5U);
  const auto sum_of = [](const LightPyramid::Level& l) {
    double flux = 0, solid_angle = 0;
    for (const auto& p : l.patch) {
      flux += p.flux[0];
      solid_angle += p.solid_angle;
    }
    return std::pair(flux, solid_angle);
  };
  const auto [flux, all] = sum_of(light.levels()[0]);
  EXPECT_NEAR(all, 4 * std::numbers::pi, 1e-12);
  for (const auto& l : light.levels()) {
    EXPECT_NEAR(sum_of(l).first, flux, 1e-9 * flux);
    EXPECT_NEAR(sum_of(l).second, all, 1e-9);
  }
}

/// The mirror directions of lit_views() at NoV = 1 are the normals.
TEST(Prefiltered, IsTheIntegralUnderASun) {
  for (const double roughness : {0.3, 0.6, 0.9}) {
    const auto map = test::random_texels(64, 5);
    const auto exact =
        lit_views(SummedEnvironment(map), "smith_ggx.correlated", roughness, 1, views);
    const auto light = prefiltered(LightPyramid(map), roughness * roughness);
    for (std::size_t i = 0; i < views; ++i) {
      const auto found = light(spiral_direction(i, views));
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c] / exact[i].prefiltered[c], 1, 0.03) << roughness << " view " << i;
    }
  }
}

TEST(MeanRadiance, IsTheIrradianceOverPi) {
  const auto map = test::random_texels(64, 5);
  const auto mean = mean_radiance(LightPyramid(map));
  for (std::size_t i = 0; i < views; ++i) {
    const Direction n = spiral_direction(i, views);
    const auto exact = irradiance(map, n);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(mean(n)[c] / (exact[c] / std::numbers::pi), 1, 0.03) << i;
  }
}

}  // namespace
}  // namespace gonio
