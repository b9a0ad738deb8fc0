#include "reports/cost/claims.h"

#include <algorithm>
#include <cmath>

#include "reports/plain.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Rows in float, in cache, of the best instruction set.
CostRows rows_of(const std::vector<std::pair<std::string, double>>& all) {
  CostRows r;
  r.machine.instruction_sets = {"scalar", "avx2"};
  for (const auto& [id, ns] : all) {
    CostRow row{};
    row.id = id, row.number = "float", row.isa = "avx2", row.memory = "cache";
    row.way = id.starts_with("ggx/") ? "composed" : "";
    row.time = {ns, 0.01};
    r.rows.push_back(row);
  }
  return r;
}
Claim judged(const CostRows& r) {
  Findings said;
  judge_costs(said, r);
  test::expect_plain(said);
  return said.claims.empty() ? Claim{} : said.claims[0];
}
CostRows maskings(double schlick, double clamped) {
  return rows_of({{"masking.schlick_ggx.direct", schlick},
                  {"masking.ue_joint.clamped", clamped},
                  {"masking.hammon", 0.2}});
}
CostRows fresnels(double exact, double whole) {
  return rows_of({{"fresnel.schlick", 0.1},
                  {"fresnel.dielectric", exact},
                  {"ggx/smith_ggx.correlated/schlick", 1},
                  {"ggx/smith_ggx.correlated/dielectric", whole}});
}

TEST(CostClaims, SchlicksMaskingIsHeldAgainstTheJointFormAsItIsPrinted) {
  using enum Claim::Judged;
  EXPECT_EQ(judged(maskings(0.23, 0.39)).judged, partly) << "0.20 without the clamp";
  EXPECT_EQ(judged(maskings(0.23, 0.21)).judged, holds);
  EXPECT_EQ(judged(maskings(0.23, 0.225)).judged, partly) << "a tie";
  EXPECT_EQ(judged(maskings(0.23, 0.39)).figure,
            "Schlick's 0.23 ns, Unreal's joint form 0.20 ns, 0.39 ns with its clamp");
}

TEST(CostClaims, ADifferenceThatOneProcessDoesNotFindIsATie) {
  using enum Claim::Judged;
  auto r = maskings(0.23, 0.21);
  r.rows[0].each = {0.23, 0.23, 0.24}, r.rows[1].each = {0.21, 0.21, 0.22};
  EXPECT_EQ(judged(r).judged, holds);
  r.rows[0].each[2] = 0.215;
  EXPECT_EQ(judged(r).judged, partly);
  EXPECT_EQ(judged(r).figure,
            "Schlick's 0.23 ns, Unreal's joint form 0.20 ns, 0.21 ns (within the spreads) with its "
            "clamp");
}

TEST(CostClaims, ExactFresnelIsSlowIfAWholeModelIs) {
  using enum Claim::Judged;
  EXPECT_EQ(judged(fresnels(0.7, 1.3)).judged, partly);
  EXPECT_EQ(judged(fresnels(0.7, 1.7)).judged, holds);
  EXPECT_EQ(judged(fresnels(0.11, 1.01)).judged, fails);
}

TEST(CostClaims, AFifthPowerIsTheSameToRoundingEitherWay) {
  CostRows r;
  r.machine.instruction_sets = {"scalar"};
  r.points = power_points({1, 1e-9, true});
  ASSERT_EQ(r.points.size(), 2U);
  for (const auto& p : r.points) EXPECT_LT(p.error, 1e-6) << p.label;
  r.points[0].time = {10, 0.1}, r.points[1].time = {2, 0.1};
  EXPECT_EQ(judged(r).judged, Claim::Judged::holds);
  EXPECT_EQ(judged(r).figure, "pow takes 5.0 times as long");
  r.points[0].time = {2.1, 0.1};
  EXPECT_EQ(judged(r).judged, Claim::Judged::fails);
}

}  // namespace
}  // namespace gonio
