// Slips in shaders of our own: each is found, and none where there is none.
#include "reports/own/audit_file.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Folder;

TEST(AuditFile, NoneIsAccusedThatHasNoSlip) {
  SKIP_WITHOUT_SHADERS;
  for (const auto& text :
       {ggx("float a2 = alpha * alpha;", whole, "alpha"),
        ggx("float a = roughness * roughness; float a2 = a * a;", whole, "roughness")}) {
    const auto a = audited(text);
    EXPECT_EQ(nearest(a), "ndf.ggx");
    EXPECT_EQ(slips(a), "");
    EXPECT_NEAR(a.laws.normalisation->value, 1, 1e-6);
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
  // A caller may have squared it: that is asked, no slip.
  const auto asked = audited(ggx("float a2 = roughness * roughness;", whole, "roughness"));
  EXPECT_EQ(slips(asked), "");
  EXPECT_HAS(text_of(asked), "check           roughness is taken for alpha");
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
  EXPECT_NEAR(a.laws.normalisation->value, 3.14159265, 1e-5);
}

constexpr const char* visible =
    "// alpha 0.05 1 0.3\nfloat V(float NoL, float NoV, float alpha) {\n  float a2 = alpha * "
    "alpha;\n  return HALF / (NoV * sqrt(NoL * NoL * (1.0 - a2) "
    "+ a2) + NoL * sqrt(NoV * NoV * (1.0 - a2) + a2));\n}\n";
TEST(AuditFile, AMissingHalfOfVisibilityIsFound) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_EQ(slips(audited(replaced(visible, "HALF", "0.5"))), "");
  const auto a = audited(replaced(visible, "HALF", "1.0"));
  EXPECT_EQ(nearest(a), "masking.smith_ggx.correlated");
  EXPECT_NE(slips(a).find("½ is missing"), std::string::npos) << text_of(a);
}

TEST(AuditFile, AMissingFourOfAWholeModelIsFoundAndItsCostIsBesideOurs) {
  SKIP_WITHOUT_SHADERS;
  const auto right = audited(tutorial("4.0"));
  ASSERT_TRUE(right.model);
  EXPECT_EQ(right.model->spec, "lambert+ggx/smith_ggx.separable/schlick");
  EXPECT_EQ(right.model->power, 2);
  EXPECT_EQ(slips(right), "");
  EXPECT_NE(text_of(right).find("beside ours"), std::string::npos);
  // In three channels D and G are computed once.
  EXPECT_LT(right.of.operations.total(), 2 * right.model->operations);
  EXPECT_FALSE(right.model->lacks_diffuse);
  const auto wrong =
      audited(replaced(tutorial("1.0"), "albedo / 3.14", "albedo * NoL * NoV / 3.14"));
  EXPECT_TRUE(wrong.model->lacks_diffuse);
  EXPECT_NE(slips(wrong).find("a 4 is missing"), std::string::npos) << text_of(wrong);
}

TEST(AuditFile, FresnelOfTheWrongCosineIsNotReciprocal) {
  SKIP_WITHOUT_SHADERS;
  const auto right = audited(whole_model("a * a", "a * a", "VoH"));
  EXPECT_LT(right.laws.reciprocity->value, 1e-6) << right.laws.reciprocity->at;
  EXPECT_GT(audited(whole_model("a * a", "a * a", "NoV")).laws.reciprocity->value, 0.5)
      << "at F0 = 1 alone, F is 1 whatever its cosine";
}

/// One channel of a highlight, with something added below.
std::string of_number() {
  const auto text = whole_model("a * a", "a * a", "VoH", " + 1e-4");
  return replaced(replaced(text, "vec3 f(", "float f("), "vec3 F0)", "float F0)");
}

