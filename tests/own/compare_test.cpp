// A person's functions beside ours: which parameters stand for which, and how far apart the two
// are.
#include "reports/own/compare.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Folder;

TEST(CompareTerms, AWholeModelIsComparedWithOurs) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write("t.glsl", tutorial("4.0"));
  const auto c = compare_with_model(path, "lambert+ggx/smith_ggx.separable/schlick", {});
  EXPECT_LT(c.largest, 1e-6) << c.at;
  EXPECT_GT(c.operations_b, 20U);
  const auto engine = folder.write(
      "e.glsl",
      replaced(
          replaced(tutorial("4.0"), "// f0 0 1 0.04", "// Specular 0 1 0.5\n// metallic 0 1 0"),
          "vec3 f0, vec3 albedo) {",
          "float Specular, float metallic, vec3 albedo) {\n  vec3 f0 = mix(vec3(0.08 * Specular), "
          "albedo, metallic);"));
  const auto by_engine = compare_with_model(engine, "lambert+ggx/smith_ggx.separable/schlick", {});
  EXPECT_LT(by_engine.largest, 1e-6) << by_engine.at;
  EXPECT_HAS(by_engine.pairs, "f0 = 0.08 Specular");
  EXPECT_EQ(by_engine.only_a, std::vector<std::string>{"metallic 0"});
  EXPECT_HAS(text_of(c), "kd = albedo, alpha = roughness², f0 = f0\n");
  const auto metal =
      folder.write("m.glsl", replaced(tutorial("4.0"), "vec3 f0, vec3 albedo)",
                                      "vec3 f0, float Metallic, vec3 BaseColor)\n#define albedo "
                                      "(BaseColor * (1.0 - Metallic))\n"));
  EXPECT_HAS(compare_with_model(metal + ":brdf{Metallic=0,1,0;BaseColor=0,1,0.5}",
                                "lambert+ggx/smith_ggx.separable/schlick", {})
                 .pairs,
             "kd = BaseColor, alpha = roughness², f0 = f0");
}

TEST(CompareTerms, ADistributionBesideOursAndAMaskingReadBothWays) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path =
      folder.write("two.glsl", ggx("float a2 = alpha * alpha;", whole, "alpha") +
                                   "float Vis(float NoL, float NoV, float alpha) {\n  float a2 = "
                                   "alpha * alpha;\n  return 2.0 * NoL * NoV / "
                                   "(NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * "
                                   "NoV * (1.0 - a2) + a2));\n}\n");
  const auto d = compare_terms(path + ":D_GGX", "ndf.ggx", {{"Alpha", {0.1, 1}}});
  EXPECT_LT(d.largest, 1e-12);
  EXPECT_EQ(d.half_a, "finite for every input of its domain");
  const auto v =
      compare_terms(path + ":Vis", "masking.smith_ggx.correlated", {{"alpha", {0.1, 1}}});
  EXPECT_EQ(v.read_as, "G");
  EXPECT_LT(v.largest, 1e-9);
  const auto beckmann = compare_terms(path + ":D_GGX", "ndf.beckmann", {{"alpha", {0.1, 1}}});
  EXPECT_GT(beckmann.largest, 0.01);
}

TEST(CompareTerms, AWidthIsTheOthersAlphaByTheMapThatItsNameAllows) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto compared = [&](const std::string& width, const std::string& alpha) {
    const auto path = folder.write(width.substr(0, 3) + ".glsl",
                                   model_of("float " + width + ", vec3 f0 0 1 0.04",
                                            "D_GGX(NoH, " + alpha + ") * V_Smith(NoL, NoV, " +
                                                alpha + ") * (f0 + (1.0 - f0) * p)"));
    return compare_with_model(path + ":model", "ggx/smith_ggx.correlated/schlick", {});
  };
  const auto smooth = compared("smoothness 0 0.9 0.5", "((1.0 - smoothness) * (1.0 - smoothness))");
  EXPECT_LT(smooth.largest, 1e-6) << smooth.at;
  EXPECT_HAS(smooth.pairs, "alpha = (1 − smoothness)²");
  const auto exponent = compared("shininess 1 1000 50", "sqrt(2.0 / (shininess + 2.0))");
  EXPECT_LT(exponent.largest, 1e-6) << exponent.at;
  EXPECT_HAS(exponent.pairs, "alpha = √(2/(shininess + 2))");
  const auto slip = compared("alpha 0.1 1 0.5", "(alpha * alpha)");
  EXPECT_GT(slip.largest, 0.5) << "a square too many is no map that a name allows";
}

