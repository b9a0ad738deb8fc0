#include "scene/trace/camera.h"

#include "constants.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

using gonio::test::pi;

double camera_off(const Direction& a, const Direction& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(Camera, LooksAtItsTargetInTheMiddleAndByHalfItsAngleToTheEdges) {
  const Camera c{{0, 2, 5}, {0, 2, 1}, {0, 3, 0}, 60};
  EXPECT_LT(camera_off(ray(c, 0.5, 0.5, 2).direction, {0, 0, -1}), 1e-15);
  EXPECT_EQ(ray(c, 0.5, 0.5, 2).origin.y, 2);
  const double half = std::tan(pi / 6);  // top left first
  EXPECT_LT(camera_off(ray(c, 0.5, 0, 2).direction, direction(Vector{0, half, -1})), 1e-15);
  EXPECT_LT(camera_off(ray(c, 0, 0.5, 2).direction, direction(Vector{-2 * half, 0, -1})), 1e-15);
  EXPECT_LT(camera_off(ray(c, 1, 1, 2).direction, direction(Vector{2 * half, -half, -1})), 1e-15);
}

TEST(Camera, GoesAroundItsTargetAndOverIt) {
  const Orbit o{{1, 2, 3}, 4, {{0, 90}, {-30, 90}}};
  for (const double elevation : {-90.0, -30.0, 0.0, 89.9, 90.0}) {
    const Camera c = camera_of(o, elevation, 90);
    const Vector from = c.position - o.target;
    EXPECT_NEAR(length(from), 4, 1e-12);
    EXPECT_NEAR(from.y, 4 * std::sin(elevation * degree), 1e-12);
    EXPECT_NEAR(from.z, 0, 1e-12);
    EXPECT_NEAR(dot(c.up, from), 0, 1e-12);
    EXPECT_GE(c.up.y, -1e-12);
    EXPECT_LT(camera_off(ray(c, 0.5, 0.5, 1).direction, direction(-1 * from)), 1e-12);
  }
}

TEST(Camera, IsDrawnFromTheWholeRangeAndStandsInItsMiddle) {
  const Orbit o{{1, 2, 3}, 4, {{10, 50}, {-90, 30}}};
  Draws draw(1);
  double low = 90, high = -90, sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector from = draw_camera(o, draw).position - o.target;
    const double elevation = std::asin(from.y / 4) / degree,
                 azimuth = std::atan2(from.x, from.z) / degree;
    low = std::min(low, elevation);
    high = std::max(high, elevation);
    sum += azimuth / 1000;
    EXPECT_GE(azimuth, -90 - 1e-9);
    EXPECT_LE(azimuth, 30 + 1e-9);
  }
  EXPECT_GE(low, 10 - 1e-9);
  EXPECT_LT(low, 11);
  EXPECT_LE(high, 50 + 1e-9);
  EXPECT_GT(high, 49);
  EXPECT_NEAR(sum, -30, 5 * 120 / std::sqrt(12.0 * 1000));
  const Vector middle = middle_camera(o).position - o.target;
  EXPECT_NEAR(std::asin(middle.y / 4) / degree, 30, 1e-9);
  EXPECT_NEAR(std::atan2(middle.x, middle.z) / degree, -30, 1e-9);
  const Camera fixed{{1, 2, 3}, {0, 0, 0}};
  EXPECT_EQ(draw_camera(fixed, draw).position.y, 2);
  EXPECT_EQ(middle_camera(fixed).position.y, 2);
}

TEST(PicturePart, HoldsWhatIsSeenOfASphereAndLittleElse) {
  const Camera camera{{1, 2, 9}, {0.5, 0, 0}, {0, 1, 0}, 30};
  Draws draw(3);
  for (const double radius : {0.01, 0.3, 2.0, 20.0})
    for (const Vector& center : {Vector{0, 0, 0}, Vector{2, 1, 3}, Vector{-3, -2, 8.8},
                                 Vector{1, 2, 30}, Vector{1.3, 2, 9}}) {
      const auto part = part_around(camera, 1.5, center, radius);
      double x0 = 1, x1 = 0, y0 = 1, y1 = 0;
      for (int i = 0; i < 4000; ++i) {
        const double x = part.x - 0.02 + (part.width + 0.04) * draw.uniform();
        const double y = part.y - 0.02 + (part.height + 0.04) * draw.uniform();
        if (x < 0 || x > 1 || y < 0 || y > 1) continue;
        const Ray r = ray(camera, x, y, 1.5);
        const Vector to = center - r.origin;
        const double along = dot(to, vector_of(r.direction));
        const Vector beside = to - along * vector_of(r.direction);
        if (!(along > 0 || dot(to, to) < radius * radius) || dot(beside, beside) > radius * radius)
          continue;
        EXPECT_TRUE(part.holds(x, y)) << radius << ": " << x << " " << y;
        x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
      }
      if (radius == 0.3 && center.x == 0) {
        EXPECT_NEAR(x1 - x0, part.width, 0.1 * part.width);
        EXPECT_NEAR(y1 - y0, part.height, 0.1 * part.height);
      }
    }
}

}  // namespace
}  // namespace gonio::scene