TEST(AuditFile, AWholeModelIsKnownWhateverIsAddedBelowAndWhicheverAlphaItsPartsTake) {
  SKIP_WITHOUT_SHADERS;
  const auto added = audited(of_number());
  ASSERT_TRUE(added.model);
  EXPECT_EQ(slips(added), "");
  const auto mixed = audited(whole_model("a * a", "a", "VoH"));
  ASSERT_TRUE(mixed.model);
  EXPECT_HAS(slips(mixed), "alpha is roughness² in D and roughness in V");
  EXPECT_HAS(text_of(mixed), "alpha = roughness² in D, alpha = roughness in V");
  const auto cavity = audited(
      "// m 0.05 1 0.4\n// f0 0 1 0.04\nfloat f(vec3 N, vec3 V, vec3 L, float m, float f0) {\n  "
      "vec3 H = normalize(V + L);\n"
      "  float nl = dot(N, L), nv = dot(N, V), nh = dot(N, H), vh = dot(V, H), c = nh * nh;\n"
      "  float G = min(1.0, min(nl, nv) * 2.0 * nh / vh);\n"
      "  return exp((c - 1.0) / (m * m * c)) / (3.14159265358979 * m * m * c * c) * G * (f0 + (1.0 "
      "- f0) * pow(1.0 - vh, 5.0)) / (3.14159265358979 * nl * nv);\n}\n");
  ASSERT_TRUE(cavity.model);
  EXPECT_EQ(cavity.model->spec, "beckmann/cook_torrance/schlick");
  EXPECT_HAS(slips(cavity), "4/π times too large");
}

TEST(AuditFile, AModelOfAMetallicWorkflowIsComparedWithOurs) {
  SKIP_WITHOUT_SHADERS;
  const auto metal = [](const std::string& over, const std::string& kd) {
    auto text = replaced(tutorial(over), "// f0 0 1 0.04", "// metallic 0 1 0");
    text =
        replaced(text, "vec3 f0, vec3 albedo) {",
                 "float metallic, vec3 albedo) {\n  vec3 f0 = mix(vec3(0.04), albedo, metallic);");
    return audited(replaced(text, "albedo / 3.14", kd + " * albedo / 3.14"));
  };
  const auto right = metal("4.0", "(1.0 - metallic)");
  ASSERT_TRUE(right.model) << right.no_model;
  EXPECT_EQ(right.model->spec, "lambert+ggx/smith_ggx.separable/schlick");
  EXPECT_EQ(slips(right), "");
  EXPECT_HAS(slips(metal("1.0", "(1.0 - metallic)")), "a 4 is missing");
  EXPECT_EQ(slips(metal("4.0", "(1.0 - metallic) * (1.0 - f0)")), "");
  EXPECT_HAS(slips(metal("4.0", "3.14159265358979 * (1.0 - metallic)")),
             "its diffuse part is π times too large");
}

TEST(AuditFile, AMixOfF0ThatIsReversedIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& f0) {
    return OwnSlips(
               model_of("float roughness 0.1 1 0.5, float metallic 0 1 0, vec3 albedo 0 1 0.5",
                        "albedo * (1.0 - metallic) * (1.0 - " + f0 +
                            ") * (1.0 - p) / PI + "
                            "D_GGX(NoH, roughness * roughness) * V_Smith(NoL, NoV, roughness * "
                            "roughness) * (" +
                            f0 + " * (1.0 - p) + p)"))
        .slips;
  };
  EXPECT_HAS(of("mix(albedo, vec3(0.04), metallic)"),
             "albedo is F0 where metallic is 0: expected where it is 1");
  EXPECT_EQ(of("mix(vec3(0.04), albedo, metallic)"), "");
}

