#include "brdf/model/roughness.h"

#include "brdf/model/model.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Roughness, NamesKeepTheLobesEnding) {
  EXPECT_EQ(roughness_name("alpha"), "roughness");
  EXPECT_EQ(roughness_name("alpha_2"), "roughness_2");
  EXPECT_EQ(alpha_name("roughness"), "alpha");
  EXPECT_EQ(alpha_name("roughness_x"), "alpha_x");
  EXPECT_TRUE(is_alpha("alpha"));
  EXPECT_TRUE(is_alpha("alpha_3"));
  EXPECT_FALSE(is_alpha("alphabet"));
  EXPECT_FALSE(is_alpha("gamma"));
  EXPECT_TRUE(is_roughness("roughness_2"));
  EXPECT_FALSE(is_roughness("diffuse_roughness"));
}

TEST(Roughness, IsTheRootOfTheWidthAndItsErrorHalfOfTheWidthsOverIt) {
  EXPECT_EQ(alpha_of(0.5), 0.25);
  EXPECT_EQ(roughness_of(0.25), 0.5);
  EXPECT_LT(alpha_of(-0.5), 0) << "no roughness is no width";
  const double h = 1e-6, r = 0.3, a = alpha_of(r);
  EXPECT_NEAR(roughness_error(r, h), (roughness_of(a + h) - roughness_of(a - h)) / 2, 1e-11);
}

TEST(Roughness, SetsTheWidthOfItsLobeAndOfItsAxis) {
  const auto value = [](const char* spec, const char* set, const char* name) {
    const auto b = bind_model(spec, parse_settings(std::vector<std::string>{set}));
    return b.values[b.model.find(name)->first];
  };
  EXPECT_EQ(value("ggx/smith_ggx.correlated/schlick", "roughness=0.5", "alpha"), 0.25);
  EXPECT_EQ(value("ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick",
                  "roughness_2=0.5", "alpha_2"),
            0.25);
}

}  // namespace
}  // namespace gonio
