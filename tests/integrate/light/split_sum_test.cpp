#include "integrate/light/split_sum.h"

#include <cmath>

#include "base/error.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

constexpr double split_cosines[] = {0.05, 0.3, 0.8, 1};

TEST(SplitSum, IsLinearInF0AsTheAlbedoIs) {
  for (const double roughness : {0.05, 0.4, 1.0}) {
    const auto sums = split_sum("smith_ggx.correlated", roughness, split_cosines);
    for (const double f0 : {0.04, 0.6, 1.0}) {
      const auto model = bind_model("ggx/smith_ggx.correlated/schlick",
                                    {{"roughness", {roughness}}, {"f0", {f0}}}, 1);
      const auto albedo = directional_albedo(model, split_cosines);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        EXPECT_NEAR(f0 * sums[i].a + sums[i].b, albedo[i].value[0],
                    2 * sums[i].error + albedo[i].error);
        EXPECT_LE(sums[i].error, 1e-7);
      }
    }
  }
}

TEST(SplitSum, AtRoughnessOneAddsUpToTheClosedForms) {
  const auto correlated = split_sum("masking.smith_ggx.correlated", 1, split_cosines);
  const auto separable = split_sum("smith_ggx.separable", 1, split_cosines);
  for (std::size_t i = 0; i < std::size(split_cosines); ++i) {
    const double mu = split_cosines[i];
    EXPECT_NEAR(correlated[i].a + correlated[i].b, 1 - mu * std::log(1 + 1 / mu), 2e-8);
    EXPECT_NEAR(separable[i].a + separable[i].b, 2 * (1 - std::log(2.0)) / (1 + mu), 2e-8);
  }
}

TEST(SplitSum, BySamplesComesNearerTheMoreThereAre) {
  for (const char* masking : {"smith_ggx.correlated", "smith_ggx.separable"})
    for (const double roughness : {0.1, 0.5, 1.0}) {
      const auto truth = split_sum(masking, roughness, split_cosines);
      double before = 1;
      for (const std::size_t n : {64U, 4096U, 262144U}) {
        const auto sampled = sampled_split_sum(masking, roughness, split_cosines, n);
        double worst = 0;
        for (std::size_t i = 0; i < truth.size(); ++i)
          worst = std::max(
              {worst, std::abs(sampled[i].a - truth[i].a), std::abs(sampled[i].b - truth[i].b)});
        EXPECT_LT(worst, before / 4) << masking << " " << roughness << " " << n;
        before = worst;
      }
      EXPECT_LT(before, 1e-4);
    }
}

TEST(SplitSum, DiffuseBySamplesComesNearerTheMoreThereAre) {
  const auto truth = split_sum_diffuse(split_cosines);
  double before = 1;
  for (const std::size_t n : {16U, 256U, 4096U, 65536U}) {
    const auto sampled = sampled_split_sum_diffuse(split_cosines, n);
    double worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      worst = std::max(worst, std::abs(sampled[i] - truth[i].value[0]));
    EXPECT_LT(worst, before / 4) << n;
    before = worst;
  }
}

/// At normal incidence VoH = u = cos θ/2: diffuse = 1 − 8 ∫ (1 − u)⁵ (2u² − 1) u du from √½ to 1.
TEST(SplitSum, DiffuseAtNormalIncidenceIsAPolynomialsIntegral) {
  const double low = std::sqrt(0.5);
  double lost = 0;
  for (const auto& node : gauss_legendre(8)) {
    const double u = low + (1 - low) * node.x;
    lost += (1 - low) * node.weight * 8 * std::pow(1 - u, 5) * (2 * u * u - 1) * u;
  }
  EXPECT_NEAR(split_sum_diffuse({{1.0}})[0].value[0], 1 - lost, 1e-10);
}

TEST(SplitSum, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(split_sum("smith_ggx.correlated", 0.5, {{0.0}}), Error);
  EXPECT_THROW(split_sum("smith_ggx.correlated", 1.5, {{0.5}}), Error);
  EXPECT_THROW(split_sum("smith_ggx.corelated", 0.5, {{0.5}}), Error);
  EXPECT_THROW(sampled_split_sum("smith_ggx.correlated", 0.5, {{2.0}}, 16), Error);
  EXPECT_THROW(sampled_split_sum("smith_ggx.correlated", 0.5, {{0.5}}, 0), Error);
  EXPECT_THROW(split_sum_diffuse({{0.0}}), Error);
  EXPECT_THROW(sampled_split_sum_diffuse({{0.5}}, 0), Error);
}

}  // namespace
}  // namespace gonio