TEST(AuditFile, AFresnelSlipOfAWholeModelIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const std::string schlick = "(f0 + (1.0 - f0)", power = "pow(1.0 - VoH, 5.0)";
  const auto of = [&](const std::string& what, const std::string& by) {
    const auto a = audited(replaced(tutorial("4.0"), what, by));
    EXPECT_TRUE(a.model) << by;
    return slips(a);
  };
  EXPECT_HAS(of(power, "pow(1.0 - NoH, 5.0)"), "takes NoH where VoH belongs");
  EXPECT_HAS(of(power, "pow(1.0 - VoH, 4.0)"), "has the power 4");
  EXPECT_HAS(of(power, "pow(VoH, 5.0)"), "VoH⁵ where (1 − VoH)⁵ belongs");
  EXPECT_HAS(of("(1.0 - f0)", "f0"), "F0 + F0 (1 − VoH)⁵, expected");
  EXPECT_EQ(of(power, "exp2((-5.55473 * VoH - 6.98316) * VoH)"), "");
  EXPECT_EQ(of(power, "0.0"), "") << "a Fresnel term that is constant";
}

TEST(AuditFile, AFresnelFunctionsSlipIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& cosine, const std::string& value) {
    return slips(audited("// f0 0 1 0.04\nfloat F_Schlick(float " + cosine +
                         ", float f0) {\n  float x = pow(1.0 - " + cosine + ", 5.0);\n  return " +
                         value + ";\n}\n"));
  };
  EXPECT_EQ(of("VoH", "f0 + (1.0 - f0) * x"), "");
  EXPECT_HAS(of("VoH", "f0 + x"), "F0 + (1 − VoH)⁵");
  EXPECT_HAS(of("VoH", "mix(1.0, f0, x)"), "mixes from 1 to F0");
  EXPECT_HAS(of("VoH", "f0 + (1.0 - f0) * pow(1.0 - VoH, 4.0)"), "has the power 4");
  EXPECT_HAS(of("NoH", "f0 + (1.0 - f0) * x"), "whose cosine is VoH, and it takes NoH");
  // A colour that is clipped by one of its channels, as Unreal Engine has it.
  EXPECT_EQ(
      slips(audited("vec3 F_Schlick(vec3 c, float VoH) {\n  float x = pow(1.0 - VoH, 5.0);\n  "
                    "return clamp(50.0 * c.g, 0.0, 1.0) * x + (1.0 - x) * c;\n}\n")),
      "");
}

TEST(AuditFile, AGuardThatEatsThePeakIsNamedWithTheWidthAndTheLoss) {
  SKIP_WITHOUT_SHADERS;
  const auto d = audited(
      ggx("float a2 = alpha * alpha;", "a2 / max(3.14159265358979 * d * d, 0.001)", "alpha"));
  EXPECT_EQ(nearest(d), "ndf.ggx");
  EXPECT_HAS(slips(d), "a guard or a clamp cuts the peak below alpha 0.13");
  EXPECT_EQ(slips(d).find("a clamp at"), std::string::npos) << "no value is the largest of all";
  const auto held = audited(replaced(tutorial("4.0"), "(3.14159265358979 * d * d)",
                                     "max(3.14159265358979 * d * d, 0.001)"));
  EXPECT_HAS(slips(held), "cuts the peak below roughness 0.36");
  ASSERT_TRUE(held.highlight);
  EXPECT_LT(held.highlight->value, 0.01) << "the whole's albedo has the diffuse part's 1 in it";
  EXPECT_NEAR(audited(tutorial("4.0")).highlight->value, 1, 0.01);
  // One that bites where no material is so smooth is asked.
  const auto little = audited(
      replaced(tutorial("4.0"), "(3.14159265358979 * d * d)", "(3.14159265358979 * d * d + 1e-7)"));
  EXPECT_EQ(slips(little), "");
  EXPECT_HAS(text_of(little), "right where no material is so smooth");
}

TEST(AuditFile, AGuardTowardsTheHorizonIsNamedAndASmallOneIsNot) {
  SKIP_WITHOUT_SHADERS;
  const auto with = [](const std::string& below) {
    return slips(audited(replaced(tutorial("4.0"), "(4.0 * NoL * NoV)", below)));
  };
  EXPECT_HAS(with("max(4.0 * NoL * NoV, 0.1)"),
             "4 NoL NoV is held above 0.1: it is held down towards the horizon");
  EXPECT_EQ(with("(4.0 * NoL * NoV + 0.0001)"), "");
}

