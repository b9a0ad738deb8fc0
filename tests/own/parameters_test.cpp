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

TEST(OwnParameters, ANameThatSaysSquareIsOne) {
  const auto squared = [](const char* name) {
    Parameter p;
    p.name = p.meaning = name;
    return is_squared(p) && width_of(std::span(&p, 1));
  };
  for (const char* name : {"a2", "m2", "mSq", "a_sq", "alphaSq", "alphaSquared", "m_squared",
                           "Roughness2", "roughness4", "r4", "alphaPow2"})
    EXPECT_TRUE(squared(name)) << name;
  for (const char* name : {"alpha", "roughness", "square", "m", "w2"})
    EXPECT_FALSE(squared(name)) << name;
}

TEST(OwnParameters, WhatIsOneOfMostSurfacesIsNoWidthAndAWeightNoF0) {
  SKIP_WITHOUT_SHADERS;
  const OwnSlips s(
      model_of("vec3 f0, vec3 f90, float alphaRoughness 0.05 1 0.3, float specularWeight 0 1 1",
               "specularWeight * D_GGX(NoH, alphaRoughness) * V_Smith(NoL, NoV, alphaRoughness) * "
               "(f0 + (f90 - f0) * p)"));
  ASSERT_TRUE(s.model) << s.why;
  EXPECT_EQ(s.model->spec, "ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(s.slips, "");
}

TEST(OwnParameters, TwoWidthsThatAreOneMakeOurHighlight) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [&](const std::string& a, const std::string& b, const std::string& reading) {
    const std::string alpha = "sqrt(" + a + " * " + b + ")";
    return OwnSlips(
        model_of(
            "vec3 f0 0 1 0.04, float " + a + " 0.1 1 0.2, float " + b + " 0.1 1 0.8",
            "D_GGX(NoH, " + alpha + ") * V_Smith(NoL, NoV, " + alpha + ") * (f0 + (1.0 - f0) * p)"),
        reading);
  };
  EXPECT_TRUE(of("ax", "ay", "").model);
  EXPECT_TRUE(of("alphaX", "alphaY", "").model);
  EXPECT_TRUE(of("along", "across", "{argument.along=alpha;argument.across=alpha}").model);
}

}  // namespace
}  // namespace gonio
