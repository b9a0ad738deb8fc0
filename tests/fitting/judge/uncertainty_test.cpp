// Standard errors are those of the sandwich, and what is not known has none.
#include "fitting/judge/uncertainty.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Uncertainty, TellsSingularDirectionsFromKnownParameters) {
  // x0 + x1 known, x2 known with error 0.1, x3 at its bound, x4 without effect
  Sandwich s;
  s.bread.assign(25, 0);
  s.bread[0] = s.bread[1] = s.bread[5] = s.bread[6] = 100;
  s.bread[12] = 100;
  s.bread[18] = 100;
  s.meat = s.bread;
  const std::vector<double> x{0.3, 0.3, 0.5, 1, 0.5};
  const auto u =
      uncertainty(s, x, {std::vector<double>(5, 0), std::vector<double>(5, 1)}, 1'000'000, 0);
  EXPECT_EQ(u.status[0], ParameterStatus::not_identifiable);
  EXPECT_EQ(u.status[1], ParameterStatus::not_identifiable);
  EXPECT_EQ(u.status[2], ParameterStatus::free);
  EXPECT_NEAR(u.std_error[2], 0.1, 1e-6);
  EXPECT_EQ(u.status[3], ParameterStatus::at_bound);
  EXPECT_EQ(u.status[4], ParameterStatus::not_identifiable);
  EXPECT_TRUE(std::isnan(u.std_error[3]));
}

TEST(Uncertainty, TakesStudentsQuantileFromTheTables) {
  // NIST/SEMATECH e-Handbook, table 1.3.6.7.2
  EXPECT_NEAR(student_t_975(4), 2.776, 0.014);
  EXPECT_NEAR(student_t_975(10), 2.228, 0.001);
  EXPECT_NEAR(student_t_975(30), 2.042, 0.0005);
  EXPECT_NEAR(student_t_975(89), 1.987, 0.0005);
}

/// Two unknowns of which all can be worked out by hand: B = 100 (4 1; 1 3), M = 100 (2 ½; ½ 1), so that
/// B⁻¹ M B⁻¹ = (16 −3.5; −3.5 14)/12100.
struct ByHand {
  Sandwich s{{400, 100, 100, 300}, {200, 50, 50, 100}};
  std::vector<double> x{0, 0};
  Bounds bounds{{-10, -10}, {10, 10}};
};

TEST(Uncertainty, OfIndependentValuesIsTheSandwichOverTheDegreesOfFreedomLeft) {
  const ByHand h;
  const auto u = uncertainty(h.s, h.x, h.bounds, 102, 0);
  const double spent = 102.0 / 100;
  EXPECT_NEAR(u.std_error[0], std::sqrt(spent * 16 / 12100), 1e-12);
  EXPECT_NEAR(u.std_error[1], std::sqrt(spent * 14 / 12100), 1e-12);
  EXPECT_NEAR(u.correlations[0][1], -3.5 / std::sqrt(16 * 14.0), 1e-12);
  EXPECT_NEAR(u.correlations[1][1], 1, 1e-12);
  // Scaled to a unit diagonal the bread has 1/√12 beside it.
  EXPECT_NEAR(u.condition, (1 + 1 / std::sqrt(12)) / (1 - 1 / std::sqrt(12)), 1e-9);
}

TEST(Uncertainty, OfClustersCountsTheClustersAndNotTheValues) {
  const ByHand h;
  const auto u = uncertainty(h.s, h.x, h.bounds, 102, 5);
  const double spent = 5.0 / 4 * (101.0 / 100);  // g/(g − 1) (N − 1)/(N − p)
  EXPECT_NEAR(u.std_error[0], std::sqrt(spent * 16 / 12100), 1e-12);
  EXPECT_NEAR(u.std_error[1], std::sqrt(spent * 14 / 12100), 1e-12);
  EXPECT_NEAR(u.t, student_t_975(4), 1e-12);
}

TEST(Uncertainty, LosesADirectionWhenItsScaledEigenvalueIsBelowOneInTenToTheEleventh) {
  const auto status = [](double eigenvalue) {  // of (1 ρ; ρ 1): 1 − ρ and 1 + ρ
    const double all = 1e20, rho = 1 - eigenvalue;
    const Sandwich s{{all, all * rho, all * rho, all}, {all, all * rho, all * rho, all}};
    return uncertainty(s, std::vector{0.5, 0.5}, {{0, 0}, {1, 1}}, 1000, 0).status;
  };
  for (const auto i : {0U, 1U}) {
    EXPECT_EQ(status(3e-12)[i], ParameterStatus::not_identifiable);
    EXPECT_EQ(status(3e-11)[i], ParameterStatus::free);
  }
}

TEST(Uncertainty, KnowsNothingWithoutADegreeOfFreedom) {
  const ByHand h;
  EXPECT_TRUE(std::isnan(uncertainty(h.s, h.x, h.bounds, 2, 0).std_error[0]));
  EXPECT_FALSE(std::isnan(uncertainty(h.s, h.x, h.bounds, 3, 0).std_error[0]));
  EXPECT_TRUE(std::isnan(uncertainty(h.s, h.x, h.bounds, 100, 1).std_error[0]));
}

}  // namespace
}  // namespace gonio