TEST(AuditFile, WhatAHighlightIsMultipliedWithBySlipIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto with = [](const std::string& below) {
    const auto a = audited(replaced(tutorial("4.0"), " / (4.0 * NoL * NoV)", below));
    EXPECT_TRUE(a.model) << below;
    return slips(a);
  };
  EXPECT_HAS(with(""), "G stands where V belongs");
  EXPECT_HAS(with(" * NoL / (4.0 * NoL * NoV)"), "has the cosine NoL in it");
  const auto fourth =
      audited(replaced(tutorial("4.0"), "pow(roughness, 4.0)", "pow(roughness, 8.0)"));
  EXPECT_HAS(slips(fourth), "squared once too often") << fourth.no_model;
}

TEST(AuditFile, AHighlightThatLacksItsPiWithoutAFormOfOursIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto phong = [](const std::string& norm) {
    return slips(
        audited("// shininess 1 1000 50\n// ks 0 1 0.1\n// kd 0 1 0.5\nvec3 f(vec3 N, vec3 L, "
                "vec3 V, float shininess, vec3 ks, vec3 kd) {\n  float s = (shininess + "
                "8.0) / " +
                norm +
                " * pow(max(dot(N, normalize(L + V)), 0.0), "
                "shininess);\n  return kd * (1.0 - ks) / 3.14159265358979 + ks * s;\n}\n"));
  };
  EXPECT_EQ(phong("(8.0 * 3.14159265358979)"), "");
  EXPECT_HAS(phong("8.0"), "its highlight is π times too large");
}

TEST(AuditFile, FormsThatNoFactorMakesOneOfOursAreNamed) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(
      slips(audited(ggx("float a2 = alpha * alpha;", "a2 / (3.14159265358979 * d)", "alpha"))),
      "not squared");
  EXPECT_HAS(slips(audited(
                 ggx("float a2 = alpha * alpha;", "alpha / (3.14159265358979 * d * d)", "alpha"))),
             "alpha stands above where alpha² belongs");
  const auto swapped =
      replaced(replaced(replaced(visible, "HALF", "0.5"), "(NoV * sqrt", "(NoL * sqrt"),
               "+ NoL * sqrt", "+ NoV * sqrt");
  EXPECT_HAS(slips(audited(swapped)), "NoL and NoV are swapped");
  const auto cloth = [](const std::string& four) {
    return slips(audited("float V_Neubelt(float NoV, float NoL) { return 1.0 / (" + four +
                         "(NoL + NoV - NoL * NoV)); }\n"));
  };
  EXPECT_EQ(cloth("4.0 * "), "");
  EXPECT_HAS(cloth(""), "4 times that of Neubelt");
}

TEST(AuditFile, FormsOfTwoWidthsAreKnownInEitherOrder) {
  SKIP_WITHOUT_SHADERS;
  const auto d = audited(
      "// ab 0.05 1 0.3\n// at 0.05 1 0.3\nfloat D(float NoH, float ToH, float BoH, float ab, "
      "float "
      "at) {\n  float x = ToH / at, y = BoH / ab, s = x * x + y * y + NoH * NoH;\n  return 1.0 / "
      "(3.14159265358979 * at * ab * s * s);\n}\n");
  EXPECT_EQ(nearest(d), "ndf.ggx_aniso");
  EXPECT_EQ(slips(d), "");
  const auto of_one = audited(
      "// at 0.05 1 0.3\n// ab 0.05 1 0.3\nfloat D(float NoH, float ToH, float BoH, float at, "
      "float "
      "ab) {\n  float x = ToH / at, y = BoH / ab, s = x * x + y * y + NoH * NoH;\n  return 1.0 / "
      "(3.14159265358979 * at * at * s * s);\n}\n");
  EXPECT_HAS(slips(of_one), "the form is right and its norm is not") << text_of(of_one);
  const auto v = [](const std::string& one, const std::string& other) {
    return audited(
        "// at 0.05 1 0.3\n// ab 0.05 1 0.3\nfloat V_Smith(float at, float ab, float ToV, float "
        "BoV, "
        "float ToL, float BoL, float NoV, float NoL) {\n  return 0.5 / (" +
        one + " * length(vec3(at * ToV, ab * BoV, NoV)) + " + other +
        " * length(vec3(at * ToL, ab * BoL, NoL)));\n}\n");
  };
  EXPECT_EQ(nearest(v("NoL", "NoV")), "masking.smith_ggx_aniso.correlated");
  EXPECT_HAS(slips(v("NoV", "NoL")), "NoL and NoV are swapped");
}

