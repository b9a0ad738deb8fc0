// What is guessed of a value: cosine, π, G or V, and whether turning changes it.
#include <array>
#include <numbers>

#include "foreign/guesses.h"
#include "foreign/written.h"

namespace gonio::foreign {
namespace {

TEST(Includes, WhatAValueIncludesIsGuessedAndSaid) {
  SKIP_WITHOUT_SHADERS;
  const std::string head = "// kd 0 1 0.5\nfloat f(vec3 L, vec3 V, vec3 N, float kd) { return ";
  const auto includes = [&](const std::string& body, const std::string& rest = "") {
    return Written(head + body + "; }\n").function(rest).includes;
  };
  EXPECT_EQ(includes("kd / 3.14159265358979"), "nothing");
  EXPECT_EQ(includes("kd / 3.14159265358979 * dot(N, L)"), "cosine");
  EXPECT_EQ(includes("kd"), "pi");
  EXPECT_EQ(includes("kd * dot(N, L)"), "cosine,pi");
  EXPECT_EQ(includes("kd", "{includes=nothing}"), "nothing");
  const auto f = Written(head + "kd * dot(N, L); }\n").function();
  const std::array<double, 11> angles{0.5, 0.7, 0.8, 0.8, 0.36, 0, 0.6, 0.2, 0.3, 0.1, 0.4};
  EXPECT_NEAR(value_of(f, {0.6}, angles)[0], 0.6 / std::numbers::pi, 1e-15);
}

/// A diffuse part and a highlight that has three times too much, as many old shaders have it.
std::string diffuse_and_phong(const std::string& kd, const std::string& over) {
  return "// n 1 200 30\n// kd 0 " + kd +
         " 0.3\n// ks 0 1 0.4\nvec3 f(vec3 L, vec3 V, vec3 N, vec3 kd, vec3 ks, float n) {\n"
         "  return kd" +
         over + " + ks * (n + 2.0) * 0.5" + over +
         " * pow(max(dot(N, normalize(L + V)), 0.0), n);\n}\n";
}

TEST(Includes, PiIsGuessedByOneColourAtATimeWhateverItsBounds) {
  SKIP_WITHOUT_SHADERS;
  for (const std::string high : {"1", "0.5"}) {
    EXPECT_EQ(Written(diffuse_and_phong(high, " / 3.14159265358979")).function().includes,
              "nothing")
        << high;
    EXPECT_EQ(Written(diffuse_and_phong(high, "")).function().includes, "pi") << high;
  }
  EXPECT_FALSE(Written(diffuse_and_phong("1", "")).function().unclear);
  const auto f =
      Written("// ks 0 1 0.1\nfloat f(vec3 L, vec3 V, vec3 N, float ks) { return ks * 0.6; }\n")
          .function();
  EXPECT_EQ(f.includes, "nothing");
  EXPECT_TRUE(f.unclear) << "an albedo of 1.9 is near neither 1 nor π";
}

TEST(Includes, MaskingIsGOrVByItsValueAlongTheNormal) {
  SKIP_WITHOUT_SHADERS;
  const Written w(
      "// k 0 1 0.2\nfloat G1(float c, float k) { return c / (c * (1.0 - k) + k); }\nfloat "
      "G_Smith(float NoL, float NoV, float k) { return G1(NoL, k) * G1(NoV, k); }\nfloat "
      "V_Smith(float "
      "NoL, float NoV, float k) { return G_Smith(NoL, NoV, k) / (4.0 * NoL * NoV); }\n");
  const std::array<double, 11> angles{0.5, 0.7, 0.8, 0.8, 0.36, 0, 0.6, 0.2, 0.3, 0.1, 0.4};
  const auto g = w.function(":G_Smith"), v = w.function(":V_Smith");
  EXPECT_TRUE(g.is_g);
  EXPECT_FALSE(v.is_g);
  EXPECT_NEAR(value_of(g, {0.2}, angles)[0], value_of(v, {0.2}, angles)[0], 1e-15);
}

TEST(Includes, TurningTheSurfaceIsNoticed) {
  SKIP_WITHOUT_SHADERS;
  const std::string head = "float f(vec3 L, vec3 V, vec3 N, vec3 X) { return ";
  EXPECT_TRUE(Written(head + "0.1 + 0.1 * dot(X, L) * dot(X, V); }\n").function().anisotropic);
  EXPECT_FALSE(Written(head + "0.1 + 0.1 * dot(L, V); }\n").function().anisotropic);
}

/// Slopes of two widths, by cosines with the tangent frame.
std::string two_widths(const std::string& bounds) {
  return bounds +
         "float D(vec3 N, vec3 H, vec3 X, vec3 Y, float ax, float ay) {\n  float x = dot(X, H) / "
         "ax, y = dot(Y, H) / ay, z = dot(N, H), s = x * x + y * y + z * z;\n  return 1.0 / "
         "(3.14159265358979 * ax * ay * s * s);\n}\n";
}

TEST(Includes, TwoWidthsThatHaveOneDefaultAreTwoWidths) {
  SKIP_WITHOUT_SHADERS;
  for (const auto* bounds : {"", "// ax 0.05 1 0.3\n// ay 0.05 1 0.3\n"}) {
    const auto f = Written(two_widths(bounds)).function();
    EXPECT_TRUE(f.anisotropic) << bounds;
    EXPECT_EQ(f.stands, Stands::distribution);
  }
  EXPECT_FALSE(Written(two_widths("")).function("{ax=0.3;ay=0.3}").anisotropic);
  const auto turned = Written(
      "// turn 0 1 0\nfloat f(vec3 N, vec3 L, vec3 V, vec3 X, float turn) { return 0.1 + (turn > "
      "0.98 ? dot(X, L) * dot(X, V) : 0.0); }\n");
  EXPECT_TRUE(turned.function().anisotropic) << "at an end alone";
}

TEST(Includes, AHighlightThatIsBlackAtItsDefaultHasACosineNonetheless) {
  SKIP_WITHOUT_SHADERS;
  const auto f = Written(
                     "// ks 0 1 0\nfloat f(vec3 L, vec3 V, vec3 N, float ks) { return ks / "
                     "3.14159265358979 * dot(N, L); }\n")
                     .function();
  EXPECT_EQ(f.includes, "cosine");
}

TEST(Includes, ACosineIsSeenThoughAnotherTermIsNotReciprocal) {
  SKIP_WITHOUT_SHADERS;
  const auto includes = [](const std::string& times) {
    return Written(
               "// tint 0 1 0.2\n// metallic 0 1 0\nfloat f(float NoL, float NoV, float NoH, "
               "float tint, float metallic) { float f0 = mix(0.04, tint, metallic); return (f0 "
               "+ (1.0 - f0) * pow(1.0 - NoV, 5.0)) * 0.2 * NoH" +
               times + "; }\n")
        .function()
        .includes;
  };
  EXPECT_EQ(includes(" * NoL"), "cosine") << "F takes NoV, and is 1 where F0 is";
  EXPECT_EQ(includes(""), "nothing");
}

TEST(Includes, ARoughHighlightThatLosesLightDoesNotHideAFactorOfPi) {
  SKIP_WITHOUT_SHADERS;
  const auto includes = [](const std::string& norm, const std::string& kd, const std::string& nol) {
    return Written(
               "// roughness 0.05 1 0.5\n// kd 0 1 0.5\n// f0 0 1 0.04\nvec3 f(vec3 N, vec3 L, "
               "vec3 V, float roughness, vec3 kd, vec3 f0) {\n  vec3 H = normalize(L + V);\n"
               "  float NoL = dot(N, L), NoV = dot(N, V), NoH = dot(N, H), a = roughness * "
               "roughness, d = NoH * NoH * (a * a - 1.0) + 1.0;\n"
               "  return (" +
               kd +
               " + a * a / (d * d) * 0.5 / (NoL * (NoV * (1.0 - a) + a) + NoV * (NoL * (1.0 - "
               "a) + a)) * (f0 + (1.0 - f0) * pow(1.0 - dot(L, H), 5.0)) / " +
               norm + ")" + nol + ";\n}\n")
        .function()
        .includes;
  };
  EXPECT_EQ(includes("1.0", "kd", " * NoL"), "cosine,pi");
  EXPECT_EQ(includes("1.0", "kd", ""), "pi");
  EXPECT_EQ(includes("3.14159265", "kd / 3.14159265", ""), "nothing");
  EXPECT_EQ(includes("3.14159265", "kd", ""), "nothing") << "a slip of the diffuse part";
}

TEST(Includes, AMetalsHighlightAndADiffusePartOfOneColourAreLookedAtEach) {
  SKIP_WITHOUT_SHADERS;
  const auto f = Written(
                     "// albedo 0 1 0.5\n// metallic 0 1 0\nvec3 f(vec3 N, vec3 L, vec3 V, vec3 "
                     "albedo, float metallic) {\n  float NoH = dot(N, normalize(L + V)), d = NoH * "
                     "NoH * (0.01 - 1.0) + 1.0;\n  return albedo * (1.0 - metallic) + metallic * "
                     "albedo * 0.01 / (3.14159265 * d * d) / (4.0 * dot(N, L) * dot(N, V));\n}\n")
                     .function();
  EXPECT_EQ(f.includes, "nothing") << "1/π is missing from the diffuse part alone";
}

TEST(Includes, ADiffuseFactorWithoutAColourHasPi) {
  SKIP_WITHOUT_SHADERS;
  const auto f = Written(
                     "float diffuse(float NoL, float NoV, float LoH, float roughness) {\n  float g "
                     "= 2.0 * LoH * LoH * roughness - 0.5;\n  return (1.0 + g * pow(1.0 - NoL, "
                     "5.0)) * (1.0 + g * pow(1.0 - NoV, 5.0));\n}\n")
                     .function();
  EXPECT_EQ(f.includes, "pi");
}

TEST(Includes, AVisibilityThatLacksItsFourIsNoG) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_FALSE(
      Written("float V_Cloth(float NoV, float NoL) { return 1.0 / (NoL + NoV - NoL * NoV); "
              "}\n")
          .function()
          .is_g);
}

}  // namespace
}  // namespace gonio::foreign
