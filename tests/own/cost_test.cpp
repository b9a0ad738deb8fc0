// What a person's function costs beside ours: always said, and of like with like.
#include "reports/own/cost.h"

#include "own/own_shaders.h"
#include "refusal.h"
#include "reports/own/compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* oren_nayar =
    "// albedo 0 1 0.6\n// sigma 0 1 0.3\nvec3 rough(vec3 N, vec3 L, vec3 V, vec3 albedo, float "
    "sigma) {\n  float NoL = dot(N, L), NoV = dot(N, V), s2 = sigma * sigma;\n  float s = dot(L, "
    "V) - NoL * NoV, t = s > 0.0 ? max(NoL, NoV) : 1.0;\n  return albedo / 3.14159265358979 * (1.0 "
    "- 0.5 * s2 / (s2 + 0.33) + 0.45 * s2 / (s2 + 0.09) * s / t);\n}\n";

TEST(OwnCost, ADiffuseFunctionStandsBesideTheNearestDiffuseTerm) {
  SKIP_WITHOUT_SHADERS;
  const auto& a = audited(oren_nayar);
  ASSERT_TRUE(a.of_the_kind);
  EXPECT_EQ(a.of_the_kind->spec, "diffuse.oren_nayar");
  EXPECT_EQ(a.no_model, "") << "F0 is not missed where there is no highlight";
  EXPECT_HAS(text_of(a), fmt::format("{} operations in one channel, diffuse.oren_nayar has",
                                     a.of_the_kind->own_operations));
}

TEST(OwnCost, OneFunctionHasOneCountWhereverItIsPrinted) {
  SKIP_WITHOUT_SHADERS;
  const test::Folder folder;
  const auto path = folder.write("one.glsl", oren_nayar);
  const auto audit = audit_file(path)[0].of_the_kind;
  const auto term = compare_terms(path, "diffuse.oren_nayar", {});
  const auto model = compare_with_model(path, "oren_nayar", {});
  ASSERT_TRUE(audit);
  for (const auto& c : {term, model}) {
    EXPECT_EQ(c.operations_a, audit->own_operations);
    EXPECT_EQ(c.operations_b, audit->operations);
  }
  EXPECT_HAS(text_of(term), "operations in one channel");
}

/// A sheen, a coat or a highlight that is none of ours.
OfTheKind kind_of(const std::string& parameters, const std::string& value) {
  return model_of_the_kind(OwnModel(model_of(parameters, value)).term);
}

TEST(OwnCost, AHighlightThatIsNoneOfOursStandsBesideTheNearestOfOurModels) {
  SKIP_WITHOUT_SHADERS;
  const std::string power = "vec3(pow(NoH, 3.0 / (roughness * roughness)))";
  EXPECT_EQ(kind_of("float roughness 0.1 1 0.5", power).spec, "blinn_phong/implicit/schlick");
  const std::string odd =
      "vec3(D_GGX(NoH, roughness * roughness) * (0.7 + 0.3 * NoL * NoV) * V_Smith(NoL, NoV, "
      "roughness))";
  EXPECT_EQ(kind_of("float roughness 0.1 1 0.5", odd).spec, "ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(kind_of("float roughness 0.1 1 0.5, vec3 albedo 0 1 0.5", "albedo / PI + " + odd).spec,
            "lambert+ggx/smith_ggx.correlated/schlick");
}

TEST(OwnCost, ACoatCountsAsACoat) {
  SKIP_WITHOUT_SHADERS;
  const auto coated =
      kind_of("float roughness 0.1 1 0.5, vec3 albedo 0 1 0.5, float clearCoat 0 1 1",
              "albedo / PI + vec3((clearCoat + 1.0) * D_GGX(NoH, roughness * roughness) * (0.7 + "
              "0.3 * NoL * NoV) * V_Smith(NoL, NoV, roughness))");
  EXPECT_EQ(coated.spec,
            "lambert+ggx/smith_ggx.correlated/schlick+coat:ggx/smith_ggx.correlated/schlick");
  // A coat is white: its lobe is one channel's, and takes from what lies below.
  const std::string lobe = "ggx/smith_ggx.correlated/schlick";
  EXPECT_EQ(coated.operations, operations_in("lambert+" + lobe, 3) + operations_in(lobe, 1) + 7);
  EXPECT_LT(coated.operations, operations_in("lambert+" + lobe + "+" + lobe, 3));
}

TEST(OwnCost, ASheenStandsBesideCharlieWhateverItsWidthIsCalled) {
  SKIP_WITHOUT_SHADERS;
  const auto sheen = [](const std::string& name, const std::string& inverse) {
    return kind_of("float " + name + ", vec3 sheenColor 0 1 0.5",
                   "sheenColor * (2.0 + " + inverse + ") * pow(sqrt(1.0 - NoH * NoH), " + inverse +
                       ") / (2.0 * PI) / (4.0 * (NoL + NoV - NoL * NoV))")
        .spec;
  };
  for (const auto& [name, inverse] :
       {std::pair<std::string, std::string>{"roughness 0.1 1 0.5", "(1.0 / roughness)"},
        {"sheenRoughness 0.3 1 0.5", "(1.0 / (sheenRoughness * sheenRoughness))"},
        {"fuzz 0 0.9 0.5", "(1.0 / (1.0 - fuzz))"},
        {"sharpness 1 10 2", "sharpness"}})
    EXPECT_EQ(sheen(name, inverse), "charlie/smith_charlie.correlated/constant") << name;
}

TEST(OwnCost, AHighlightOfWhiteMetalsOnlyIsSeen) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& value) {
    return has_highlight(
        OwnModel(
            model_of("float roughness 0.5 1 0.6, float metallic 0 1 0, vec3 albedo 0 1 0.5", value))
            .term);
  };
  EXPECT_TRUE(of("albedo * (1.0 - metallic) / PI + albedo * metallic * pow(NoH, 9.0)"));
  EXPECT_FALSE(of("albedo / PI * burley(NoL, NoV, VoH, roughness)"));
}

TEST(OwnCost, AMetallicWorkflowIsAdvisedByItsOwnNames) {
  SKIP_WITHOUT_SHADERS;
  const auto why =
      OwnSlips(model_of("float roughness 0.1 1 0.5, float isMetal 0 1 0, vec3 theBase 0 1 0.5",
                        "theBase / PI + vec3(pow(NoH, 3.0 / (roughness * roughness)) * isMetal)"))
          .why;
  EXPECT_HAS(why, "--argument theBase=basecolor isMetal=metallic");
  EXPECT_EQ(plain_name("material_baseColor"), "basecolor");
}

}  // namespace
}  // namespace gonio
