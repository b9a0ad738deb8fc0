#include "reports/plain.h"
#include "reports/stability/measure.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

StabilityRow in_half(std::string id, double worst, std::uint64_t overflow = 0) {
  StabilityRow r{};
  r.id = std::move(id), r.number = "half", r.worst_rel = worst, r.overflow = overflow;
  r.tolerance = 0.02;
  return r;
}
Claim judged(const StabilityRow& f, const StabilityRow& g) {
  StabilityRows r;
  r.rows = {f, g};
  Findings said;
  stabilities::judge_f_and_g_in_half(said, r);
  test::expect_plain(said);
  return said.claims.empty() ? Claim{} : said.claims[0];
}

TEST(StabilityClaims, HalfServesFAndGWhereBothKeepTheirTolerance) {
  using enum Claim::Judged;
  const auto f = in_half("fresnel.schlick", 0.004), g = in_half("masking.ue_joint.clamped", 0.01);
  EXPECT_EQ(judged(f, g).judged, holds);
  EXPECT_EQ(judged(in_half("fresnel.schlick", 0.03), g).judged, partly);
  const auto over = in_half("masking.ue_joint.clamped", 0.01, 3);
  EXPECT_EQ(judged(f, over).judged, partly);
  EXPECT_NE(judged(f, over).verdict.find("has inputs without a value"), std::string::npos);
  EXPECT_EQ(judged(in_half("fresnel.schlick", 0.03), over).judged, fails);
  EXPECT_TRUE(judged(f, f).claim.empty());
}

TEST(StabilityClaims, SayWhatTheClampChangesBesideRounding) {
  StabilityRows r;
  r.rows = {in_half("fresnel.schlick", 0.004), in_half("masking.ue_joint.clamped", 0.0024)};
  ClampRow c{};
  c.where = "masking.ue_joint.clamped", c.by = "cosine", c.number = "half";
  c.changed_to = 0.016, c.changed_most = 0.9996;
  r.clamps = {c};
  Findings said;
  stabilities::judge_f_and_g_in_half(said, r);
  test::expect_plain(said);
  const auto& verdict = said.claims.at(0).verdict;
  EXPECT_NE(verdict.find("off by up to 0.24\u00a0% by rounding"), verdict.npos) << verdict;
  EXPECT_NE(
      verdict.find("by up to 100\u00a0%, and by over 1\u00a0% where the cosine is at most 0.016."),
      verdict.npos)
      << verdict;
}

}  // namespace
}  // namespace gonio
