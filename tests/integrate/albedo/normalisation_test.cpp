#include "integrate/albedo/normalisation.h"

#include <cmath>
#include <limits>

#include "brdf/catalogue/registry.h"

namespace gonio {
namespace {

constexpr double alphas[] = {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.7, 1};

void expect_one(std::size_t term, std::vector<double> parameters) {
  const auto n = normalisation(term, parameters);
  EXPECT_NEAR(n.value, 1, n.error)
      << catalogue()[term].about->id << " " << testing::PrintToString(parameters);
  EXPECT_LE(n.error, 1e-11);
}

TEST(Normalisation, IsOneForGgx) {
  for (const double alpha : alphas) expect_one(find_term("ndf.ggx"), {alpha});
}

TEST(Normalisation, IsOneForGtrAtAnyGamma) {
  for (const double alpha : alphas)
    for (const double gamma : {0.5, 0.9, 1.0, 1.001, 1.5, 2.0, 5.0, 10.0})
      expect_one(find_term("ndf.gtr"), {alpha, gamma});
}

TEST(Normalisation, IsOneForBeckmannAndBlinnPhong) {
  for (const double alpha : alphas) {
    expect_one(find_term("ndf.beckmann"), {alpha});
    expect_one(find_term("ndf.blinn_phong"), {alpha});
  }
}

TEST(Normalisation, IsTheFactorThatAShaderLeavesOut) {
  // GGX without 1/π, as long as 2048 does not cut it off
  const std::size_t ue = find_term("ndf.ggx.ue_mobile");
  for (const double alpha : {0.1, 0.4, 1.0}) {
    const auto n = normalisation(ue, {{alpha}});
    EXPECT_NEAR(n.value, 3.14159265358979, 1e-9) << alpha;
  }
  // NoH dω = π dw of w = sin²θ_h: π ∫ min(α²/(α² + (1 − α²) w)², M) dw
  const double alpha = 0.01, most = 2048, rest = 1 - alpha * alpha;
  const double flat = (alpha / std::sqrt(most) - alpha * alpha) / rest;
  const double tail = alpha * alpha / rest * (std::sqrt(most) / alpha - 1);
  const auto cut = normalisation(ue, {{alpha}}, {1e-9, 1'000'000});
  EXPECT_NEAR(cut.value, 3.14159265358979 * (most * flat + tail), cut.error);
  EXPECT_LE(cut.error, 1e-9);
}

TEST(Normalisation, IsOneForAnisotropicDistributionsToo) {
  for (const char* id : {"ndf.ggx_aniso", "ndf.beckmann_aniso"})
    for (const double x : alphas)
      for (const double y : {1e-4, 0.05, 0.5, 1.0}) {
        const auto n = normalisation(find_term(id), {{x, y}});
        EXPECT_NEAR(n.value, 1, n.error) << id << " " << x << " " << y;
        EXPECT_LE(n.error, 1e-11) << id << " " << x << " " << y;
      }
}

/// Without parentheses the division by NoH² is undone, and what is left falls off too slowly.
TEST(Normalisation, SaysThatItDiverges) {
  for (const double x : {0.1, 0.5, 1.0})
    for (const double y : {0.1, 1.0}) {
      const auto n = normalisation(find_term("ndf.beckmann_aniso.as_written"), {{x, y}});
      EXPECT_EQ(n.value, std::numeric_limits<double>::infinity()) << x << " " << y;
      EXPECT_EQ(n.error, std::numeric_limits<double>::infinity());
      EXPECT_LE(n.evaluations, 1'000'000U);
    }
}

TEST(Normalisation, ItsBoundIsTrueAtCoarseGoalsToo) {
  for (const double alpha : alphas)
    for (const double goal : {1e-2, 1e-4, 1e-6, 1e-8}) {
      const auto n = normalisation(find_term("ndf.ggx"), {{alpha}}, {goal, 1'000'000});
      EXPECT_LE(std::abs(n.value - 1), n.error) << alpha << " " << goal;
      EXPECT_LE(n.error, goal);
    }
}

}  // namespace
}  // namespace gonio
