#include "integrate/rule/cubature.h"

#include <cmath>
#include <limits>

#include "constants.h"

namespace gonio {
namespace {

using test::pi;
constexpr Rectangle unit_line{{0, 0}, {1, 0}}, unit_square{{0, 0}, {1, 1}};

/// f(x, y) as an integrand.
template <class F>
Integrand each(F f) {
  return [f](std::span<const double> x, std::span<const double> y, std::span<double* const> out) {
    for (std::size_t i = 0; i < x.size(); ++i) out[0][i] = f(x[i], y[i / line_nodes]);
  };
}
template <class F>
Integral of(F f, std::vector<Rectangle> where, const Goal& goal = {1e-10, 1'000'000}) {
  return integrate(each(f), 1, std::move(where), goal);
}
constexpr Goal once{1e300, 1};

TEST(Cubature, IsExactToDegree22AndItsBoundIsNothingToDegree7) {
  for (int degree = 0; degree <= 22; ++degree) {
    const auto power = [&](double t) { return std::pow(t, degree); };
    const double exact = 1.0 / (degree + 1);
    for (const auto& i : {of([&](double x, double) { return power(x); }, {unit_line}, once),
                          of([&](double x, double) { return power(x); }, {unit_square}, once),
                          of([&](double, double y) { return power(y); }, {unit_square}, once)}) {
      EXPECT_NEAR(i.value[0], exact, 1e-15) << degree;
      if (degree <= 7)
        EXPECT_LT(i.error, 3e-14) << degree;
      else
        EXPECT_GT(i.error, 1e-13) << degree;
    }
  }
}

TEST(Cubature, TakesAreasAndSeveralRectanglesIntoAccount) {
  const auto f = [](double x, double y) { return std::exp(x) * std::cos(y); };
  const Rectangle left{{-1, 0.5}, {0.5, 2}}, right{{0.5, 0.5}, {3, 2}};
  const double exact = (std::exp(3) - std::exp(-1)) * (std::sin(2) - std::sin(0.5));
  const auto i = of(f, {left, right});
  EXPECT_NEAR(i.value[0], exact, i.error);
  EXPECT_LE(i.error, 1e-10);
}

TEST(Cubature, FindsANarrowPeakThatItsFirstNodesFeel) {
  for (const double width : {1e-2, 1e-4, 1e-6}) {
    const auto peak = [&](double x) { return width / pi / (x * x + width * width); };
    const double exact = std::atan(0.3 / width) / pi + std::atan(0.7 / width) / pi;
    const auto line = of([&](double x, double) { return peak(x - 0.3); }, {unit_line});
    EXPECT_NEAR(line.value[0], exact, line.error) << width;
    EXPECT_LE(line.error, 1e-10);
    const auto square =
        of([&](double x, double y) { return peak(x - 0.3) * peak(y - 0.7); }, {unit_square});
    EXPECT_NEAR(square.value[0], exact * exact, square.error) << width;
    EXPECT_LE(square.error, 1e-10);
  }
}

TEST(Cubature, BoundsItsErrorAlsoWhereItMayNotFinish) {
  // A quarter of a disk: a jump along a curve is the hardest that can be.
  const auto disk = [](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; };
  double before = 1;
  for (const std::size_t most : {2000U, 20000U, 200000U}) {
    const auto i = of(disk, {unit_square}, {1e-12, most});
    EXPECT_LE(i.evaluations, most);
    EXPECT_NEAR(i.value[0], pi / 4, i.error);
    EXPECT_GT(i.error, 1e-12);
    EXPECT_LT(i.error, before);
    before = i.error;
  }
  const auto kink =
      of([](double x, double y) { return std::abs(x - y / 3); }, {unit_square}, {1e-9, 4'000'000});
  // ∫∫ |x − y/3| = ∫ (y/3)² − y/3 + 1/2 dy
  EXPECT_NEAR(kink.value[0], 1 / 27.0 - 1 / 6.0 + 0.5, kink.error);
  EXPECT_LE(kink.error, 1e-9);
}

TEST(Cubature, IntegratesThroughSingularitiesThatHaveAnIntegral) {
  const auto root = of([](double x, double) { return 1 / std::sqrt(x); }, {unit_line});
  EXPECT_NEAR(root.value[0], 2, root.error);
  EXPECT_LT(root.error, 1e-6);
  const auto log = of([](double x, double) { return -std::log(x); }, {unit_line});
  EXPECT_NEAR(log.value[0], 1, log.error);
  EXPECT_LE(log.error, 1e-10);
}

TEST(Cubature, SaysInfiniteWhereTheIntegralDiverges) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double power : {1.0, 1.5, 2.0, 3.0}) {
    for (const auto& where : {unit_line, unit_square}) {
      const auto up = of([&](double x, double) { return std::pow(x, -power); }, {where});
      EXPECT_EQ(up.value[0], infinity) << power;
      EXPECT_EQ(up.error, infinity);
    }
    const auto down = of([&](double x, double) { return -std::pow(x, -power); }, {unit_line});
    EXPECT_EQ(down.value[0], -infinity) << power;
  }
}

TEST(Cubature, OfWhatIsNoNumberIsNoNumber) {
  const auto i = of([](double x, double) { return std::sqrt(x - 0.4); }, {unit_line});
  EXPECT_TRUE(std::isnan(i.value[0]));
  EXPECT_EQ(i.error, std::numeric_limits<double>::infinity());
}

TEST(Cubature, IntegratesFunctionsTogetherToTheBoundOfTheWorst) {
  const auto both = [](std::span<const double> x, std::span<const double>,
                       std::span<double* const> out) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      out[0][i] = x[i];
      out[1][i] = 1 / (1e-4 + x[i]);
    }
  };
  const auto i = integrate(both, 2, {unit_line}, {1e-9, 1'000'000});
  EXPECT_NEAR(i.value[0], 0.5, 1e-14);
  EXPECT_NEAR(i.value[1], std::log(1.0001 / 1e-4), i.error);
  EXPECT_LE(i.error, 1e-9);
}

}  // namespace
}  // namespace gonio
