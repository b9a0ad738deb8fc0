#include "reports/remap/influence.h"

#include "reports/plain.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// E without masking over E with it: at cosine 0.1 and 0.5, roughness 0.3 and 1.
RemapRows with(double head_on, double grazing, double rough) {
  RemapRows r;
  r.mu = {0.1, 0.5};
  RemapForm none, smith;
  none.form = "masking.none", smith.form = "masking.smith_ggx.correlated";
  none.at = {{0.3, {grazing, head_on}, 0, {}}, {1, {rough, rough}, 0, {}}};
  smith.at = {{0.3, {1, 1}, 0, {}}, {1, {1, 1}, 0, {}}};
  r.forms = {none, smith};
  return r;
}
Claim judged(const RemapRows& r) {
  Findings said;
  judge_influence_of_masking(said, r);
  test::expect_plain(said);
  return said.claims.empty() ? Claim{} : said.claims[0];
}

TEST(InfluenceOfMasking, IsJudgedWhereSurfacesAreNeitherRoughNorGrazed) {
  using enum Claim::Judged;
  EXPECT_EQ(judged(with(1.005, 3, 4)).judged, holds);
  EXPECT_EQ(judged(with(1.05, 3, 4)).judged, partly);
  EXPECT_EQ(judged(with(1.2, 1, 1)).judged, fails);
}

TEST(InfluenceOfMasking, SaysHowMuchItIsElsewhere) {
  EXPECT_NE(
      judged(with(1.05, 3, 4)).verdict.find("roughness 1 GGX without G reflects 300\u00a0% more"),
      std::string::npos)
      << judged(with(1.05, 3, 4)).verdict;
  EXPECT_NE(judged(with(1.05, 14, 4)).verdict.find("roughness 0.3 GGX without G reflects 14 times"),
            std::string::npos);
}

TEST(InfluenceOfMasking, IsNotJudgedWithoutTheFormThatMasksNothing) {
  auto r = with(1.05, 3, 4);
  r.forms.erase(r.forms.begin());
  Findings said;
  judge_influence_of_masking(said, r);
  EXPECT_TRUE(said.claims.empty());
}

}  // namespace
}  // namespace gonio
