// Standard errors are those of the sandwich, and what is not known has none.
#include "fitting/judge/uncertainty.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Uncertainty, TellsSingularDirectionsFromKnownParameters) {
  // x0 + x1 known, x2 known with error 0.1, x3 at its bound, x4 without effect
  const ArrowMatrix bread{100, 100, 0,   0, 0, 100, 100, 0, 0,   0,  //
                          0,   0,   100, 0, 0, 0,   0,   0, 100, 0, 0, 0, 0, 0, 0};
  const Sandwich s{bread, bread, {}};
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
  EXPECT_NEAR(student_t_975(1), 12.706, 0.0005);
  EXPECT_NEAR(student_t_975(4), 2.776, 0.0005);
  EXPECT_NEAR(student_t_975(10), 2.228, 0.0005);
  EXPECT_NEAR(student_t_975(30), 2.042, 0.0005);
  EXPECT_NEAR(student_t_975(89), 1.987, 0.0005);
}

/// Two unknowns of which all can be worked out by hand: B = 100 (4 1; 1 3), M = 100 (2 ½; ½ 1), so that
/// B⁻¹ M B⁻¹ = (16 −3.5; −3.5 14)/12100.
struct ByHand {
  Sandwich s{{400, 100, 100, 300}, {200, 50, 50, 100}, {}};
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
  ByHand h;
  h.s.scores = {{10, 5}, {10, 0}, {0, 5}, {0, std::sqrt(50)}};  // their squares add up to that meat
  h.s.meat = ArrowMatrix{0, 0, 0, 0};
  const auto u = uncertainty(h.s, h.x, h.bounds, 102, 5);
  const double spent = 5.0 / 4 * (101.0 / 100);  // g/(g − 1) (N − 1)/(N − p)
  EXPECT_NEAR(u.std_error[0], std::sqrt(spent * 16 / 12100), 1e-12);
  EXPECT_NEAR(u.std_error[1], std::sqrt(spent * 14 / 12100), 1e-12);
  EXPECT_NEAR(u.t, student_t_975(4), 1e-12);
}

TEST(Uncertainty, LosesADirectionWhenItsScaledEigenvalueIsBelowOneInTenToTheEleventh) {
  const auto status = [](double eigenvalue) {  // of (1 ρ; ρ 1): 1 − ρ and 1 + ρ
    const double all = 1e20, rho = 1 - eigenvalue;
    const Sandwich s{{all, all * rho, all * rho, all}, {all, all * rho, all * rho, all}, {}};
    return uncertainty(s, std::vector{0.5, 0.5}, {{0, 0}, {1, 1}}, 1000, 0).status;
  };
  for (const auto i : {0U, 1U}) {
    EXPECT_EQ(status(3e-12)[i], ParameterStatus::not_identifiable);
    EXPECT_EQ(status(3e-11)[i], ParameterStatus::free);
  }
}

/// Matrix of two shared unknowns and channels of two and one, positive definite, with the channels as
/// arms and without.
struct BothForms {
  ArrowMatrix dense, arrow;
};
BothForms both_forms(const std::vector<std::vector<double>>& rows) {
  const auto layout = std::make_shared<const ArrowLayout>(
      std::vector<std::size_t>{4, 0}, std::vector<std::vector<std::size_t>>{{1, 3}, {2}, {5, 6}});
  BothForms m{ArrowMatrix(std::make_shared<const ArrowLayout>(7)), ArrowMatrix(layout)};
  for (const auto& j : rows)
    for (std::size_t i = 0; i < 7; ++i)
      for (std::size_t k = i; k < 7; ++k)
        if (layout->at(i, k) != ArrowLayout::none) {
          m.dense.add(i, k, j[i] * j[k]);
          m.arrow.add(i, k, j[i] * j[k]);
        }
  return m;
}
/// Rows of J: of the head and of one arm each.
std::vector<std::vector<double>> arrow_rows(double size) {
  std::vector<std::vector<double>> rows;
  const std::vector<std::vector<std::size_t>> arms{{1, 3}, {2}, {5, 6}};
  for (std::size_t r = 0; r < 15; ++r) {
    std::vector<double> row(7);
    const auto at = [&](std::size_t i) {
      row[i] = size * std::sin(0.37 * static_cast<double>((r + 2) * (r + 2 * i + 3) * (i + 1)));
    };
    at(0);
    at(4);
    for (const std::size_t i : arms[r % 3]) at(i);
    rows.push_back(std::move(row));
  }
  return rows;
}

TEST(Uncertainty, IsTheSameWithChannelsAsArms) {
  auto twin = arrow_rows(30);  // two unknowns of a channel that cannot be told apart
  for (auto& row : twin) row[6] = row[5];
  for (const auto& rows : {arrow_rows(30), twin})
    for (const std::size_t clusters : {0U, 12U}) {
      const auto bread = both_forms(rows);
      auto meat = both_forms(arrow_rows(50));
      std::vector<std::vector<double>> scores;
      if (clusters) {
        meat = both_forms({});
        for (std::size_t g = 0; g < clusters; ++g) {
          auto& s = scores.emplace_back();
          for (std::size_t i = 0; i < 7; ++i)
            s.push_back(30 * std::cos(static_cast<double>(3 * g + i * i)));
        }
      }
      const std::vector<double> x(7, 0.5);
      const Bounds bounds{std::vector<double>(7, -10), std::vector<double>(7, 10)};
      const auto a = uncertainty({bread.dense, meat.dense, scores}, x, bounds, 100, clusters);
      const auto b = uncertainty({bread.arrow, meat.arrow, scores}, x, bounds, 100, clusters);
      EXPECT_EQ(a.status, b.status);
      EXPECT_EQ(a.status[5],
                rows == twin ? ParameterStatus::not_identifiable : ParameterStatus::free);
      if (rows != twin) {
        EXPECT_NEAR(b.condition / a.condition, 1, 1e-9);
      }
      for (std::size_t i = 0; i < 7; ++i) {
        if (a.status[i] != ParameterStatus::free) continue;
        EXPECT_NEAR(b.std_error[i] / a.std_error[i], 1, 1e-10);
        for (std::size_t k = 0; k < 7; ++k) {
          if (a.status[k] != ParameterStatus::free) continue;
          EXPECT_NEAR(b.correlations[i][k], a.correlations[i][k], 1e-10);
        }
      }
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
