// What parameters stand for: by their names, by what a person says, or by what they do.
#include "reports/own/parameters.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(OwnParameters, APrefixOfANameIsLeftOut) {
  EXPECT_EQ(plain_name("uF0"), "f0");
  EXPECT_EQ(plain_name("u_Roughness"), "roughness");
  EXPECT_EQ(plain_name("_SpecColor"), "speccolor");
  EXPECT_EQ(plain_name("metallic"), "metallic");
  EXPECT_EQ(plain_name("kD"), "kd");
}

/// A highlight whose parameters have names that say nothing.
std::string nameless(const std::string& alpha) {
  return model_of("float q 0.1 1 0.5, vec3 hue 0 1 0.5, vec3 paint 0 1 0.5",
                  "paint / PI + D_GGX(NoH, " + alpha + ") * V_Smith(NoL, NoV, " + alpha +
                      ") * (hue + (1.0 - hue) * p)");
}

TEST(OwnParameters, WhatNoNameSaysIsFoundByWhatItDoes) {
  SKIP_WITHOUT_SHADERS;
  const test::Folder folder;
  const auto a = audit_file(folder.write("case.glsl", nameless("q * q")) + ":model")[0];
  ASSERT_TRUE(a.model) << a.no_model;
  EXPECT_HAS(text_of(a), "lambert+ggx/smith_ggx.correlated/schlick, alpha = q², F0 = hue");
  EXPECT_NEAR(a.highlight->value, 1, 0.01);
}

TEST(OwnParameters, ARoleThatIsSaidIsTakenForTheName) {
  SKIP_WITHOUT_SHADERS;
  const auto text = nameless("pow(q, 3.0)");
  const OwnSlips unknown(text);
  EXPECT_FALSE(unknown.highlight);
  EXPECT_HAS(unknown.why, "--argument NAME=roughness says which");
  const OwnSlips known(text, "{argument.q=roughness;argument.hue=f0}");
  EXPECT_HAS(known.why, "no D and V of ours make its highlight at any power of q");
  EXPECT_NEAR(known.highlight->value, 1, 0.01);
}

TEST(OwnParameters, MetalsAndColoursWithoutBoundsAreSoughtFromZeroToOne) {
  SKIP_WITHOUT_SHADERS;
  const auto text =
      model_of("float roughness, float metalness, vec3 albedo",
               "albedo * (1.0 - metalness) / PI + D_GGX(NoH, roughness) * V_Smith(NoL, "
               "NoV, roughness) * mix(mix(vec3(0.04), albedo, metalness), vec3(1.0), p)");
  const OwnModel own(text);
  const auto e = energy_of(own.albedo);
  EXPECT_HAS(e.albedo.at, "metalness 0,");
  EXPECT_HAS(e.albedo.at, "roughness 0.05");
}

}  // namespace
}  // namespace gonio