TEST(AuditFile, ADistributionWithoutAValueAtTheHorizonIsKnown) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// alpha 0.05 1 0.3\nfloat D(float NoH, float alpha) {\n  float a2 = alpha * alpha, c = NoH "
      "* "
      "NoH;\n  return exp((c - 1.0) / (a2 * c)) / (3.14159265358979 * a2 * c * c);\n}\n");
  EXPECT_EQ(nearest(a), "ndf.beckmann");
  EXPECT_EQ(slips(a), "");
}

TEST(AuditFile, AHalfVectorThatIsNotNormalisedIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(replaced(tutorial("4.0"), "normalize(L + V)", "(L + V) * 0.5"));
  ASSERT_TRUE(a.model) << a.no_model;
  EXPECT_HAS(slips(a), "its half vector is not normalised: it is (L + V)/2");
}

TEST(AuditFile, ALightBehindTheHorizonIsAsked) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& below) {
    const auto a = audited(
        "// f0 0 1 0.04\nfloat f(vec3 L, vec3 V, vec3 N, float f0) {\n  float NoL = "
        "max(dot(N, L), 0.0), NoV = max(dot(N, V), 0.0);\n  return f0 * NoL * NoV / (4.0 * "
        "NoL * NoV" +
        below + ");\n}\n");
    return text_of(a);
  };
  EXPECT_HAS(of(""), "check           a light behind the horizon has no value");
  EXPECT_EQ(of(" + 1e-5").find("behind the horizon"), std::string::npos);
}

TEST(AuditFile, HalfIsLookedAtWhereTheLawsAreIfThereAreNoBounds) {
  SKIP_WITHOUT_SHADERS;
  const auto* const text =
      "float D(float NoH, float a2) {\n  float d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return a2 / "
      "(3.14159265 * d * d);\n}\n";
  EXPECT_HAS(half_of(text), "finite for every input");
  const auto a = audited(text);
  ASSERT_EQ(a.not_looked_at.size(), 1U);
  EXPECT_HAS(a.not_looked_at[0], "a2 beyond 0.05 to 1");
}

TEST(AuditFile, WhyNoneOfOursIsBesideAModelIsSaid) {
  SKIP_WITHOUT_SHADERS;
  const auto none = replaced(replaced(tutorial("4.0"), "float roughness", "float q"),
                             "pow(roughness, 4.0", "pow(q, 3.0");
  EXPECT_HAS(text_of(audited(none)), "none of ours    no parameter is a width by its name");
}

TEST(AuditFile, AGainAtTheBoundAndAtGrazingViewsIsSeen) {
  SKIP_WITHOUT_SHADERS;
  // Of a sheen, only at the least roughness and beyond 85°.
  const auto a = audited(
      "// roughness 0.07 1 0.5\n// tint_color 0 1 0.5\nfloat f(float NoL, float NoV, float NoH, "
      "float roughness, float tint_color) {\n"
      "  float s2 = max(1.0 - NoH * NoH, 0.008);\n"
      "  return tint_color * (2.0 + 1.0 / roughness) * pow(s2, 0.5 / roughness) / (8.0 * "
      "3.14159265 * (NoL + NoV - NoL * NoV));\n}\n");
  EXPECT_GT(a.energy->albedo.value, 1.15);
  EXPECT_HAS(a.energy->albedo.at, "roughness 0.07");
}

