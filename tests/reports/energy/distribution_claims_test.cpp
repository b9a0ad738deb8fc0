#include "reports/energy/distribution_claims.h"

#include <algorithm>
#include <cmath>

#include "reports/plain.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

Findings judged(const EnergyRows& r) {
  Findings said;
  judge_distributions_and_sums(said, r);
  test::expect_plain(said);
  return said;
}

TEST(DistributionClaims, PhongLeavesBeckmannAsSurfacesGetRough) {
  const auto all = phong_from_beckmann();
  ASSERT_GT(all.size(), 2U);
  EXPECT_LT(all.front().share, 0.02);
  EXPECT_GT(all.back().share, 0.1);
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, &ClaimRows::Apart::share));
  // Both by Simpson's rule over θ, as they are written in seed 002.
  const double alpha = all.back().roughness * all.back().roughness, p = 2 / (alpha * alpha) - 2;
  const auto integrand = [&](double theta) {
    const double c = std::cos(theta), t = std::tan(theta);
    const double phong = (p + 2) / 2 * std::pow(c, p),
                 beckmann = std::exp(-t * t / (alpha * alpha)) / (alpha * alpha * std::pow(c, 4));
    return std::abs(phong - beckmann) * c * std::sin(theta);
  };
  constexpr int n = 20'000;
  const double h = std::acos(-1) / 2 / n;
  double sum = 0;
  for (int i = 1; i < n; ++i) sum += integrand(i * h) * (i % 2 ? 4 : 2);
  EXPECT_NEAR(all.back().share, sum * h / 3, 1e-3);
}

TEST(DistributionClaims, AreJudgedByTheirFigures) {
  using enum Claim::Judged;
  EnergyRows r;
  EXPECT_TRUE(judged(r).claims.empty());
  r.claims.phong_from_beckmann = {{0.2, 0.004}, {0.9, 0.3}};
  EXPECT_EQ(judged(r).claims.at(0).judged, partly);
  r.claims.phong_from_beckmann = {{0.2, 0.1}, {0.9, 0.3}};
  EXPECT_EQ(judged(r).claims.at(0).judged, fails);
}

TEST(DistributionClaims, ARiemannSumIsOffByItsBias) {
  using enum Claim::Judged;
  EnergyRows r;
  const auto rule = [](std::string_view name, double bias) {
    return IrradianceRow{"sky", name, 64, 0.1, 0.3, bias, 50, 1};
  };
  r.light.irradiance = {rule("riemann", -0.055), rule("riemann_midpoint", 0.003)};
  const auto c = judged(r).claims.at(0);
  EXPECT_EQ(c.judged, partly);
  EXPECT_EQ(c.figure, "−5.5\u00a0% at 64 samples");
  r.light.irradiance[0].bias = -0.2;
  EXPECT_EQ(judged(r).claims.at(0).judged, fails);
}

TEST(DiffuseForms, LambertGivesBackAllAndDisneysMore) {
  const EnergyOptions few{false, {0.3, 1}, {0.1, 0.5, 1}, 1024};
  const auto all = diffuse_forms(few);
  const auto of = [&](std::string_view id) {
    const auto at = std::ranges::find(all, id, &DiffuseForm::id);
    return at == all.end() ? 0 : at->most_albedo;
  };
  EXPECT_NEAR(of("diffuse.lambert"), 1, 1e-4);
  EXPECT_GT(of("diffuse.disney"), 1.2);
  EXPECT_LT(of("diffuse.eon"), 1.001);
  EXPECT_EQ(of("diffuse.lambert.coupled"), 0) << "needs a lobe";
}

}  // namespace
}  // namespace gonio
