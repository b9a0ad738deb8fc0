// Slips in shaders of our own: each is found, and none where there is none.
#include "reports/own/audit_file.h"

#include <algorithm>

#include "foreign/compile.h"
#include "support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Folder;

#define SKIP_WITHOUT_SHADERS \
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders"

FunctionAudit audited(const std::string& text) {
  const Folder folder;
  return audit_file(folder.write("case.glsl", text))[0];
}
std::string slips(const FunctionAudit& a) {
  std::string all;
  for (const auto& s : a.slips) all += s + "\n";
  return all;
}
std::string nearest(const FunctionAudit& a) {
  return a.nearest && is_same(*a.nearest) ? std::string(catalogue()[a.nearest->term].id()) : "none";
}
std::string ggx(const std::string& before, const std::string& numerator, const std::string& name) {
  return "// " + name + " 0.05 1 0.5\nfloat D_GGX(float NoH, float " + name + ") {\n  " + before +
         "\n  float d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return " + numerator + ";\n}\n";
}
constexpr const char* whole = "a2 / (3.14159265358979 * d * d)";

TEST(AuditFile, NoneIsAccusedThatHasNoSlip) {
  SKIP_WITHOUT_SHADERS;
  for (const auto& text :
       {ggx("float a2 = alpha * alpha;", whole, "alpha"),
        ggx("float a = roughness * roughness; float a2 = a * a;", whole, "roughness")}) {
    const auto a = audited(text);
    EXPECT_EQ(nearest(a), "ndf.ggx");
    EXPECT_EQ(slips(a), "");
    EXPECT_NEAR(a.normalisation->value, 1, 1e-6);
  }
  const auto f = audited(
      "// f0 0 1 0.04\nvec3 F(vec3 f0, float VoH) { return f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0); "
      "}\n");
  EXPECT_EQ(nearest(f), "fresnel.schlick");
  EXPECT_EQ(slips(f), "");
}

TEST(AuditFile, ASquareTooManyOrTooFewIsFound) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_NE(slips(audited(ggx("float a2 = alpha;", whole, "alpha")))
                .find("alpha stands where alpha² belongs"),
            std::string::npos);
  EXPECT_NE(slips(audited(ggx("float a = alpha * alpha; float a2 = a * a;", whole, "alpha")))
                .find("squared once too often"),
            std::string::npos);
  EXPECT_NE(slips(audited(ggx("float a2 = roughness * roughness;", whole, "roughness")))
                .find("taken for alpha"),
            std::string::npos);
}

TEST(AuditFile, TheFormIsNamedWhateverRoundingsAtANarrowPeak) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      ggx("float a2 = pow(roughness * roughness, 4.0);", whole, "roughness"));  // alpha from 6e-6
  EXPECT_EQ(nearest(a), "ndf.ggx");
  EXPECT_NE(slips(a).find("alpha is roughness⁴ here"), std::string::npos) << slips(a);
}

TEST(AuditFile, AModelThatIsLikeNoneIsComparedWithNone) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// alpha 0.01 1 0.3\nfloat f(float NoL, float NoV, float NoH, float alpha) {\n  float a2 = "
      "alpha * alpha, d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return a2 / (3.14159265 * d * d) / "
      "(4.0 * NoL * NoV);\n}\n");
  EXPECT_FALSE(a.nearest) << text_of(a);
}

TEST(AuditFile, AMissingPiIsFound) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(ggx("float a2 = alpha * alpha;", "a2 / (d * d)", "alpha"));
  EXPECT_NE(slips(a).find("1/π is missing"), std::string::npos) << slips(a);
  EXPECT_NEAR(a.normalisation->value, 3.14159265, 1e-5);
}

TEST(AuditFile, AClampIsFoundWithTheRoughnessBelowWhichItBites) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      ggx("float a2 = alpha * alpha;", "min(a2 / (3.14159265358979 * d * d), 20.0)", "alpha"));
  EXPECT_NE(slips(a).find("a clamp at 20 cuts the peak below alpha 0.126"), std::string::npos)
      << slips(a);
}

TEST(AuditFile, KOfDirectLightIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// roughness 0.05 1 0.5\nfloat G1(float c, float k) { return c / (c * (1.0 - k) + k); "
      "}\nfloat "
      "G_Smith(float NoL, float NoV, float roughness) {\n  float k = (roughness + 1.0) * "
      "(roughness + "
      "1.0) / 8.0;\n  return G1(NoL, k) * G1(NoV, k);\n}\n");
  static_cast<void>(a);
  const Folder folder;
  const auto path = folder.write("g.glsl",
                                 "// roughness 0.05 1 0.5\nfloat G1(float c, float k) { return c / "
                                 "(c * (1.0 - k) + k); }\nfloat "
                                 "G_Smith(float NoL, float NoV, float roughness) {\n  float k = "
                                 "(roughness + 1.0) * (roughness + "
                                 "1.0) / 8.0;\n  return G1(NoL, k) * G1(NoV, k);\n}\n");
  const auto g = audit_file(path + ":G_Smith")[0];
  EXPECT_EQ(nearest(g), "masking.schlick_ggx.direct");
  EXPECT_NE(slips(g).find("direct light"), std::string::npos);
}

TEST(AuditFile, AModelThatGainsLightIsToldWhere) {
  SKIP_WITHOUT_SHADERS;
  const auto a =
      audited("// kd 0 1 0.5\nfloat f(vec3 L, vec3 V, vec3 N, float kd) { return kd; }\n");
  EXPECT_EQ(a.of.function->includes, "pi");
  EXPECT_NEAR(a.albedo->value, 1, 1e-3);
  const Folder folder;
  const auto path = folder.write(
      "gain.glsl", "// kd 0 1 0.5\nfloat f(vec3 L, vec3 V, vec3 N, float kd) { return kd; }\n");
  const auto b = audit_file(path + ":f{includes=nothing}")[0];
  EXPECT_NEAR(b.albedo->value, 3.14159, 1e-3);
  EXPECT_NE(text_of(b).find("gains: albedo 3.14"), std::string::npos);
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
  EXPECT_NE(d.half_a.find("alpha"), std::string::npos);
  const auto v =
      compare_terms(path + ":Vis", "masking.smith_ggx.correlated", {{"alpha", {0.1, 1}}});
  EXPECT_EQ(v.read_as, "G");
  EXPECT_LT(v.largest, 1e-9);
  const auto beckmann = compare_terms(path + ":D_GGX", "ndf.beckmann", {{"alpha", {0.1, 1}}});
  EXPECT_GT(beckmann.largest, 0.01);
}

}  // namespace
}  // namespace gonio
