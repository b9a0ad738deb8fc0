// Minima of costs of which only the normal equations are known.
#include "fitting/solve/solve.h"

#include <cmath>

#include <glog/logging.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Solve, FindsTheMinimumOfAQuadraticAndKeepsInsideItsBounds) {
  // ½ (x − (1, 2))ᵀ H (x − (1, 2)) + 3
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = x[0] - 1, b = x[1] - 2;
    NormalEquations e;
    e.h = {2, 1, 1, 3};
    e.g = {2 * a + b, a + 3 * b};
    e.cost = (a * e.g[0] + b * e.g[1]) / 2 + 3;
    return e;
  };
  std::vector<double> x{10, -10};
  const auto s = solve(evaluate, x, {{-100, -100}, {100, 100}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(x[0], 1, 1e-6);
  EXPECT_NEAR(x[1], 2, 1e-6);
  EXPECT_NEAR(s.at.cost, 3, 1e-12);
  x = {10, -10};
  solve(evaluate, x, {{-100, -100}, {100, 1}});
  EXPECT_EQ(x[1], 1);
  EXPECT_NEAR(x[0], 1.5, 1e-4);  // 2 (x − 1) + (1 − 2) = 0
}

// The cost is rounded to more than the last steps lower it by; only the gradient can lead on.
TEST(Solve, IsNotHeldUpByTheRoundingOfTheCost) {
  const std::vector<double> optimum{0.3, 0.7};
  int passes = 0;
  const auto evaluate = [&](const std::vector<double>& x) {
    ++passes;
    const double a = x[0] - optimum[0], b = x[1] - optimum[1];
    NormalEquations e;  // JᵀJ is a little less than the curvature: the steps are a little too long
    e.h = {1.8, 0.9, 0.9, 2.7};
    e.g = {2 * a + b, a + 3 * b};
    const double exact = 1e4 + (a * e.g[0] + b * e.g[1]) / 2;
    e.cost = 0.01 * std::round(exact / 0.01);
    return e;
  };
  std::vector<double> x{0.35, 0.68};
  const auto s = solve(evaluate, x, {{0, 0}, {1, 1}}, {.rounding = 1e-9});
  EXPECT_TRUE(s.converged);
  EXPECT_LT(passes, 6);
  // 1e-8 of the cost: half a step of 0.01 along the flattest direction
  EXPECT_NEAR(x[0], optimum[0], 0.012);
  EXPECT_NEAR(x[1], optimum[1], 0.012);
  EXPECT_EQ(s.cost_per_iteration.size(), static_cast<std::size_t>(s.iterations) + 1);
}

TEST(Solve, SurvivesADirectionInWhichNothingChanges) {
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = x[0] + x[1] - 1;
    return NormalEquations{{1, 1, 0, 1, 1, 0, 0, 0, 0}, {a, a, 0}, a * a / 2 + 1};
  };
  std::vector<double> x{0, 0, 5};
  const auto s = solve(evaluate, x, {{-9, -9, -9}, {9, 9, 9}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(x[0] + x[1], 1, 1e-6);
  EXPECT_EQ(x[2], 5);
}

TEST(Solve, OfALinearProblemTakesOneGaussNewtonStepAndOneToSeeIt) {
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = x[0] - 0.2, b = x[1] - 0.9;  // residuals a + b, 2 b
    NormalEquations e;
    e.h = {1, 1, 1, 5};
    e.g = {a + b, a + 5 * b};
    e.cost = ((a + b) * (a + b) + 4 * b * b) / 2;
    return e;
  };
  std::vector<double> x{0.5, 0.5};
  const auto s = solve(evaluate, x, {{-10, -10}, {10, 10}});
  EXPECT_TRUE(s.converged);
  EXPECT_LE(s.iterations, 2);
  EXPECT_NEAR(x[0], 0.2, 1e-6);
  EXPECT_NEAR(x[1], 0.9, 1e-6);
}

TEST(Solve, HoldsAllWhereAllAreAtTheirBounds) {
  const auto evaluate = [](const std::vector<double>& x) {
    return NormalEquations{{1}, {x[0] - 5}, (x[0] - 5) * (x[0] - 5) / 2};
  };
  std::vector<double> x{1};
  const auto s = solve(evaluate, x, {{0}, {1}});
  EXPECT_TRUE(s.converged);
  EXPECT_EQ(x[0], 1);
  EXPECT_EQ(s.at.cost, 8);
}

// Relative errors of data that reach over a hundred decades weigh one unknown so.
TEST(Solve, MovesAnUnknownThatHasANonillionthOfAnothersEffect) {
  constexpr double steep = 1e60;
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = steep * x[0] + x[1] - 0.5, b = x[1] - 0.3;  // residuals a, b
    NormalEquations e;
    e.h = {steep * steep, steep, steep, 2};
    e.g = {steep * a, a + b};
    e.cost = (a * a + b * b) / 2 + 1;
    return e;
  };
  std::vector<double> x{1e-61, 0.9};
  const auto s = solve(evaluate, x, {{0, 0}, {1, 1}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(x[1], 0.3, 1e-6);
  EXPECT_NEAR(x[0] * steep, 0.2, 1e-6);
}

TEST(Solve, LeavesNoLineOfItsLibraryOnStderr) {
  testing::internal::CaptureStderr();
  LOG(WARNING) << "as the library does of a step that it cannot take";
  LOG(ERROR) << "and of one that is not finite";
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Rosenbrock's valley for each of 20 channels, which share a third unknown: J has the form of an arrow.
TEST(Solve, TakesTheSamePathWithChannelsAsArms) {
  constexpr std::size_t channels = 20, n = 1 + 2 * channels;
  std::vector<std::vector<std::size_t>> arms;
  for (std::size_t c = 0; c < channels; ++c) arms.push_back({1 + 2 * c, 2 + 2 * c});
  const auto arrow = std::make_shared<const ArrowLayout>(std::vector<std::size_t>{0}, arms),
             dense = std::make_shared<const ArrowLayout>(n);
  const auto solved = [&](const std::shared_ptr<const ArrowLayout>& layout, double high) {
    const auto evaluate = [&](const std::vector<double>& x) {
      NormalEquations e{ArrowMatrix(layout), std::vector<double>(n), 0};
      for (std::size_t c = 0; c < channels; ++c) {
        const std::size_t a = 1 + 2 * c, b = 2 + 2 * c;
        const double target = 0.5 + 0.02 * static_cast<double>(c);
        const auto add = [&](double r, double by_shared, double by_a, double by_b) {
          const std::size_t at[]{0, a, b};
          const double j[]{by_shared, by_a, by_b};
          for (std::size_t i = 0; i < 3; ++i) {
            e.g[at[i]] += r * j[i];
            for (std::size_t k = i; k < 3; ++k) e.h.add(at[i], at[k], j[i] * j[k]);
          }
          e.cost += r * r / 2;
        };
        add(3 * (x[b] - x[a] * x[a]), 0, -6 * x[a], 3);
        add(target - x[a], 0, -1, 0);
        add(x[0] * x[b] - 2 * target * target, x[b], 0, x[0]);
      }
      return e;
    };
    std::vector<double> x(n, 0.3);
    const Bounds bounds{std::vector<double>(n, 0), std::vector<double>(n, high)};
    const auto s = solve(evaluate, x, bounds);
    EXPECT_TRUE(s.converged) << s.message;
    return std::pair{x, s};
  };
  for (const double high : {9.0, 0.8}) {  // all inside; some at their bounds
    const auto [x, s] = solved(dense, high);
    const auto [y, t] = solved(arrow, high);
    EXPECT_EQ(s.iterations, t.iterations);
    EXPECT_NEAR(s.at.cost, t.at.cost, 1e-12 + 1e-9 * s.at.cost);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], y[i], 1e-7) << i;
    if (high > 1) {
      EXPECT_NEAR(x[0], 2, 1e-5);
    }
  }
}

}  // namespace
}  // namespace gonio
