#include "image/lit_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/vector.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr std::size_t size = 40;

/// Normal in the middle of a pixel, worked out anew.
Vector normal(std::size_t pixel) {
  const double half = size / 2.0, r = LitSphere::radius * half;
  const double x = (static_cast<double>(pixel % size) + 0.5 - half) / r;
  const double y = (half - static_cast<double>(pixel / size) - 0.5) / r;
  return {x, y, std::sqrt(1 - x * x - y * y)};
}

TEST(LitSphere, OfALambertianIsTheSumOfCosinesToItsLights) {
  for (const auto& light : sphere_lights()) {
    const LitSphere sphere(light.towards, size);
    const double f = 0.3 / std::numbers::pi;
    const auto radiance = sphere.radiance(std::vector<Rgb>(sphere.points.size(), {f, f / 2, 0}));
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      double cosines = 0;
      if (sphere.inside[i])
        for (const auto& l : light.towards) cosines += std::max(dot(normal(i), vector_of(l)), 0.0);
      EXPECT_NEAR(radiance[i][0], f * cosines, 1e-14) << light.name << ", pixel " << i;
      EXPECT_NEAR(radiance[i][1], f / 2 * cosines, 1e-14);
      EXPECT_EQ(radiance[i][2], 0);
    }
  }
}

TEST(LitSphere, TakesADiscOfItsPicture) {
  const LitSphere sphere(sphere_lights()[0].towards, 200);
  const auto inside = static_cast<double>(std::ranges::count(sphere.inside, true));
  EXPECT_NEAR(inside / (200 * 200), std::numbers::pi / 4 * LitSphere::radius * LitSphere::radius,
              1e-3);
}

TEST(LitSphere, KeepsTheAnglesBetweenLightViewerAndNormal) {
  for (const auto& light : sphere_lights())
    for (const auto& l : light.towards) {
      const LitSphere sphere(std::span(&l, 1), size);
      ASSERT_FALSE(sphere.points.empty());
      for (const auto& p : sphere.points) {
        EXPECT_NEAR(dot(p.at.wi, p.at.wo), l.z, 1e-14);
        EXPECT_NEAR(p.at.wo.z, normal(p.pixel).z, 1e-14);
        EXPECT_GT(p.at.wi.z, 0);
      }
    }
}

TEST(LitSphere, HasALevelTangentToTheRight) {
  const Direction up{0, 1, 0}, right{1, 0, 0};
  for (const auto& p : LitSphere(std::span(&up, 1), size).points) EXPECT_NEAR(p.at.wi.x, 0, 1e-14);
  for (const auto& p : LitSphere(std::span(&right, 1), size).points) EXPECT_GT(p.at.wi.x, 0);
}

TEST(LitSphere, IsDarkWhereItsLightIsBehind) {
  const Direction back{0, 0, -1}, side = direction(Vector{1, 0, -1});
  EXPECT_TRUE(LitSphere(std::span(&back, 1), size).points.empty());
  const LitSphere sphere(std::span(&side, 1), size);
  ASSERT_FALSE(sphere.points.empty());
  for (const auto& p : sphere.points) EXPECT_GT(normal(p.pixel).x, normal(p.pixel).z);
}

TEST(LitSphere, DoesNotKnowAPixelOneOfWhoseLightsIsNotKnown) {
  const LitSphere sphere(sphere_lights()[0].towards, size);
  std::vector<Rgb> f(sphere.points.size(), {1, 1, 1});
  const std::size_t unknown = f.size() / 2;
  f[unknown].fill(std::numeric_limits<double>::quiet_NaN());
  const auto radiance = sphere.radiance(f);
  for (std::size_t i = 0; i < radiance.size(); ++i)
    EXPECT_EQ(std::isnan(radiance[i][0]), i == sphere.points[unknown].pixel);
}

}  // namespace
}  // namespace gonio