TEST(AuditFile, ADiffusePartAndAHighlightGainNothingEachForItself) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(tutorial("4.0"));
  ASSERT_TRUE(a.energy->part);
  EXPECT_LT(a.energy->part->value, 1.001) << a.energy->part->at;
  EXPECT_NEAR(a.energy->albedo.value, 2, 0.01);
  EXPECT_HAS(text_of(a),
             "only the sum exceeds 1: the highlight returns 1 and the diffuse part 1; multiply the "
             "diffuse part");
}

TEST(AuditFile, AColourBlackIsNotAmongTheDarkestOfUpperBounds) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(of_number());
  EXPECT_HAS(a.energy->darkest.at, "F0 1");
  EXPECT_GT(a.energy->darkest.value, 0.2);
}

/// A highlight whose first parameter is no width.
std::string of_metallic() {
  const auto text = "// metallic 0 1 0\n" + replaced(whole_model("a * a", "a * a", "VoH"),
                                                     "float roughness, vec3 F0)",
                                                     "float metallic, float roughness, vec3 F0)");
  return replaced(text, "(F0 + (1.0 - F0)", "(F0 * metallic + (1.0 - F0 * metallic)");
}

TEST(AuditFile, AFunctionOfMetallicIsAuditedAndRoundingIsNotNegative) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(of_metallic());
  EXPECT_NEAR(a.energy->albedo.value, 1, 1e-3) << "of a smooth metal";
  EXPECT_FALSE(a.laws.lowest) << a.laws.lowest->value << " at " << a.laws.lowest->at;
}

TEST(AuditFile, AnAlbedoIsNoModelAndAHelperIsNone) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(text_of(audited("// f0 0 1 0.04\nvec3 env(vec3 f0, float NoV) { return f0 + (1.0 - "
                             "f0) * exp(-9.0 * NoV); }\n")),
             "it takes a view and no light");
  EXPECT_HAS(text_of(audited("float sqr(float x) { return x * x; }\n")), "it takes no direction");
}

TEST(AuditFile, WhatIsSafeInHalfIsNamedByTheWidthAndContradictsNothing) {
  SKIP_WITHOUT_SHADERS;
  const auto half = half_of(of_metallic());
  EXPECT_HAS(half, "for NoL and NoV from 0.05");
  EXPECT_HAS(half, "; from roughness ");
  EXPECT_EQ(half.find("from roughness 0.05"), half.npos) << half;
  EXPECT_EQ(half.find("e-08"), half.npos) << "light and view that graze: " << half;
  EXPECT_EQ(half.find("prove"), half.npos) << "a search finds more than a proof reaches: " << half;
}

TEST(AuditFile, GIsLookedAtInHalfAsItsTextHasIt) {
  SKIP_WITHOUT_SHADERS;
  const auto* const text =
      "// k 0.1 1 0.5\nfloat G_Smith(float NoV, float NoL, float k) { return NoV / (NoV * (1.0 - "
      "k) "
      "+ k) * NoL / (NoL * (1.0 - k) + k); }\n";
  EXPECT_TRUE(audited(text).of.function->is_g);
  EXPECT_EQ(half_of(text), "finite for every input of its domain")
      << "4 NoL NoV is no division of its own";
}

