#include "brdf/formula/scattering.h"

#include <array>
#include <numbers>

#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

double kulla_conty(double single, double e, double average, double f) {
  return KullaConty<double>::apply(std::array{single, e, average, f})[0];
}

TEST(KullaConty, GivesBackAllAtFOneAndNothingAtFZero) {
  EXPECT_DOUBLE_EQ(kulla_conty(0.6, 0.6, 0.7, 1), 1);
  EXPECT_DOUBLE_EQ(kulla_conty(0.6, 0.6, 0.7, 0), 0.6);
}

TEST(KullaConty, IsTheSumOfItsBouncesFromTheSecondOn) {
  const double f = 0.8, average = 0.55;
  double sum = 0, bounce = f * f * average;
  for (int n = 0; n < 200; ++n, bounce *= f * (1 - average)) sum += bounce;
  EXPECT_NEAR(kulla_conty(0.3, 0.4, average, f), 0.3 + 0.6 * sum, 1e-14);
}

TEST(KullaContyLinear, IsBrighterByOneBounceOfColour) {
  const std::array p{0.3, 0.4, 0.55, 0.2};
  const double square = KullaConty<double>::apply(p)[0] - 0.3;
  EXPECT_NEAR(KullaContyLinear<double>::apply(p)[0] - 0.3, square / 0.2, 1e-15);
}

/// With E(μ) = μ, whose average is 2/3: the lobe's albedo is F_ms (1 − E(μ)).
TEST(KullaContyLobe, HasTheAlbedoThatItAdds) {
  const double view = 0.3, average = 2 / 3.0, f = 0.7;
  double albedo = 0;
  for (const auto& node : gauss_legendre(8))
    albedo += node.weight * 2 * std::numbers::pi * node.x *
              KullaContyLobe<double>::apply(std::array{node.x, view, average, f})[0];
  EXPECT_NEAR(albedo, kulla_conty(0, view, average, f), 1e-14);
}

TEST(KullaContyLobe, IsNothingWhereNothingIsLost) {
  EXPECT_EQ(KullaContyLobe<double>::apply(std::array{1.0, 1.0, 1.0, 1.0})[0], 0);
}

TEST(Turquin, GivesBackAllAtFOneAndScalesTheLobe) {
  EXPECT_DOUBLE_EQ(Turquin<double>::apply(std::array{0.6, 0.6, 1.0})[0], 1);
  EXPECT_DOUBLE_EQ(Turquin<double>::apply(std::array{0.02, 0.5, 0.04})[0], 0.02 * 1.04);
}

TEST(TurquinAverage, GivesBackMoreThanTurquinButAtFOne) {
  const auto average = [](double single, double e, double f0, double f90) {
    return TurquinAverage<double>::apply(std::array{single, e, f0, f90})[0];
  };
  EXPECT_DOUBLE_EQ(average(0.6, 0.6, 1, 1), 1);
  EXPECT_DOUBLE_EQ(average(0.02, 0.5, 0.04, 1), 0.02 * (1.04 + 0.96 / 21));
  EXPECT_DOUBLE_EQ(average(0.02, 0.5, 0.04, 0.04),
                   Turquin<double>::apply(std::array{0.02, 0.5, 0.04})[0]);
}

/// What MaterialX does, all of it: the fit's E is above 1 where smooth and grazing, and the map takes it.
TEST(Turquin, TakesWhateverMaterialxsFitGives) {
  double most = 0;
  for (int r = 0; r <= 100; ++r)
    for (int c = 0; c <= 100; ++c) {
      const double alpha = std::max(1e-4, r * r / 1e4);
      const double e = AlbedoFitMaterialx<double>::apply(std::array{alpha, c / 100.0})[0];
      most = std::max(most, e);
      EXPECT_TRUE(Turquin<double>::parameters[1].legal.holds(e));
      EXPECT_TRUE(TurquinAverage<double>::parameters[0].legal.holds(e));
    }
  EXPECT_NEAR(most, 1.0348, 1e-3);
  EXPECT_DOUBLE_EQ(Turquin<double>::apply(std::array{1.03, 1.03, 1.0})[0], 1);
}

/// As published: FssEss + FmsEms.
TEST(FdezAguera, IsTheSumOfBothLobes) {
  const double a = 0.5, b = 0.1, f0 = 0.3;
  const double single = f0 * a + b, lost = 1 - (a + b), f = f0 + (1 - f0) / 21;
  EXPECT_NEAR(FdezAguera<double>::apply(std::array{a, b, f0})[0],
              single + lost * single * f / (1 - f * lost), 1e-15);
  EXPECT_DOUBLE_EQ(FdezAguera<double>::apply(std::array{a, b, 1.0})[0], 1);
}

TEST(SchlickAverage, IsTheIntegral) {
  double sum = 0;
  for (const auto& node : gauss_legendre(8)) {
    const Schlick<double> f(std::array{0.3});
    sum += node.weight * 2 * node.x * f({1, 1, 1, node.x, 0});
  }
  EXPECT_NEAR(schlick_average(0.3), sum, 1e-14);
}

}  // namespace
}  // namespace gonio
