#include "reports/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "integrate/albedo/directional_albedo.h"
#include "many_fits.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

const EntryAudit& entry(const std::string& id) {
  static std::map<std::string, EntryAudit> known;
  auto it = known.find(id);
  if (it == known.end()) it = known.emplace(id, audit({id})[0]).first;
  return it->second;
}
bool violates(const std::string& id, std::string_view law) {
  return std::ranges::find(entry(id).violates, law) != entry(id).violates.end();
}

TEST(Audit, CallsAMistakeWhatDiffersFromTheFormItIsNamedForAndNothingElse) {
  const std::set<std::string> expected{"ndf.gtr.as_written",        "ndf.beckmann_aniso.as_written",
                                       "ndf.ggx.ue_mobile",         "ndf.ggx.mobile",
                                       "ndf.ggx.mobile.cross",      "masking.ue_joint.clamped",
                                       "fresnel.linear.as_written", "f0.from_ior.as_written",
                                       "model.ue_mobile",           "model.ue_mobile_simple"};
  std::set<std::string> claims;
  for (const auto& t : catalogue())
    if (!t.about->named_for.empty()) claims.insert(std::string(t.about->id));
  for (const auto& m : maps())
    if (!m.about->named_for.empty()) claims.insert(std::string(m.about->id));
  for (const auto& p : presets())
    if (!p.about.named_for.empty()) claims.insert(std::string(p.about.id));
  EXPECT_EQ(claims, expected);  // nothing else claims to be another form
  const std::set<std::string> quick{"f0.from_ior.as_written", "fresnel.linear.as_written"};
  for (const auto& id : test::few(2) > 1 ? expected : quick) EXPECT_TRUE(entry(id).mistake) << id;
}

TEST(Audit, FindsEveryReferenceThatAnEntryNames) {
  const auto ids = auditable_ids();
  const auto check = [&](const About& a) {
    for (const auto reference : {a.approximates, a.named_for})
      EXPECT_TRUE(reference.empty() || std::ranges::find(ids, reference) != ids.end())
          << a.id << ": " << reference;
  };
  for (const auto& t : catalogue()) check(*t.about);
  for (const auto& m : maps()) check(*m.about);
  for (const auto& p : presets()) check(p.about);
}

TEST(Audit, ExactDistributionsAreNormalisedAndKeepEnergy) {
  for (const std::string id : {"ndf.ggx", "ndf.beckmann", "ndf.ggx_aniso"}) {
    const auto& e = entry(id);
    EXPECT_NEAR(e.normalisation->value, 1, 1e-9) << id;
    EXPECT_LE(e.energy->value, 1 + e.energy->error) << id;
    EXPECT_TRUE(e.violates.empty()) << id;
  }
}

TEST(Audit, TheMobileDistributionsAreJudgedInTheLightThatTheyAreMadeFor) {
  for (const std::string id : {"ndf.ggx.ue_mobile", "ndf.ggx.mobile", "ndf.ggx.mobile.cross"}) {
    EXPECT_DOUBLE_EQ(entry(id).light_unit, std::numbers::pi) << id;
    EXPECT_FALSE(violates(id, "energy")) << id;
    // What is left of their mistake is the clamp at 2048, of 1/α² = 1e8 at the peak of alpha 1e-4.
    EXPECT_TRUE(violates(id, "normalisation")) << id;
    EXPECT_NEAR(entry(id).highest->value, 2048 / std::numbers::pi, 1) << id;
    EXPECT_LT(entry(id).normalisation->value, 0.01) << id;
  }
  EXPECT_EQ(entry("ndf.ggx").light_unit, 1);
  EXPECT_GT(entry("model.ue_mobile_simple").energy->value, 1.2);
  EXPECT_LT(entry("model.ue_mobile_simple").energy->value, 1.3);
}

TEST(Audit, JudgesBerryByTheMaskingOfItsOwnShape) {
  const auto& e = entry("ndf.gtr1");
  EXPECT_EQ(e.energy_of, "gtr1/smith_gtr.correlated/constant");
  EXPECT_LT(e.energy->value, 1);
  EXPECT_GT(e.energy->value, 0.9);
  EXPECT_TRUE(e.violates.empty());
  // The same distribution by its general form
  const auto b = bind_model("gtr/smith_gtr.correlated/constant",
                            {{"alpha", {1e-4}}, {"gamma", {1}}, {"f0", {1}}}, 1);
  EXPECT_NEAR(e.energy->value, directional_albedo(b, {{1}}, 0, {1e-6})[0].value[0], 1e-5);
}

