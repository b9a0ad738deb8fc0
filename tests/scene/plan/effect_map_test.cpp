#include "scene/plan/effect_map.h"

#include <cmath>

#include "scene/plan/scenes.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

TEST(EffectMap, SwitchesExactFresnelOnTowardsTheRim) {
  const auto map =
      effect_map(test::sphere(test::red_plastic(), test::front()), 0, {20, 105}, {0.25, 0.5}, 512);
  for (std::size_t r = 0; r < 2; ++r) {
    EXPECT_LT(map.at(Effect::fresnel, 0, r), 1);
    EXPECT_GT(map.at(Effect::fresnel, 1, r), 2);
    EXPECT_EQ(map.at(Effect::coat, 0, r), 0);
  }
}

TEST(EffectMap, SwitchesCompensationOnWithRoughness) {
  const auto map =
      effect_map(test::sphere(test::satin_gold(), test::front()), 0, {30}, {0.03, 0.45, 0.9}, 512);
  EXPECT_LT(map.at(Effect::compensation, 0, 0), 0.3);
  EXPECT_GT(map.at(Effect::compensation, 0, 1), 1);
  EXPECT_GT(map.at(Effect::compensation, 0, 2), map.at(Effect::compensation, 0, 1));
}

TEST(EffectMap, WidensBothAxesOfAnAnisotropicLobe) {
  const auto map =
      effect_map(test::sphere(test::brushed_aluminium(), test::front()), 0, {30}, {0.2, 0.5}, 512);
  for (std::size_t r = 0; r < 2; ++r) EXPECT_GT(map.at(Effect::anisotropy, 0, r), 1);
  EXPECT_GT(std::abs(map.at(Effect::anisotropy, 0, 0) - map.at(Effect::anisotropy, 0, 1)), 0.1);
}

}  // namespace
}  // namespace gonio::scene