TEST(AuditFile, ACosinePowerIsNamedByItsExponent) {
  SKIP_WITHOUT_SHADERS;
  const auto power = [](const char* norm) {
    return audited(std::string("// shininess 1 1000 20\nfloat D(float NoH, float shininess) { "
                               "return (shininess + ") +
                   norm + " * pow(NoH, shininess); }\n");
  };
  const auto right = power("2.0) / (2.0 * 3.14159265358979)");
  EXPECT_EQ(nearest(right), "ndf.blinn_phong");
  EXPECT_EQ(slips(right), "");
  const auto lobe = power("8.0) / (2.0 * 3.14159265358979)");
  EXPECT_EQ(nearest(lobe), "ndf.blinn_phong");
  EXPECT_NE(slips(lobe).find("its norm is not"), std::string::npos) << slips(lobe);
}

TEST(AuditFile, InputsWithoutAValueAreNamedAndTheAlbedoIsNoNumberThere) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const char* value) {
    return audited(std::string("// kd 0 1 0.5\nfloat f(float NoL, float NoV, float NoH, float kd) "
                               "{ return kd / 3.14159265 + 0.0 * NoH * NoL * ") +
                   value + "; }\n");
  };
  const auto grazing = of("sqrt(NoV - 0.02)");
  EXPECT_NE(grazing.laws.not_finite_at.find("NoV 0.001"), std::string::npos)
      << grazing.laws.not_finite_at;
  const auto normal = of("(1.0 - NoV) / (1.0 - NoV)");
  EXPECT_NE(text_of(normal).find("albedo has no value at"), std::string::npos) << text_of(normal);
  EXPECT_EQ(text_of(normal).find("gains none"), std::string::npos);
}

TEST(AuditFile, BoundsOfAnAlphaHoldInHalf) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(half_of(replaced(ggx("float a2 = alpha * alpha;", whole, "alpha"), "0.05", "0.2")),
             "finite for every input");
}

TEST(AuditFile, WhatIsSaidOfArgumentsGoesToTheFunctionsThatHaveThem) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write("two.glsl",
                                 "// f0 0 1 0.04\nvec3 F_Schlick(float u, vec3 f0) { return f0 + "
                                 "(1.0 - f0) * pow(1.0 - u, 5.0); }\n"
                                 "float f(float NoL, float NoV, float NoH) { return (NoL + 1e-5) / "
                                 "3.14159265 + 0.0 * NoH * NoV; }\n");
  auto all = audit_file(path, {}, false);
  EXPECT_NE(text_of(all[0]).find("--argument u=voh"), std::string::npos) << text_of(all[0]);
  EXPECT_EQ(all[1].of.function->includes, "cosine") << "1e-5 beside it is none of its own";
  all = audit_file(path + "{argument.u=voh;includes=nothing}", {}, false);
  EXPECT_EQ(nearest(all[0]), "fresnel.schlick");
  EXPECT_EQ(all[1].of.function->includes, "nothing");
  EXPECT_FALSE(all[1].of.function->guessed);
  EXPECT_HAS(test::refusal([&] { audit_file(path + "{argument.q=voh}"); }, Exit::usage), "'q'");
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
  const Folder folder;
  const auto path = folder.write("g.glsl",
                                 "// roughness 0.05 1 0.5\nfloat G1(float c, float k) { return c / "
                                 "(c * (1.0 - k) + k); }\nfloat "
                                 "G_Smith(float NoL, float NoV, float roughness) {\n  float k = "
                                 "(roughness + 1.0) * (roughness + "
                                 "1.0) / 8.0;\n  return G1(NoL, k) * G1(NoV, k);\n}\n");
  const auto g = audit_file(path + ":G_Smith", {}, false)[0];
  EXPECT_EQ(nearest(g), "masking.schlick_ggx.direct");
  EXPECT_EQ(slips(g), "") << "right for lamps";
  EXPECT_HAS(text_of(g), "check           its k is that of direct light");
}

