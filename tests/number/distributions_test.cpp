#include "number/distributions.h"

#include <cmath>
#include <numbers>

#include "gtest/gtest.h"

namespace gonio {
namespace {

TEST(Distributions, AreThoseOfTheirClosedForms) {
  // t of one degree is Cauchy's distribution, of two x/√(2 + x²)/2 + 1/2
  EXPECT_NEAR(students_t_quantile(0.975, 1), std::tan(0.475 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(students_t_quantile(0.95, 2), 0.9 * std::sqrt(2 / (1 - 0.81)), 1e-12);
  // F of two and n degrees: (1 + 2 f/n)^(−n/2)
  EXPECT_NEAR(fisher_f_tail(3, 2, 10), std::pow(1.6, -5), 1e-14);
  // (1 − p)³ + 3 p (1 − p)² and its inverse in p, I_p(2, 2) = 3 p² − 2 p³ = 1 − that
  EXPECT_NEAR(binomial_at_most(1, 3, 0.2), 0.512 + 3 * 0.2 * 0.64, 1e-15);
  EXPECT_NEAR(beta_quantile(3 * 0.04 - 2 * 0.008, 2, 2), 0.2, 1e-14);
}

}  // namespace
}  // namespace gonio
