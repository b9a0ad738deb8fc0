// Decompositions of arrow matrices against those of the dense ones.
#include "fitting/solve/arrow_root.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace gonio {
namespace {

/// 2 shared unknowns and 30 channels of 2: JᵀJ of rows that each know one channel.
struct Case {
  std::vector<std::vector<std::size_t>> arms;
  std::shared_ptr<const ArrowLayout> layout;
  ArrowMatrix arrow;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(62, 62), scaled;
  std::vector<double> g;
  explicit Case(double twist) {
    for (std::size_t c = 0; c < 30; ++c) arms.push_back({c, 32 + c});
    layout = std::make_shared<const ArrowLayout>(std::vector<std::size_t>{30, 31}, arms);
    arrow = ArrowMatrix(layout);
    for (std::size_t c = 0; c < 30; ++c)
      for (std::size_t row = 0; row < 6; ++row) {
        const std::vector<std::size_t> at{c, 30, 31, 32 + c};
        std::vector<double> j;
        for (std::size_t k = 0; k < 4; ++k)
          j.push_back(
              std::exp(static_cast<double>(c) / 10) *
              std::sin(static_cast<double>((c + row * row + 1) * (k + 2) * (k + row)) + twist));
        for (std::size_t a = 0; a < 4; ++a)
          for (std::size_t b = a; b < 4; ++b) {
            arrow.add(at[a], at[b], j[a] * j[b]);
            const auto i = static_cast<Eigen::Index>(at[a]), k = static_cast<Eigen::Index>(at[b]);
            dense(i, k) += j[a] * j[b];
            if (i != k) dense(k, i) += j[a] * j[b];
          }
      }
    const Eigen::VectorXd s = dense.diagonal().cwiseSqrt().cwiseInverse();
    scaled = s.asDiagonal() * dense * s.asDiagonal();
    for (std::size_t i = 0; i < 62; ++i) g.push_back(std::cos(static_cast<double>(i)));
  }
};

TEST(ArrowRoot, SolvesAsTheDenseMatrixDoes) {
  const Case c(0.2);
  const ArrowRoot root(c.arrow, 0);
  const auto x = root.solution(root.rotated(c.g));
  const Eigen::VectorXd y = c.dense.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(c.g.data(), 62));
  for (Eigen::Index i = 0; i < 62; ++i)
    EXPECT_NEAR(x[static_cast<std::size_t>(i)] / y[i], 1, 1e-9) << i;
}

TEST(ArrowRoot, CountsTheEigenvaluesOfTheScaledMatrix) {
  const Case c(0.7);
  const ArrowRoot root(c.arrow, 0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(c.scaled);
  const auto& all = eigen.eigenvalues();
  for (Eigen::Index i = 0; i < 61; ++i) {
    const double between = (all[i] + all[i + 1]) / 2;
    EXPECT_EQ(root.at_most(between), static_cast<std::size_t>(i) + 1);
  }
  EXPECT_EQ(root.at_most(0), 0U);
  EXPECT_NEAR(root.extremes().least / all[0], 1, 1e-9);
  EXPECT_NEAR(root.extremes().largest / all[61], 1, 1e-12);
}

TEST(ArrowRoot, OfAMatrixThatIsAllHeadIsItsEigensystem) {
  const ArrowMatrix m{4, 2, 2, 4};  // scaled: 1 ± ½
  const ArrowRoot root(m, 0);
  EXPECT_NEAR(root.extremes().least, 0.5, 1e-15);
  EXPECT_NEAR(root.extremes().largest, 1.5, 1e-15);
  EXPECT_EQ(root.at_most(1), 1U);
  const auto x = root.solution(root.rotated(std::vector<double>{4, 2}));
  EXPECT_NEAR(x[0], 1, 1e-15);
  EXPECT_NEAR(x[1], 0, 1e-15);
}

}  // namespace
}  // namespace gonio
