// Mirror balls: lamps whose highlights they show, and what is refused.
#include "stack/mirror_ball.h"

#include <cmath>
#include <filesystem>
#include <vector>

#include "geometry/half_difference.h"
#include "refusal.h"
#include "stack/example.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

constexpr std::size_t width = 160, height = 150;
constexpr MirrorBall ball{70.3, 66.8, 60};

/// Photograph of a ball under a lamp of 3° across, each pixel the mean of 64 places in it; light beyond `most` is clipped.
Image photograph(const Direction& lamp, float strength = 50, float most = 1e9F) {
  Image i{width, height, {"R", "G", "B"}, {}, {}};
  i.planes.assign(3, std::vector<float>(width * height, 0.3F));
  const double edge = std::cos(1.5 * degree);
  constexpr int parts = 8;
  for (std::size_t t = 0; t < width * height; ++t) {
    float seen = 0;
    for (int k = 0; k < parts * parts; ++k) {
      const auto at = [&](std::size_t pixel, int part) {
        return static_cast<double>(pixel) + (part + 0.5) / parts;
      };
      const double x = (at(t % width, k % parts) - ball.x) / ball.radius,
                   y = (ball.y - at(t / width, k / parts)) / ball.radius, z2 = 1 - x * x - y * y;
      if (z2 < 0) continue;
      // The view is z: it leaves along 2 (n·z) n − z.
      const double z = std::sqrt(z2);
      const Direction r{2 * z * x, 2 * z * y, 2 * z2 - 1};
      seen += dot(r, lamp) > edge ? strength : 0.05F * static_cast<float>(2 + r.x + r.y);
    }
    for (auto& plane : i.planes)
      if (const double x = (static_cast<double>(t % width) + 0.5 - ball.x) / ball.radius,
          y = (static_cast<double>(t / width) + 0.5 - ball.y) / ball.radius;
          x * x + y * y < 1)
        plane[t] = std::min(most, seen / (parts * parts));
  }
  return i;
}

TEST(MirrorBall, ShowsWhereItsLampWas) {
  const Folder f;
  for (const double most : {1e9, 1.0})  // and clipped, as most photographs are
    for (const double theta : {0.0, 7.0, 30.0, 50.0, 70.0, 82.0})
      for (const double phi : {0.0, 100.0, -130.0, -47.0}) {
        const Direction lamp = direction(theta * degree, phi * degree);
        write_exr(f / "a.exr", photograph(lamp, 50, static_cast<float>(most)));
        const Direction found = lamp_of_ball(*open_image(f / "a.exr"), ball);
        const double off = std::acos(std::min(1.0, dot(found, lamp))) / degree;
        EXPECT_LT(off, most > 1 ? 0.3 : 0.7) << "of clipped light no edge is finer than a pixel "
                                             << theta << " " << phi << " " << most;
      }
}

TEST(MirrorBall, GivesAStackOfTheImagesInAFolder) {
  const Folder f;
  std::filesystem::create_directories(f / "photos");
  const Direction east = direction(40 * degree, 0), north = direction(40 * degree, 90 * degree);
  write_exr(f / "photos/b.exr", photograph(north));
  write_exr(f / "photos/a.exr", photograph(east));
  write_exr(f / "photos/dark.exr", photograph(east));
  f.write("photos/notes.txt", "no image");
  const Stack s =
      stack_of_ball(f / "photos", ball, f / "stack.json", false, {f / "photos/dark.exr"});
  ASSERT_EQ(s.images.size(), 2U);
  EXPECT_EQ(s.images[0].path, "photos/a.exr");
  EXPECT_EQ(s.images[1].path, "photos/b.exr");
  EXPECT_GT(direction_of(s.images[0].light)->x, 0.63);
  EXPECT_GT(direction_of(s.images[1].light)->y, 0.63);
  EXPECT_EQ(s.values, StackValues::f_r_cosine);
}

TEST(MirrorBall, IsRefusedWhereItShowsNoLamp) {
  const Folder f;
  const auto line = [&](const Image& i, const MirrorBall& at) {
    write_exr(f / "a.exr", i);
    return refusal([&] { lamp_of_ball(*open_image(f / "a.exr"), at); });
  };
  const Image lit = photograph(direction(30 * degree, 0));
  EXPECT_EQ(line(lit, ball), "") << "the ruler";
  EXPECT_HAS(line(lit, {70, 66, 90}), "found an image of 160 × 150, expected a ball within it");
  EXPECT_HAS(line(lit, {70, 66, NAN}), "a ball within it");
  EXPECT_HAS(line(photograph(direction(30 * degree, 0), 0.1F), ball), "a small highlight");
  Image dark = lit;
  for (auto& plane : dark.planes) plane.assign(plane.size(), 0);
  EXPECT_HAS(line(dark, ball), "found 0 of its");
  EXPECT_HAS(line(photograph({std::sqrt(0.75), 0, -0.5}), ball), "a lamp below the surface");
  EXPECT_HAS(refusal([&] { stack_of_ball(f / "nothing", ball, f / "stack.json", false, {}); }),
             "nothing: images");
}

}  // namespace
}  // namespace gonio
