#include "scene/surface/image_light.h"

#include <cmath>
#include <numbers>

#include "scene/plan/scenes.h"
#include "scene/surface/surface.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

EnvironmentLight even_sky(double scale) {
  return {"", scale, {2, 1, {{1, 1, 1}, {1, 1, 1}}, 0}};
}

Surface looked_up(const Material& m, const std::shared_ptr<const ImageLight>& sky) {
  const Look look(m, sky);
  Forms forms = look.structural();
  forms[Effect::environment] = Form::split_sum;
  return look.surface(forms);
}

TEST(ImageLit, LosesNothingOfAWhiteLobeThatIsCompensated) {
  const auto light = even_sky(3);
  const auto sky = std::make_shared<const ImageLight>(light);
  ImageLitParts parts;
  parts.lobe = {"smith_ggx.correlated", 0.64, {1, 1, 1}};
  const SkyView grazing{{0, 0, 1}, {1, 0, 0}, 0.2};
  EXPECT_LT(ImageLit(*sky, parts)(grazing)[0], 2.6);
  parts.compensated = true;
  EXPECT_NEAR(ImageLit(*sky, parts)(grazing)[0], 3, 1e-5);
}

TEST(ImageLit, LetsADiffuseKeepWhatTheInterfaceLetsThrough) {
  const auto light = even_sky(1);
  const auto sky = std::make_shared<const ImageLight>(light);
  const SkyView view{{0, 0, 1}, {0, 0, 1}, 1};
  ImageLitParts parts;
  parts.kd = {0.5, 0.2, 0};
  EXPECT_NEAR(ImageLit(*sky, parts)(view)[0], 0.5, 1e-6);
  EXPECT_NEAR(ImageLit(*sky, parts)(view)[1], 0.2, 1e-6);
  parts.lobe = {"smith_ggx.correlated", 0.5, {0.04, 0.04, 0.04}};
  parts.coupled = true;
  const auto sum = ImageLit(*sky, parts)(view);
  parts.kd = {};
  const auto lobe = ImageLit(*sky, parts)(view);
  EXPECT_LT(sum[0] - lobe[0], 0.5 * 0.96);
  EXPECT_GT(sum[0] - lobe[0], 0.5 * 0.96 * 0.95);
}

TEST(ImageLit, LaysTheCoatOnAllElse) {
  const auto light = even_sky(1);
  const auto sky = std::make_shared<const ImageLight>(light);
  const SkyView view{{0, 0, 1}, {0.6, 0, 0.8}, 0.8};
  ImageLitParts parts;
  parts.kd = {1, 1, 1};
  parts.coat = {"smith_ggx.correlated", 0.0225, {0.04, 0.04, 0.04}, 0.5};
  const double f = 0.04 + 0.96 * std::pow(0.2, 5);
  // A smooth coat takes away about what it reflects.
  EXPECT_NEAR(ImageLit(*sky, parts)(view)[0], 1 - 0.5 * f + 0.5 * f, 2e-3);
}

TEST(Look, LooksUpAnEnvironmentWhereThereIsOne) {
  const auto light = even_sky(1);
  const auto sky = std::make_shared<const ImageLight>(light);
  const Look gold(test::satin_gold(), sky), alone(test::satin_gold());
  EXPECT_EQ(gold.exact().name(Effect::environment), "quadrature");
  EXPECT_FALSE(gold.surface(gold.exact()).image_lit);
  EXPECT_TRUE(looked_up(test::satin_gold(), sky).image_lit);
  EXPECT_EQ(alone.exact().name(Effect::environment), "split_sum");
  EXPECT_EQ(alone.offer(Effect::environment).why, "no environment lights it");
  EXPECT_FALSE(alone.surface(alone.exact()).image_lit);
  const Look two(
      test::material("ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick",
                     {"f0=0.9,0.5,0.2", "alpha_2=0.4", "f0_2=0.1"}),
      sky);
  EXPECT_EQ(two.offer(Effect::environment).forms, (std::vector{Form::quadrature}));
}

}  // namespace
}  // namespace gonio::scene
