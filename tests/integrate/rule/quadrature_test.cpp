#include "integrate/rule/quadrature.h"

#include <cmath>

#include "constants.h"

namespace gonio {
namespace {

using test::pi;

class GaussLegendre : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders,
                         GaussLegendre,
                         testing::Values(1, 2, 3, 4, 7, 8, 16, 33, 64, 128, 255, 256),
                         testing::PrintToStringParamName());

TEST_P(GaussLegendre, NodesAscendInsideTheIntervalAndMirrorEachOther) {
  const auto nodes = gauss_legendre(GetParam());
  const auto n = nodes.size();
  ASSERT_EQ(n, static_cast<std::size_t>(GetParam()));
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_TRUE(0 < nodes[i].x && nodes[i].x < 1);
    EXPECT_GT(nodes[i].weight, 0);
    if (i > 0) {
      EXPECT_LT(nodes[i - 1].x, nodes[i].x);
    }
    EXPECT_NEAR(nodes[i].x + nodes[n - 1 - i].x, 1, 1e-15);
    EXPECT_NEAR(nodes[i].weight / nodes[n - 1 - i].weight, 1, 1e-13);
  }
}

TEST_P(GaussLegendre, WeightsSumToOne) {
  double sum = 0;
  for (const auto& node : gauss_legendre(GetParam())) sum += node.weight;
  EXPECT_NEAR(sum, 1, 2e-14);
}

TEST_P(GaussLegendre, IsExactToDegreeTwiceItsOrderLessOne) {
  const int n = GetParam();
  const auto nodes = gauss_legendre(n);
  for (int degree = 0; degree <= 2 * n - 1; ++degree) {
    long double sum = 0;
    for (const auto& node : nodes)
      sum += node.weight * std::pow(static_cast<long double>(node.x), degree);
    EXPECT_NEAR(static_cast<double>(sum) * (degree + 1), 1, 2e-13) << "x^" << degree;
  }
}

TEST(GaussLegendreOrder, IsNotExactOneDegreeFurther) {
  for (int n = 1; n <= 8; ++n) {
    long double sum = 0;
    for (const auto& node : gauss_legendre(n))
      sum += node.weight * std::pow(static_cast<long double>(node.x), 2 * n);
    // ∫ x²ⁿ − Σ = n!⁴ / ((2n + 1) (2n)!²)
    const double f = std::tgamma(n + 1.0) * std::tgamma(n + 1.0) / std::tgamma(2 * n + 1.0);
    const auto missing = static_cast<double>(1 / (2 * n + 1.0L) - sum);
    EXPECT_NEAR(missing, f * f / (2 * n + 1), 1e-15) << n;
    EXPECT_GT(missing, 1e-11) << n;
  }
}

TEST(CosineHemisphere, WeightsSumToPi) {
  for (const int n_theta : {1, 2, 16, 64})
    for (const int n_phi : {1, 3, 32}) {
      double sum = 0;
      const auto nodes = cosine_hemisphere(n_theta, n_phi);
      EXPECT_EQ(nodes.size(), static_cast<std::size_t>(n_theta * n_phi));
      for (const auto& node : nodes) {
        sum += node.weight;
        EXPECT_NEAR(dot(node.direction, node.direction), 1, 1e-15);
        EXPECT_GT(node.direction.z, 0);
      }
      EXPECT_NEAR(sum, pi, 1e-13);
    }
}

/// The ruler itself: a white Lambertian surface reflects exactly what it receives.
TEST(CosineHemisphere, GivesAWhiteLambertianTheAlbedoOne) {
  double albedo = 0;
  for (const auto& node : cosine_hemisphere(8, 8)) albedo += node.weight / pi;
  EXPECT_NEAR(albedo, 1, 1e-14);
}

/// Integrals that a quadrature over part of the azimuth, or with a wrong cosine, gets wrong.
TEST(CosineHemisphere, CoversTheWholeAzimuthAndTheWholeHeight) {
  double first = 0, second = 0, x2 = 0, y2 = 0, x2y2 = 0, z = 0, z2 = 0;
  for (const auto& [d, weight] : cosine_hemisphere(32, 16)) {
    first += weight * (d.x + d.y);
    second += weight * d.x * d.y;
    x2 += weight * d.x * d.x;
    y2 += weight * d.y * d.y;
    x2y2 += weight * d.x * d.x * d.y * d.y;
    z += weight * d.z;
    z2 += weight * d.z * d.z;
  }
  EXPECT_NEAR(first, 0, 1e-13);
  EXPECT_NEAR(second, 0, 1e-13);
  EXPECT_NEAR(x2, pi / 4, 1e-13);  // ∫ sin²θ cos²φ cos θ dω
  EXPECT_NEAR(y2, pi / 4, 1e-13);
  EXPECT_NEAR(x2y2, pi / 24, 1e-13);  // π/4 · ∫ (1 − u)² du / 2
  EXPECT_NEAR(z2, pi / 2, 1e-13);     // ∫ cos³θ dω
  EXPECT_NEAR(z, 2 * pi / 3, 1e-5);   // ∫ cos²θ dω: √u is no polynomial
}

}  // namespace
}  // namespace gonio
