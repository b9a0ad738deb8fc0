#include "scene/plan/bounds.h"

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "image/colour_difference.h"
#include "image/display.h"
#include "many_fits.h"
#include "scene/plan/difference.h"
#include "scene/plan/reference.h"
#include "scene/plan/scenes.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

TEST(ReachedAngles, OfAPointAreThoseBetweenLightAndViewer) {
  Scene s = test::sphere(test::chalk(), {test::light({0, std::sin(1.0), std::cos(1.0)})});
  std::get<Sphere>(s.objects[0].shape).radius = 1e-9;
  const auto reached = reached_angles(s, s.objects[0]);
  EXPECT_NEAR(reached.voh.low, std::cos(0.5), 1e-9);
  EXPECT_NEAR(reached.voh.high, std::cos(0.5), 1e-9);
}

TEST(ReachedAngles, HoldEverythingThatAViewerSees) {
  Scene s = test::sphere(test::chalk(), test::front());
  s.lights.push_back(RectangleLight{{1, 3, 2}, {.5, 0, 0}, {0, 0, .7}, {1, 1, 1}});
  s.lights.push_back(DirectionalLight{DirectionalLight::Ranging{{{10, 30}, {-20, 40}}}, {1, 1, 1}});
  s.view = Orbit{{.1, 0, 0}, 6, {{-10, 20}, {100, 120}}};
  const auto reached = reached_angles(s, s.objects[0]);
  EXPECT_LT(reached.voh.high, 1);
  const Lit lit(s);
  const auto points = lit.drawer(0, 4).draw(9, 0, gonio::test::few(20'000, 500));
  ASSERT_GT(points.angles.size(), 500U);
  double low = 1, high = 0;
  for (const auto& a : points.angles) {
    low = std::min(low, a.voh);
    high = std::max(high, a.voh);
  }
  EXPECT_GE(low, reached.voh.low);
  EXPECT_LE(high, reached.voh.high);
  EXPECT_LT(reached.voh.high - high, 0.2);  // and are not all there is
}

TEST(ReachedAngles, AreAllUnderAnEnvironment) {
  const Scene s = test::sphere(test::chalk(), test::furnace_light());
  const auto reached = reached_angles(s, s.objects[0]);
  EXPECT_EQ(reached.voh.low, 0);
  EXPECT_EQ(reached.voh.high, 1);
}

TEST(ChangeBound, IsNeverExceeded) {
  for (const auto& m : {test::red_plastic(), test::satin_gold(), test::car_paint()}) {
    Scene s = test::sphere(m, {test::light({.3, .2, 1})});
    s.tolerance.metric = Metric::relative;
    const Lit lit(s);
    const Look& look = lit.looks[0];
    const auto bound =
        change_bound(look, Effect::fresnel, Form::schlick, reached_angles(s, s.objects[0]));
    ASSERT_TRUE(bound);
    Forms forms = look.exact();
    forms[Effect::fresnel] = Form::schlick;
    const auto surface = look.surface(forms);
    double worst = 0;
    constexpr std::size_t part = 50'000;
    for (std::size_t at = 0; at < gonio::test::few(20, 1) * part; at += part) {
      const Reference reference(s, lit.drawer(0, 1).draw(9, at, gonio::test::few(part, 1000)),
                                look.surface(look.exact()));
      for (const double d : reference.differences_of(s, surface)) worst = std::max(worst, d);
    }
    EXPECT_LE(worst, *bound);
    EXPECT_GT(worst, *bound / 20) << "the bound says nothing";
  }
}

TEST(ChangeBound, IsNearlyMetByAMetal) {
  // All light is the lobe's; a small sphere far away has one angle between light and viewer.
  Scene s = test::sphere(test::satin_gold(), {test::light({1, .1, .1})});
  std::get<Sphere>(s.objects[0].shape).radius = 0.01;
  std::get<Camera>(s.view).fov_deg = 0.12;
  s.tolerance.metric = Metric::relative;
  const Lit lit(s);
  const Look& look = lit.looks[0];
  Forms exact = look.structural(), forms = exact;
  exact[Effect::compensation] = forms[Effect::compensation] = Form::uncompensated;
  forms[Effect::fresnel] = Form::schlick;
  const auto bound =
      change_bound(look, Effect::fresnel, Form::schlick, reached_angles(s, s.objects[0]));
  ASSERT_TRUE(bound);
  const Reference reference(s, lit.drawer(0, 1).draw(9, 0, 500), look.surface(exact));
  double worst = 0;
  for (const double d : reference.differences_of(s, look.surface(forms)))
    worst = std::max(worst, d);
  EXPECT_LE(worst, *bound);
  EXPECT_GT(worst, 0.9 * *bound);
}

TEST(ChangeBound, ProvesNothingOfOtherEffects) {
  const Look look(test::red_plastic());
  EXPECT_FALSE(change_bound(look, Effect::masking, Form::schlick_k, {}));
}

TEST(DeltaEBound, HoldsForColoursOfAllKinds) {
  double most = 0;
  for (std::size_t i = 0; i < gonio::test::few(300'000, 3000); ++i) {
    Draws draw(2, i);
    const double change = std::pow(10, -4 * draw.uniform());
    Rgb a, b;
    for (std::size_t c = 0; c < 3; ++c) {
      a[c] = std::pow(draw.uniform(), 3);
      b[c] = std::min(a[c] * (1 + change * (draw.uniform() < 0.5 ? 1 : -1)), 1.0);
    }
    const double e = delta_e_2000(lab_of_display(a), lab_of_display(b));
    ASSERT_LE(e, delta_e_bound(change));
    most = std::max(most, e / delta_e_bound(change));
  }
  EXPECT_GT(most, 0.02);
}

}  // namespace
}  // namespace gonio::scene