TEST(AuditFile, AModelThatGainsLightIsToldWhere) {
  SKIP_WITHOUT_SHADERS;
  const auto a =
      audited("// kd 0 1 0.5\nfloat f(vec3 L, vec3 V, vec3 N, float kd) { return kd; }\n");
  EXPECT_EQ(a.of.function->includes, "pi");
  EXPECT_NEAR(a.energy->albedo.value, 1, 1e-3);
  const Folder folder;
  const auto path = folder.write(
      "gain.glsl", "// kd 0 1 0.5\nfloat f(vec3 L, vec3 V, vec3 N, float kd) { return kd; }\n");
  const auto b = audit_file(path + ":f{includes=nothing}")[0];
  EXPECT_NEAR(b.energy->albedo.value, 3.14159, 1e-3);
  EXPECT_NE(text_of(b).find("gains: albedo 3.14"), std::string::npos);
}

TEST(AuditFile, AFactorThatTheEnergyContradictsIsNoSlip) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& factor) {
    return slips(audited(
        "// gloss 0 1 0.7\n// f0 0 1 0.2\nvec3 mobile(vec3 N, vec3 V, vec3 L, vec3 f0, float "
        "gloss) {\n"
        "  vec3 H = normalize(V + L);\n  float NoH = dot(N, H), VoH = dot(V, H);\n"
        "  float r = max(1.0 - gloss, 0.08), a = r * r, d = NoH * NoH * (a * a - 1.0) + 1.0;\n"
        "  return a * a / (3.14159265358979 * d * d) * " +
        factor + " / (VoH * VoH * (a + 0.5)) * (f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0));\n}\n"));
  };
  EXPECT_EQ(of("0.125"), "") << "its smooth highlight returns all light";
  EXPECT_HAS(of("0.5"), "its highlight is");
}

TEST(AuditFile, AHelperOfOneCosineWithValuesOfFresnelIsAFresnelTerm) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& cosine) {
    return audited("float reflected(float " + cosine + ", float eta) {\n  float c = " + cosine +
                   ", t = sqrt(max(0.0, 1.0 - (1.0 - c * c) / (eta * eta)));\n"
                   "  float p = (eta * c - t) / (eta * c + t), s = (c - eta * t) / (c + eta * t);\n"
                   "  return 0.5 * (p * p + s * s);\n}\n");
  };
  const auto a = of("cosThetaI");
  EXPECT_FALSE(a.energy) << "it is no BRDF";
  EXPECT_EQ(nearest(a), "fresnel.dielectric") << text_of(a);
  EXPECT_HAS(a.not_looked_at[0], "eta beyond 1.1 to 2.5");
}

TEST(AuditFile, GuardsDoNotHideAModel) {
  SKIP_WITHOUT_SHADERS;
  const auto below = audited(replaced(tutorial("4.0"), "* NoL * NoV)", "* NoL * NoV + 0.001)"));
  ASSERT_TRUE(below.model) << below.no_model;
  EXPECT_EQ(slips(below), "");
  EXPECT_HAS(text_of(below), "0.001 is added to 4 NoL NoV");
  const auto least = audited(replaced(tutorial("4.0"), "pow(roughness, 4.0)",
                                      "pow(max(0.001, pow(roughness, 4.0)), 2.0)"));
  ASSERT_TRUE(least.model) << least.no_model;
  EXPECT_HAS(slips(least), "roughness is squared once too often");
}

TEST(AuditFile, ADistributionOfNoFormOfOursIsNormalisedOrItsFactorIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& norm) {
    return slips(
        audited("// q 0.1 1 0.5\nfloat D(float NoH, float q) {\n  float s = sqrt(1.0 - NoH * "
                "NoH);\n  return (2.0 + 1.0 / q) * pow(s, 1.0 / q) / " +
                norm + ";\n}\n"));
  };
  EXPECT_EQ(of("(2.0 * 3.14159265358979)"), "");
  EXPECT_HAS(of("1.0"), "1/(2π) is missing");
}

TEST(AuditFile, WhatIsReturnedAtLeastReadsAsNoLoss) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(text_of(audited(tutorial("4.0"))), "returns         at least 131 % of the light");
}

}  // namespace
}  // namespace gonio
