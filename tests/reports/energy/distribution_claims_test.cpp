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
  // Both by Simpson's rule over θ, as they are printed.
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
  EXPECT_EQ(c.figure, "the sum is off by −5.5\u00a0% at 64 samples");
  r.light.irradiance[0].bias = -0.2;
  EXPECT_EQ(judged(r).claims.at(0).judged, fails);
}

}  // namespace
}  // namespace gonio
