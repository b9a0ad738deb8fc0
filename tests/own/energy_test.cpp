// The most and the least light that a function returns, wherever within its bounds that is.
#include "reports/own/energy.h"

#include "brdf/model/model.h"
#include "integrate/albedo/directional_albedo.h"
#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(OwnEnergy, TheLargestAlbedoIsSoughtOverAllParametersTogether) {
  SKIP_WITHOUT_SHADERS;
  // F at 90° is 1 from F0 = 0.02: neither end of F0 shows the gain.
  const auto text = model_of(
      "float roughness 0.089 1 0.5, vec3 f0 0 1 0.3, vec3 color 0 1 0.2",
      "(1.0 - f0 - (clamp(50.0 * f0, 0.0, 1.0) - f0) * p) * color / PI + D_GGX(NoH, roughness * "
      "roughness) * V_Smith(NoL, NoV, roughness * roughness) * (f0 + (clamp(50.0 * f0, 0.0, 1.0) - "
      "f0) * p)");
  const auto e = energy_of(OwnModel(text).albedo);
  EXPECT_GT(e.albedo.value, 1.74) << e.albedo.at;
  EXPECT_HAS(e.albedo.at, "color 1, NoV 0.035");
  EXPECT_LT(e.part->value, 1.001) << e.part->at;
}

TEST(OwnEnergy, WhatIsFoundCanBeRepeated) {
  SKIP_WITHOUT_SHADERS;
  const OwnModel own(model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04, vec3 color 0 1 0.2",
                              "color / PI + D_GGX(NoH, roughness * roughness) * V_Smith(NoL, NoV, "
                              "roughness * roughness) * (f0 + (1.0 - f0) * p)"));
  const auto found = energy_of(own.albedo).darkest;
  const auto set = found.repeat.find("--set "), mu = found.repeat.find(" --mu ");
  EXPECT_HAS(found.repeat, "gonio albedo " + own.name + " --set roughness=1 ");
  std::istringstream words(found.repeat.substr(set + 6, mu - set - 6));
  std::vector<std::string> settings;
  for (std::string one; words >> one;) settings.push_back(one);
  const double at = std::stod(found.repeat.substr(mu + 6));
  EXPECT_NEAR(
      directional_albedo(bind_model(own.name, parse_settings(settings), 1), std::array{at})[0]
          .value[0],
      found.value, 1e-4);
}

TEST(OwnEnergy, TheLeastAlbedoIsSoughtOverAllWidthsOfAMetal) {
  SKIP_WITHOUT_SHADERS;
  const auto text = model_of(
      "float roughness 0.1 1 0.5, float metallic 0 1 0, vec3 baseColor 0 1 0.5",
      "baseColor * (1.0 - metallic) / PI + D_GGX(NoH, roughness * roughness) * V_Smith(NoL, NoV, "
      "roughness * roughness) * (mix(vec3(0.04), baseColor, metallic) * (1.0 - p) + p)");
  const auto least = energy_of(OwnModel(text).albedo).darkest;
  EXPECT_LT(least.value, 0.31) << "a rough metal; at the default of either it is 0.88";
  EXPECT_HAS(least.at, "roughness 1,");
}

TEST(OwnEnergy, AGainAtOneAzimuthIsFound) {
  SKIP_WITHOUT_SHADERS;
  const auto text =
      model_of("vec3 color 0 1 0.5", "color / PI * (0.5 + 0.8 * dot(V, B) * dot(V, B))");
  const auto most = energy_of(OwnModel(text, "{includes=nothing}").albedo).albedo;
  EXPECT_NEAR(most.value, 1.3, 0.01) << most.at;
  EXPECT_HAS(most.at, "φ 90°");
}

TEST(OwnEnergy, ACornerOfManyParametersIsFound) {
  SKIP_WITHOUT_SHADERS;
  // Flat about the defaults: no climb from there leads to it.
  const auto text = model_of(
      "float a 0 1 0.5, float b 0 1 0.5, float c 0 1 0.5, float d 0 1 0.5, float e 0 1 0.5, float "
      "g 0 1 0.5, vec3 color 0 1 0.5",
      "color / PI * (0.9 + 0.5 * (2.0 * a - 1.0) * (2.0 * b - 1.0) * (2.0 * c - 1.0) * (2.0 * d - "
      "1.0) * (2.0 * e - 1.0) * (2.0 * g - 1.0))");
  const auto most = energy_of(OwnModel(text, "{includes=nothing}").albedo).albedo;
  EXPECT_NEAR(most.value, 1.4, 0.01) << most.at;
}

}  // namespace
}  // namespace gonio
