#include "scene/plan/samples.h"

#include <cmath>
#include <numbers>

#include "refusal.h"
#include "scene/plan/scenes.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

/// Points are seen where the picture shows them: drawing where the objects are changes neither their share nor what is seen.
TEST(PointDrawer, SeesSmallSpheresAsItWouldOverTheWholePicture) {
  Scene s = test::sphere(test::chalk(), test::front());
  s.objects = {{Sphere{{0.3, 0, 0}, 0.2}, 0}, {Sphere{{0.45, 0.1, 0}, 0.2}, 0}};  // they overlap
  const Lit lit(s);
  const auto small = lit.drawer(0, 1).coverage();
  const double r = 0.2, apart = std::hypot(0.15, 0.1), side = 20 * std::tan(7 * degree),
               both = 2 * r * r * std::acos(apart / (2 * r)) -
                      apart / 2 * std::sqrt(4 * r * r - apart * apart);
  EXPECT_NEAR(small, (2 * std::numbers::pi * r * r - both) / (side * side), 0.03 * small);
  s.objects.push_back({Sphere{{0, 0, -40}, 0.01}, 0});  // seen in no pixel
  s.objects.push_back({Sphere{{0, 0, 40}, 8}, 0});      // behind the camera
  EXPECT_NEAR(Lit(s).drawer(0, 1).coverage(), small, 0.02 * small);
}

/// Where objects lie over each other their points are drawn from around them all: no look is thrown away for each of them.
TEST(PointDrawer, SeesSpheresThatLieOverEachOtherAsOne) {
  Scene s = test::sphere(test::chalk(), test::front());
  s.objects = {{Sphere{{0.3, 0, 0}, 0.2}, 0}};
  const double one = Lit(s).drawer(0, 1).coverage();
  for (int i = 0; i < 99; ++i) s.objects.push_back(s.objects[0]);
  EXPECT_NEAR(Lit(s).drawer(0, 1).coverage(), one, 0.02 * one);
}

TEST(PointDrawer, TakesFewLooksForAPointOfASmallSphere) {
  Scene s = test::sphere(test::chalk(), test::front());
  s.objects = {{Sphere{{0.3, 0.2, 0}, 0.002}, 0}};
  // Over the whole picture one look in 400 000 would meet it, and none of a point's 20 000 might.
  EXPECT_EQ(Lit(s).drawer(0, 1).draw(1, 0, 512).count, 512U);
}

TEST(PointDrawer, GivesManyLightsFewerDirectionsAndRefusesMore) {
  const RectangleLight lamp{{0, 5, 0}, {0.1, 0, 0}, {0, 0, -0.1}, {1, 1, 1}};
  Scene s = test::sphere(test::chalk(), {});
  const auto directions = [&](std::size_t lights) {
    s.lights.assign(lights, Light{lamp});
    return Lit(s).drawer(0, 64).directions();
  };
  EXPECT_EQ(directions(1), 64U);
  EXPECT_EQ(directions(8), 64U);
  EXPECT_EQ(directions(128), 4U);
  EXPECT_HAS(gonio::test::refusal([&] { directions(129); }),
             "129 with an extent, 0 without, expected at most 512 in a plan");
  // Points of a stricter tolerance are more, and their rows are kept, too.
  s.tolerance.quantile = 0.9998;
  EXPECT_EQ(directions(8), 8U);
  EXPECT_HAS(gonio::test::refusal([&] { directions(18); }), "at most 70 in a plan");
  s.tolerance = {};
  s.lights.assign(512, test::light({0, 0, 1}));
  EXPECT_EQ(Lit(s).drawer(0, 64).directions(), 0U);
  s.lights.push_back(test::light({0, 0, 1}));
  EXPECT_HAS(gonio::test::refusal([&] { Lit{s}; }), "0 with an extent, 513 without");
}

}  // namespace
}  // namespace gonio::scene
