#include "integrate/scattering/azimuth_integral.h"

#include <cmath>

#include "brdf/catalogue/registry.h"
#include "constants.h"

namespace gonio {
namespace {

using test::pi;

Zenith zenith(double cosine) {
  return {cosine, std::sqrt((1 - cosine) * (1 + cosine))};
}

/// Pairs of which light goes down and up again, up more steeply, or nearly on as it was.
constexpr double pairs[][2] = {{1, 1},         {0.3, 0.3},      {0.3, 0.31},   {0.9, 0.02},
                               {0.001, 0.002}, {-0.3, 0.31},    {-0.001, 0.2}, {-0.2, 1},
                               {-0.6, 0.6001}, {-0.001, 0.0011}};

double integral(const Facets& facets, int nodes, double c1, double c2) {
  const Zenith one = zenith(c1);
  std::vector<std::vector<double>> k;
  AzimuthIntegral(facets, nodes)({&one, 1}, zenith(c2), k);
  return k[0][0];
}

/// With |ω₁ + ω₂|² = A − B cos φ and q = (1 − α²)(c₁ + c₂)²
///
///   K = α²/2 (1 + 2q/√Δ + q² (A − q)/√Δ³),   Δ = (A − q − B)(A − q + B)
double white_ggx(double alpha, double c1, double c2) {
  const auto one = zenith(c1), two = zenith(c2);
  const double c = c1 + c2, apart = one.sine - two.sine, b = 2 * one.sine * two.sine;
  const double q = (1 - alpha) * (1 + alpha) * c * c;
  const double low = apart * apart + alpha * alpha * c * c, delta = low * (low + 2 * b);
  return alpha * alpha / 2 *
         (1 + 2 * q / std::sqrt(delta) + q * q * (low + b) / (delta * std::sqrt(delta)));
}

TEST(AzimuthIntegral, OfWhiteGgxIsTheClosedForm) {
  const std::size_t schlick = find_term("fresnel.schlick");
  for (const double alpha : {1e-4, 0.01, 0.1, 0.5, 1.0}) {
    const Facets facets{Microsurface::Slopes::ggx,
                        alpha,
                        schlick,
                        {std::vector<double>(catalogue()[schlick].parameters.size(), 1.0)}};
    for (const auto& [c1, c2] : pairs) {
      const double k = white_ggx(alpha, c1, c2);
      EXPECT_NEAR(integral(facets, 16, c1, c2), k, 1e-3 * k) << alpha << " " << c1 << " " << c2;
      EXPECT_NEAR(integral(facets, 32, c1, c2), k, 1e-7 * k) << alpha << " " << c1 << " " << c2;
    }
  }
}

TEST(AzimuthIntegral, IsTheSameWithMoreNodes) {
  const std::size_t conductor = find_term("fresnel.conductor");
  for (const auto slopes : {Microsurface::Slopes::ggx, Microsurface::Slopes::beckmann})
    for (const double alpha : {1e-4, 0.01, 0.1, 0.5, 1.0}) {
      const Facets facets{slopes, alpha, conductor, {{0.2, 3}, {1.5, 0}}};
      for (const auto& [c1, c2] : pairs) {
        const double k = integral(facets, 200, c1, c2);
        EXPECT_NEAR(integral(facets, 16, c1, c2), k, 1e-3 * k) << alpha << " " << c1 << " " << c2;
        EXPECT_NEAR(integral(facets, 32, c1, c2), k, 1e-6 * k) << alpha << " " << c1 << " " << c2;
      }
    }
}

/// Even steps in azimuth, as many as it takes.
TEST(AzimuthIntegral, OfBeckmannIsTheSumOverEvenAzimuths) {
  const std::size_t schlick = find_term("fresnel.schlick");
  constexpr int steps = 4000;
  for (const double alpha : {0.1, 0.5, 1.0}) {
    const Facets facets{Microsurface::Slopes::beckmann,
                        alpha,
                        schlick,
                        {std::vector<double>(catalogue()[schlick].parameters.size(), 1.0)}};
    for (const auto& [c1, c2] : {std::pair{1.0, 0.5}, {0.3, 0.35}, {-0.3, 0.7}, {-0.1, 0.4}}) {
      const auto one = zenith(c1), two = zenith(c2);
      double sum = 0;
      for (int i = 0; i < steps; ++i) {
        const double dot = c1 * c2 + one.sine * two.sine * std::cos(2 * pi * i / steps);
        const double cos2 = (c1 + c2) * (c1 + c2) / (2 + 2 * dot);
        sum += std::exp((1 - 1 / cos2) / (alpha * alpha)) / (pi * alpha * alpha * cos2 * cos2);
      }
      const double k = sum / 4 * 2 * pi / steps;
      EXPECT_NEAR(integral(facets, 32, c1, c2), k, 1e-7 * k) << alpha << " " << c1 << " " << c2;
    }
  }
}

}  // namespace
}  // namespace gonio
