#include "integrate/light/environment.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "geometry/sampling.h"
#include "integrate/light/irradiance.h"
#include "integrate/lights.h"

namespace gonio {
namespace {

using test::pi;

/// A cone of cosines to the power p about a direction, and a constant.
Gather cone(const Direction& n, double p) {
  return [=](std::span<const Direction> at, std::span<double* const> out) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      out[0][i] = std::pow(std::max(dot(n, at[i]), 0.0), p);
      out[1][i] = 1;
    }
  };
}

TEST(GatheredEnvironment, OfEvenLightIsTheFunctionsIntegral) {
  const SummedEnvironment even(test::gradient(4, {0, 0, 0}));
  for (const double p : {1.0, 1e5})
    for (std::size_t i = 0; i < 3; ++i) {
      const Direction n = spiral_direction(i, 3);
      const auto g = gather(even, cone(n, p), 2, {n, n, 1 / std::sqrt(p)}, {3e-4, 1'000'000});
      EXPECT_LE(g.error, 3e-4);
      for (const double v : g.value[0]) EXPECT_NEAR(v / (2 * pi / (p + 1)), 1, g.error) << p;
      for (const double v : g.value[1]) EXPECT_NEAR(v / (2 * pi), 1, g.error);
    }
}

/// The cosine's is the irradiance, for which there is a closed form by texel.
TEST(GatheredEnvironment, OfTexelsIsExactToItsError) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Environment map = test::random_texels(16, seed);
    const SummedEnvironment light(map);
    const Direction n = spiral_direction(seed, 4);
    const Rgb truth = irradiance(map, n);
    for (const double goal : {1e-2, 1e-3}) {
      const auto g = gather(light, cone(n, 1), 2, {n, n, 1}, {goal, 1'000'000});
      EXPECT_LE(g.error, goal);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(g.value[0][c] / truth[c], 1, g.error) << seed << " " << goal;
    }
  }
}

/// A sun that fills one texel, among others that are black or dim, and the same light in texels a fourth as wide.
TEST(GatheredEnvironment, SeesThatALoneTexelIsNoPoint) {
  constexpr std::size_t height = 64, x = 37, y = 22;
  for (const float dim : {0.0F, 1e-3F}) {
    const auto sun = [&](std::size_t parts) {
      const std::size_t h = height * parts, w = 2 * h;
      Environment map{w, h, std::vector<std::array<float, 3>>(w * h, {dim, dim, dim})};
      for (std::size_t j = y * parts; j < (y + 1) * parts; ++j)
        for (std::size_t i = x * parts; i < (x + 1) * parts; ++i)
          map.radiance[j * w + i] = {1e4, 2e4, 3e4};
      return map;
    };
    const Environment coarse = sun(1);
    const SummedEnvironment light(coarse), finer(sun(4));
    for (const double p : {10.0, 40.0, 1000.0})
      for (const double off : {0.5, 1.0, 3.2}) {
        const Direction n = direction(coarse.theta(y + 0.5), coarse.phi(x + off));
        const Focus focus{n, n, 1 / std::sqrt(p)};
        const auto truth = gather(finer, cone(n, p), 2, focus, {5e-5, 4'000'000});
        for (const double goal : {1e-2, 1e-3}) {
          const auto g = gather(light, cone(n, p), 2, focus, {goal, 1'000'000});
          EXPECT_LE(g.error, goal);
          for (const std::size_t f : {0, 1})
            EXPECT_NEAR(g.value[f][0] / truth.value[f][0], 1, g.error + truth.error)
                << p << " " << off << " " << goal << " " << dim;
        }
      }
  }
}

TEST(GatheredEnvironment, OfNothingIsNothing) {
  Environment black{8, 4, std::vector<std::array<float, 3>>(32)};
  const auto dark = gather(SummedEnvironment(black), cone({}, 1), 2, {{}, {}, 1});
  EXPECT_EQ(dark.value[0], Rgb{});
  EXPECT_EQ(dark.error, 0);
  // light from below alone
  black.radiance[31] = {1, 1, 1};
  EXPECT_EQ(gather(SummedEnvironment(black), cone({}, 1), 2, {{}, {}, 1}).value[0], Rgb{});
}

TEST(GatheredEnvironment, SaysWhatErrorIsLeftWhereItMayNotGoOn) {
  const SummedEnvironment light(test::random_texels(16, 7));
  const auto g = gather(light, cone({}, 50), 2, {{}, {}, 0.1}, {1e-9, 5'000});
  EXPECT_GT(g.error, 1e-9);
  EXPECT_LT(g.evaluations, 20'000U);
}

}  // namespace
}  // namespace gonio
