#include "geometry/ggx_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Lights over the sphere by cells even in z and azimuth: below the horizon one
/// cell alone.
struct Cells {
  static constexpr std::size_t heights = 24, turns = 24;
  static std::size_t count() { return heights * turns + 1; }
  static std::size_t cell(const Vector3<double>& l) {
    if (l[2] <= 0) return heights * turns;
    const double turn = std::atan2(l[1], l[0]) / (2 * std::numbers::pi) + 0.5;
    const auto at = [](double x, std::size_t n) {
      return std::min(static_cast<std::size_t>(x * static_cast<double>(n)), n - 1);
    };
    return at(l[2], heights) * turns + at(turn, turns);
  }
  /// Integral of the density over each cell, by the midpoints of fine ones;
  /// below the horizon what is left of 1.
  template <class Sampling>
  static std::vector<double> shares(const Vector3<double>& v, double alpha) {
    constexpr std::size_t fine = 40;
    std::vector<double> out(count());
    double all = 0;
    for (std::size_t i = 0; i < heights * fine; ++i)
      for (std::size_t j = 0; j < turns * fine; ++j) {
        const double z = (static_cast<double>(i) + 0.5) / (heights * fine);
        const double phi =
            2 * std::numbers::pi * ((static_cast<double>(j) + 0.5) / (turns * fine) - 0.5);
        const double sine = std::sqrt(1 - z * z);
        const double p =
            Sampling::density(v, alpha, {sine * std::cos(phi), sine * std::sin(phi), z}) * 2 *
            std::numbers::pi / static_cast<double>(heights * turns * fine * fine);
        out[i / fine * turns + j / fine] += p;
        all += p;
      }
    out.back() = 1 - all;
    return out;
  }
};

/// Probability that χ² of so many degrees of freedom is greater. [Wilson &
/// Hilferty 1931]
double chance_of(double chi2, double degrees) {
  const double part = 2 / (9 * degrees);
  return 0.5 * std::erfc((std::cbrt(chi2 / degrees) - (1 - part)) / std::sqrt(2 * part));
}

/// Chance that draws as unlike the density as these come from it; cells of
/// fewer than 5 expected draws are pooled.
template <class Sampling, class Density = Sampling>
double chance(const Vector3<double>& v, double alpha, std::size_t draws) {
  std::vector<double> found(Cells::count());
  for (std::size_t i = 0; i < draws; ++i) {
    Draws draw(7, i);
    const double u = draw.uniform(), w = draw.uniform();
    ++found[Cells::cell(Sampling::light(v, alpha, u, w))];
  }
  const auto expected = Cells::shares<Density>(v, alpha);
  double chi2 = 0, degrees = -1, few = 0, few_found = 0;
  const auto add = [&](double is, double should) {
    chi2 += (is - should) * (is - should) / should;
    ++degrees;
  };
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double should = expected[k] * static_cast<double>(draws);
    if (should < 5)
      few += should, few_found += found[k];
    else
      add(found[k], should);
  }
  if (few > 5) add(few_found, few);
  return chance_of(chi2, degrees);
}

template <class Sampling>
struct GgxSamplingTest : testing::Test {};
using Samplings =
    testing::Types<GgxNormals<double>, GgxVisible2018<double>, GgxCaps<double>, GgxBounded<double>>;
TYPED_TEST_SUITE(GgxSamplingTest, Samplings);

constexpr double alphas[] = {0.3, 0.6, 1}, cosines[] = {0.1, 0.5, 0.95};

TYPED_TEST(GgxSamplingTest, DrawsFromItsDensity) {
  constexpr std::size_t draws = 200'000, tests = std::size(alphas) * std::size(cosines);
  for (const double alpha : alphas)
    for (const double mu : cosines) {
      const double sine = std::sqrt(1 - mu * mu);
      const Vector3<double> v{0.6 * sine, 0.8 * sine, mu};
      // one in a hundred of all tests together may fail by chance [Šidák 1967]
      EXPECT_GT((chance<TypeParam>(v, alpha, draws)), 1 - std::pow(0.99, 1.0 / tests))
          << "alpha " << alpha << ", mu " << mu;
    }
}

TYPED_TEST(GgxSamplingTest, LightsAreUnitVectors) {
  for (std::size_t i = 0; i < 1000; ++i) {
    Draws draw(3, i);
    const double mu = draw.uniform(), sine = std::sqrt(1 - mu * mu), u = draw.uniform();
    const auto l = TypeParam::light({sine, 0, mu}, 0.01 + 0.99 * draw.uniform(), u, draw.uniform());
    EXPECT_NEAR(sampling::dot<double>(l, l), 1, 1e-9);
  }
}

TEST(GgxSampling, AnotherDensityIsTold) {
  const Vector3<double> v{0.48, 0.64, 0.6};
  EXPECT_LT((chance<GgxCaps<double>, GgxBounded<double>>(v, 0.6, 200'000)), 1e-9);
  EXPECT_LT((chance<GgxNormals<double>, GgxCaps<double>>(v, 0.6, 200'000)), 1e-9);
}

TEST(GgxSampling, BoundedCapsDrawFewerLightsBelowTheHorizon) {
  const auto below = [](auto sampling) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < 20'000; ++i) {
      Draws draw(5, i);
      const double u = draw.uniform();
      n += decltype(sampling)::light({0.866025403784, 0, 0.5}, 1.0, u, draw.uniform())[2] <= 0;
    }
    return n;
  };
  const auto caps = below(GgxCaps<double>());
  EXPECT_LT(below(GgxBounded<double>()), caps * 3 / 4);
  EXPECT_NEAR(static_cast<double>(below(GgxVisible2018<double>())), static_cast<double>(caps),
              0.05 * static_cast<double>(caps));
}

}  // namespace
}  // namespace gonio