TEST(CompareTerms, WhatOnlyOneSideHasIsNamedAndCanBeSet) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write(
      "coat.glsl", model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04, float coat 0 1 0",
                            "(f0 + (1.0 - f0) * p) * D_GGX(NoH, roughness * roughness) * "
                            "V_Smith(NoL, NoV, roughness * roughness) * (1.0 - 0.3 * coat)"));
  const std::string ours = "lambert+ggx/smith_ggx.correlated/schlick";
  const auto c = compare_with_model(path + ":model", ours, {});
  EXPECT_EQ(c.only_a, std::vector<std::string>{"coat 0 to 1"});
  EXPECT_EQ(c.only_b, std::vector<std::string>{"kd 0.2"});
  EXPECT_HAS(text_of(c), ours + ": kd 0.2; --set NAME=VALUE sets it");
  EXPECT_GT(c.largest, 0.1);
  const auto set = compare_with_model(path + ":model", ours, {{"coat", {0, 0}}, {"kd", {0, 0}}});
  EXPECT_LT(set.largest, 1e-6) << set.at;
  EXPECT_EQ(set.only_b, std::vector<std::string>{"kd 0"});
  EXPECT_HAS(test::refusal(
                 [&] {
                   compare_with_model(path + ":model", ours, {{"kdd", {0, 0}}});
                 },
                 Exit::usage),
             "has a parameter 'kdd'");
  EXPECT_HAS(test::refusal(
                 [&] {
                   compare_with_model(path + ":model", ours, {{"alpha", {0.1, 0.1}}});
                 },
                 Exit::usage),
             "alpha is roughness² here: set that");
}

TEST(CompareTerms, TwoWidthsVaryOnBothSides) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write(
      "two.glsl",
      "// ax 0.1 1 0.3\n// ay 0.1 1 0.3\nfloat D(float XoH, float YoH, float NoH, float ay, float "
      "ax) {\n  float s = XoH * XoH / (ay * ay) + YoH * YoH / (ax * ax) + NoH * NoH;\n  return 1.0 "
      "/ "
      "(3.14159265358979 * ax * ay * s * s);\n}\n");
  const auto d = compare_terms(path, "ndf.ggx_aniso", {});
  EXPECT_LT(d.largest, 1e-9) << d.at;
  EXPECT_EQ(d.pairs, "alpha_x = ay, alpha_y = ax");
  EXPECT_GT(compare_terms(path, "ndf.beckmann_aniso", {}).largest, 0.01);
  const auto stretched = folder.write(
      "one.glsl",
      "// rough 0.3 1 0.5\n// anisotropy 0 0.9 0.3\nfloat D(float XoH, float YoH, float NoH, float "
      "rough, float anisotropy) {\n  float k = sqrt(1.0 - 0.9 * anisotropy), x = rough * rough / "
      "k, y "
      "= rough * rough * k;\n  float s = XoH * XoH / (x * x) + YoH * YoH / (y * y) + NoH * NoH;\n  "
      "return 1.0 / (3.14159265358979 * x * y * s * s);\n}\n");
  const auto one = compare_terms(stretched, "ndf.ggx_aniso", {});
  EXPECT_LT(one.largest, 1e-9) << one.at;
  EXPECT_HAS(one.pairs, "alpha_x = rough² / √(1 − 0.9 anisotropy)");
}

TEST(CompareTerms, ASquareByItsNameIsRootedAndAnUnknownNameIsSought) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  for (const auto& [name, map] :
       {std::pair{"a2", "alpha = √a2"}, {"m2", "alpha = √m2"}, {"blur", "alpha = blur"}}) {
    const std::string n(name);
    const auto before = n == "a2" ? "" : "float a2 = " + n + (n == "blur" ? " * " + n : "") + ";";
    const auto path = folder.write(n + ".glsl", ggx(before, whole, name));
    const auto c = compare_terms(path, "ndf.ggx", {});
    EXPECT_LT(c.largest, 1e-9) << name;
    EXPECT_EQ(c.pairs, map);
  }
}

TEST(CompareTerms, AllMissingBoundsAreAskedForByNamesThatAreTaken) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path =
      folder.write("mixed.glsl", model_of("float alpha, vec3 tint",
                                          "D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha) * "
                                          "(tint.g + (1.0 - tint) * p)"));
  const auto name = path + ":model";
  const std::string ours = "ggx/smith_ggx.correlated/schlick";
  EXPECT_HAS(test::refusal([&] { compare_with_model(name, ours, {}); }, Exit::usage),
             "alpha, tint of " + name +
                 " have no bounds: give them by --domain alpha=LOW,HIGH tint=LOW,HIGH");
  EXPECT_GT(compare_with_model(name, ours, {{"alpha", {0.1, 1}}, {"tint", {0, 1}}}).largest, 0);
}

TEST(CompareTerms, WhatIsAsGoodAsNothingOnBothSidesIsTheSame) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write(
      "sheen.glsl",
      model_of("float alpha 0.1 1 0.5, float f0 0 1 0.5",
               "vec3(f0 * (2.0 + 1.0 / alpha) * pow(1.0 - min(NoH * NoH, 1.0), 0.5 / alpha) / (2.0 "
               "* PI) * V_Smith(NoL, NoV, alpha))"));
  EXPECT_LT(
      compare_with_model(path + ":model", "charlie/smith_ggx.correlated/constant", {}).largest,
      1e-6);
}

}  // namespace
}  // namespace gonio