TEST(Audit, AVerdictSaysHowFarAnEntryIsFromItsForm) {
  EXPECT_EQ(verdict(entry("ndf.ggx")), "keeps the laws");
  const auto k = verdict(entry("masking.schlick_ggx.direct"));
  EXPECT_TRUE(k.starts_with("keeps the laws; far from smith_ggx.separable (up to 0.")) << k;
  EXPECT_EQ(verdict(entry("masking.none")).find("breaks energy"), 0U);
  EXPECT_EQ(verdict(entry("ndf.blinn_phong")), "keeps the laws; has no masking of its own");
  EXPECT_EQ(verdict(entry("diffuse.lambert")), "keeps the laws; 1.9 with a lobe on it");
}

TEST(Audit, TheIntegralOfBeckmannWithItsDivisionCancelledDiverges) {
  EXPECT_FALSE(std::isfinite(entry("ndf.beckmann_aniso.as_written").normalisation->value));
  EXPECT_TRUE(violates("ndf.beckmann_aniso.as_written", "normalisation"));
}

TEST(Audit, DisneyDiffuseReflectsOneAndAHalfOfWhatItReceives) {
  const auto& e = entry("diffuse.disney");
  EXPECT_NEAR(e.energy->value, 1.52, 0.005);
  EXPECT_NE(e.energy->where.find("alpha 1"), std::string::npos) << e.energy->where;
  EXPECT_NE(e.energy->where.find("NoV 0.02"), std::string::npos) << e.energy->where;
  EXPECT_TRUE(violates("diffuse.disney", "energy"));
}

TEST(Audit, UncoupledLambertExceedsOneUnderALobeAndNotAlone) {
  const auto& e = entry("diffuse.lambert");
  EXPECT_NEAR(e.energy->value, 1, 1e-6);
  EXPECT_GT(e.energy_under_lobe->value, 1.1);
  EXPECT_FALSE(violates("diffuse.lambert", "energy"));
  EXPECT_TRUE(
      violates("diffuse.disney.coupled", "energy"));  // made for a lobe, and too bright under one
}

TEST(Audit, SmithMaskingOfItsOwnDistributionKeepsEveryLaw) {
  for (const std::string id :
       {"masking.smith_ggx.separable", "masking.smith_ggx.correlated",
        "masking.smith_beckmann.correlated", "masking.smith_ggx_aniso.correlated",
        "masking.smith_beckmann_aniso.correlated"})
    EXPECT_TRUE(entry(id).violates.empty()) << id << ": " << entry(id).violates[0];
}

TEST(Audit, NoMaskingMakesLight) {
  EXPECT_TRUE(violates("masking.none", "energy"));
  EXPECT_TRUE(violates("masking.disney_coat", "energy"));  // its width is not the distribution's
}

TEST(Audit, AClampOfOneCosineIsNotReciprocal) {
  EXPECT_TRUE(violates("masking.ue_joint.clamped", "reciprocity"));
  EXPECT_GT(entry("masking.ue_joint.clamped").reciprocity->value, 1e-5);
  EXPECT_FALSE(violates("masking.ue_joint", "reciprocity"));
}

TEST(Audit, F0WithoutItsSquareIsNegativeFromTheDenserSide) {
  EXPECT_TRUE(violates("f0.from_ior.as_written", "range"));
  EXPECT_FALSE(violates("f0.from_ior", "range"));
}

TEST(Audit, MeasuresHowFarAnApproximationIsFromItsForm) {
  // F0 + (1 − F0) m against F0 + (1 − F0) m⁵ at F0 = 0: the most of m − m⁵ is 4/5 · 5^(−1/4)
  const auto& linear = *entry("fresnel.linear.as_written").distance;
  EXPECT_EQ(linear.reference, "fresnel.schlick");
  EXPECT_NEAR(linear.most.value, 0.8 * std::pow(5, -0.25), 1e-3);
  EXPECT_GT(linear.most.value, linear.rms);
  // k = alpha/2 stands for Smith's G1, which has its greatest distance at alpha = 1
  EXPECT_NEAR(entry("masking.smith_beckmann.rational").distance->most.value, 0.006, 0.001);
}

TEST(Audit, CountsTheOperationsOfOneSample) {
  const auto& ops = *entry("ndf.ggx").operations;
  EXPECT_EQ(ops[Operation::div], 1U);
  EXPECT_EQ(ops[Operation::exp], 0U);
  EXPECT_EQ(entry("ndf.beckmann").operations.value()[Operation::exp], 1U);
}

TEST(Audit, RefusesAnUnknownIdBeforeAnyWork) {
  EXPECT_ANY_THROW(audit({"ndf.ggx", "ndf.gxg"}));
}

}  // namespace
}  // namespace gonio
