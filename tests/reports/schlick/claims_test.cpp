#include "reports/schlick/claims.h"

#include <algorithm>

#include "reports/plain.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// What Schlick and a masking show of glass and of a metal.
SchlickRows shown(double glass, double masked_glass, double metal, double masked_metal) {
  SchlickRows r;
  r.rough.colours = {{"fresnel.schlick", "IOR 1.5", 1, {0, glass}},
                     {"fresnel.schlick", "iron", 0.1, {metal, 0}},
                     {"fresnel.f82", "iron", 0.1, {99}}};
  r.masked = {{"IOR 1.5", "dielectric", masked_glass}, {"iron", "metal", masked_metal}};
  return r;
}
Findings judged(const SchlickRows& r) {
  Findings said;
  judge_what_stands_beside_f(said, r);
  test::expect_plain(said);
  return said;
}
Claim about(const Findings& said, std::string_view words) {
  const auto at = std::ranges::find_if(
      said.claims, [&](const Claim& c) { return c.claim.find(words) != c.claim.npos; });
  return at == said.claims.end() ? Claim{} : *at;
}

TEST(FresnelClaims, OtherFactorsAreWorseOnlyWhereSchlickShowsLessThanHalfOfThem) {
  using enum Claim::Judged;
  EXPECT_EQ(about(judged(shown(3, 4, 1, 9)), "other factors").judged, partly);
  EXPECT_EQ(about(judged(shown(1, 4, 1, 9)), "other factors").judged, holds);
  EXPECT_EQ(about(judged(shown(3, 4, 5, 9)), "other factors").judged, fails);
  const auto c = about(judged(shown(3, 4, 1, 9)), "other factors");
  EXPECT_NE(c.verdict.find("For 1 of 1 metals and none of the dielectrics,"), c.verdict.npos)
      << c.verdict;
}

TEST(FresnelClaims, ADielectricOfMoreThanFourPercentIsNoMetal) {
  const auto c = about(judged({}), "means metal");
  EXPECT_EQ(c.judged, Claim::Judged::fails);
  EXPECT_NE(c.figure.find(": F0 0."), c.figure.npos) << c.figure;
}

TEST(FresnelClaims, AColourBesideFCountsTwice) {
  const auto c = about(judged({}), "SpecularColor");
  EXPECT_EQ(c.judged, Claim::Judged::fails);
  EXPECT_NE(c.figure.find("0.16\u00a0% instead of 4\u00a0%"), c.figure.npos) << c.figure;
}

TEST(FresnelClaims, MaskingIsComparedUnderTheSameFresnelTerm) {
  const SchlickOptions few{false, {1.5}, 90, {0.3}};
  const auto all = masked_rows(few, [](double) {});
  const auto glass = std::ranges::find(all, "IOR 1.5", &MaskingColour::material);
  ASSERT_NE(glass, all.end());
  EXPECT_GT(glass->delta_e, 0.5);
  EXPECT_LT(glass->delta_e, 40);
  EXPECT_GT(std::ranges::count(all, "metal", &MaskingColour::kind), 5);
  // Smooth surfaces mask little.
  const auto smooth = masked_rows({false, {1.5}, 90, {0.05}}, [](double) {});
  EXPECT_LT(std::ranges::find(smooth, "IOR 1.5", &MaskingColour::material)->delta_e,
            glass->delta_e / 2);
}

}  // namespace
}  // namespace gonio
