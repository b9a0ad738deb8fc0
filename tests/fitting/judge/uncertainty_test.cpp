// Standard errors are those of the sandwich, and what is not known has none.
#include "fitting/judge/uncertainty.h"

#include <cmath>
#include <memory>

#include "number/distributions.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Uncertainty, TellsSingularDirectionsFromKnownParameters) {
  // x0 + x1 known, x2 known with error 0.1, x3 at its bound, x4 without effect
  const ArrowMatrix bread{100, 100, 0,   0, 0, 100, 100, 0, 0,   0,  //
                          0,   0,   100, 0, 0, 0,   0,   0, 100, 0, 0, 0, 0, 0, 0};
  const Sandwich s{bread, bread, {}, {}, {}, {}};
  const std::vector<double> x{0.3, 0.3, 0.5, 1, 0.5};
  const auto u =
      uncertainty(s, x, {std::vector<double>(5, 0), std::vector<double>(5, 1)}, 1'000'000);
  EXPECT_EQ(u[0].status, ParameterStatus::not_identifiable);
  EXPECT_EQ(u[1].status, ParameterStatus::not_identifiable);
  EXPECT_EQ(u[2].status, ParameterStatus::free);
  EXPECT_NEAR(u[2].std_error, 0.1, 1e-6);
  EXPECT_EQ(u[3].status, ParameterStatus::at_bound);
  EXPECT_EQ(u[4].status, ParameterStatus::not_identifiable);
  EXPECT_TRUE(std::isnan(u[3].std_error));
}

TEST(Uncertainty, TakesStudentsQuantileFromTheTables) {
  // NIST/SEMATECH e-Handbook, table 1.3.6.7.2
  EXPECT_NEAR(students_t_quantile(0.975, 1), 12.706, 0.0005);
  EXPECT_NEAR(students_t_quantile(0.975, 4), 2.776, 0.0005);
  EXPECT_NEAR(students_t_quantile(0.975, 10), 2.228, 0.0005);
  EXPECT_NEAR(students_t_quantile(0.975, 30), 2.042, 0.0005);
  EXPECT_NEAR(students_t_quantile(0.975, 89), 1.987, 0.0005);
}

/// Two unknowns of which all can be worked out by hand: B = 100 (4 1; 1 3), M = 100 (2 ½; ½ 1), so that
/// B⁻¹ M B⁻¹ = (16 −3.5; −3.5 14)/12100.
struct ByHand {
  Sandwich s{{400, 100, 100, 300}, {200, 50, 50, 100}, {}, {}, {}, {}};
  std::vector<double> x{0, 0};
  Bounds bounds{{-10, -10}, {10, 10}};
};

TEST(Uncertainty, OfIndependentValuesIsTheSandwich) {
  const ByHand h;
  const auto u = uncertainty(h.s, h.x, h.bounds, 102);
  EXPECT_NEAR(u[0].std_error, std::sqrt(16.0 / 12100), 1e-12);
  EXPECT_NEAR(u[1].std_error, std::sqrt(14.0 / 12100), 1e-12);
  EXPECT_NEAR(u[0].t, students_t_quantile(0.975, 100), 1e-12);
  EXPECT_NEAR(u.correlations[0][1], -3.5 / std::sqrt(16 * 14.0), 1e-12);
  EXPECT_NEAR(u.correlations[1][1], 1, 1e-12);
  // Scaled to a unit diagonal the bread has 1/√12 beside it.
  EXPECT_NEAR(u.condition, (1 + 1 / std::sqrt(12)) / (1 - 1 / std::sqrt(12)), 1e-9);
}

TEST(Uncertainty, CountsTheValuesThatAParameterRestsOn) {
  ByHand h;
  h.s.fourth = {1.0 / 7, 1e-9};  // seven alike; all
  h.s.alone = h.s.moves = {0, 0};
  auto u = uncertainty(h.s, h.x, h.bounds, 102);
  EXPECT_NEAR(u[0].t, students_t_quantile(0.975, 7), 1e-9);
  EXPECT_NEAR(u[1].t, students_t_quantile(0.975, 100), 1e-9);
  // Four of them make the variance: 3 V²/Σ v², V = (16/12100)/(3/1100) of the first.
  h.s.moves = {std::pow(16.0 / 12100 * 1100 / 3, 2) * 3 / 4.5, 0};
  EXPECT_NEAR(uncertainty(h.s, h.x, h.bounds, 102)[0].t, students_t_quantile(0.975, 4.5), 1e-9);
  h.s.alone = {0.02, 0.001};  // of its variance, from values of leverage 1
  u = uncertainty(h.s, h.x, h.bounds, 102);
  EXPECT_EQ(u[0].status, ParameterStatus::free);
  EXPECT_TRUE(std::isnan(u[0].std_error));
  EXPECT_FALSE(std::isnan(u[1].std_error));
}

/// Least squares of y = J x by the normal equations, the rows of one cluster left out.
struct Line {
  std::vector<std::array<double, 2>> j;
  std::vector<double> y;
  std::vector<std::size_t> cluster;
  std::array<double, 2> solve(std::size_t without) const {
    double a = 0, b = 0, c = 0, p = 0, q = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (cluster[i] == without) continue;
      a += j[i][0] * j[i][0], b += j[i][0] * j[i][1], c += j[i][1] * j[i][1];
      p += j[i][0] * y[i], q += j[i][1] * y[i];
    }
    const double det = a * c - b * b;
    return {(c * p - b * q) / det, (a * q - b * p) / det};
  }
  Sandwich sandwich(std::size_t clusters) const {
    const auto x = solve(clusters);
    Sandwich s{{0, 0, 0, 0}, {0, 0, 0, 0}, {}, {}, {}, {}};
    s.clusters.assign(clusters, {ArrowMatrix{0, 0, 0, 0}, {0, 0}});
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double r = j[i][0] * x[0] + j[i][1] * x[1] - y[i];
      for (std::size_t k = 0; k < 2; ++k) {
        s.clusters[cluster[i]].score[k] += r * j[i][k];
        for (std::size_t l = k; l < 2; ++l) {
          s.bread.add(k, l, j[i][k] * j[i][l]);
          s.clusters[cluster[i]].bread.add(k, l, j[i][k] * j[i][l]);
        }
      }
    }
    return s;
  }
};
Line five_clusters() {
  Line l;
  for (std::size_t i = 0; i < 23; ++i) {
    const auto t = static_cast<double>(i);
    l.j.push_back({1, std::sin(2 * t) + 0.1 * t});
    l.y.push_back(0.5 + 0.3 * l.j.back()[1] + 0.2 * std::cos(5 * t));
    l.cluster.push_back(i % 5 == 4 && i > 9 ? 3 : i % 5);
  }
  return l;
}

TEST(Uncertainty, OfClustersIsTheMovesWhenEachIsLeftOut) {
  const Line l = five_clusters();
  const auto s = l.sandwich(5);
  const auto u = uncertainty(s, std::vector{0.0, 0.0}, {{-10, -10}, {10, 10}}, 23);
  const auto all = l.solve(5);
  std::array<double, 2> squares{};
  double quartic = 0;
  for (std::size_t g = 0; g < 5; ++g) {
    for (std::size_t k = 0; k < 2; ++k) squares[k] += std::pow(l.solve(g)[k] - all[k], 2);
    quartic += std::pow(l.solve(g)[0] - all[0], 4);
  }
  // (B⁻¹ B_g B⁻¹)_kk/(B⁻¹)_kk of the first unknown, by hand
  const double a = s.bread(0, 0), b = s.bread(0, 1), c = s.bread(1, 1), det = a * c - b * b;
  double shares = 0, fourth = 0;
  for (const auto& g : s.clusters) {
    const auto& m = g.bread;
    const double share =
        (c * c * m(0, 0) - 2 * b * c * m(0, 1) + b * b * m(1, 1)) / (det * det) / (c / det);
    shares += share;
    fourth += share * share;
  }
  EXPECT_NEAR(shares, 1, 1e-12);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(u[k].std_error, std::sqrt(squares[k]), 1e-12) << k;
  EXPECT_NEAR(u[0].t,
              students_t_quantile(
                  0.975, std::min({1 / fourth, 4.0, 3 * squares[0] * squares[0] / quartic})),
              1e-9);
}

TEST(Uncertainty, OfClustersOfOneValueIsThatOfIndependentValues) {
  Line l = five_clusters();
  for (std::size_t i = 0; i < l.cluster.size(); ++i) l.cluster[i] = i;
  const auto s = l.sandwich(23);
  Sandwich values{s.bread, {0, 0, 0, 0}, {}, {0, 0}, {0, 0}, {0, 0}};
  const double a = s.bread(0, 0), b = s.bread(0, 1), c = s.bread(1, 1), det = a * c - b * b;
  for (std::size_t i = 0; i < 23; ++i) {
    const auto [x, y] = l.j[i];
    const double u = (c * x - b * y) / det, v = (a * y - b * x) / det;  // B⁻¹ j
    const double left = 1 - (x * u + y * v);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t m = k; m < 2; ++m)
        values.meat.add(k, m, s.clusters[i].score[k] * s.clusters[i].score[m] / (left * left));
    values.fourth[0] += std::pow(u, 4) / std::pow(c / det, 2);
    values.fourth[1] += std::pow(v, 4) / std::pow(a / det, 2);
    const double r = std::abs(s.clusters[i].score[0] / x) / left;
    values.moves[0] += std::pow(u * r, 4) / std::pow(c / det, 2);
    values.moves[1] += std::pow(v * r, 4) / std::pow(a / det, 2);
  }
  const Bounds bounds{{-10, -10}, {10, 10}};
  const auto p = uncertainty(s, std::vector{0.0, 0.0}, bounds, 23);
  const auto q = uncertainty(values, std::vector{0.0, 0.0}, bounds, 23);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(p[k].std_error / q[k].std_error, 1, 1e-10);
    EXPECT_NEAR(p[k].t, q[k].t, 1e-9);
  }
}

TEST(Uncertainty, KnowsNoErrorOfWhatOneClusterAloneDetermines) {
  Line l = five_clusters();
  for (std::size_t i = 0; i < l.j.size(); ++i)
    if (l.cluster[i] != 2) l.j[i][1] = 0;  // the others say nothing of the second
  const auto u = uncertainty(l.sandwich(5), std::vector{0.0, 0.0}, {{-10, -10}, {10, 10}}, 23);
  EXPECT_EQ(u[1].status, ParameterStatus::free);
  EXPECT_TRUE(std::isnan(u[1].std_error));
  EXPECT_FALSE(std::isnan(u[0].std_error));
}

TEST(Uncertainty, IsTheWiderOfTwo) {
  Uncertainty a(3);
  Uncertainty b(3);
  const auto put = [](ParameterVerdict& v, double error, double t) {
    v.std_error = error, v.t = t;
  };
  put(a[0], 1, 2), put(a[1], 1, 4), put(a[2], 1, 2);
  put(b[0], 3, 2), put(b[1], 1.5, 2), put(b[2], std::nan(""), 2);
  const auto w = wider(a, b);
  EXPECT_EQ(w[0].std_error, 3);
  EXPECT_EQ(w[1].std_error, 1);
  EXPECT_EQ(w[1].t, 4);
  EXPECT_TRUE(std::isnan(w[2].std_error));
  EXPECT_TRUE(std::isnan(wider(b, a)[2].std_error));
}

TEST(Uncertainty, LosesADirectionWhenItsScaledEigenvalueIsBelowOneInTenToTheEleventh) {
  const auto told = [](double eigenvalue) {  // of (1 ρ; ρ 1): 1 − ρ and 1 + ρ
    const double all = 1e20, rho = 1 - eigenvalue;
    const Sandwich s{
        {all, all * rho, all * rho, all}, {all, all * rho, all * rho, all}, {}, {}, {}, {}};
    return uncertainty(s, std::vector{0.5, 0.5}, {{0, 0}, {1, 1}}, 1000);
  };
  for (const auto i : {0U, 1U}) {
    EXPECT_EQ(told(3e-12)[i].status, ParameterStatus::not_identifiable);
    EXPECT_EQ(told(3e-11)[i].status, ParameterStatus::free);
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
    for (const std::size_t clusters : {0U, 4U}) {
      const auto bread = both_forms(rows);
      auto meat = both_forms(arrow_rows(50));
      std::vector<Cluster> dense, arrow;
      if (clusters) {
        meat = both_forms({});
        for (std::size_t g = 0; g < clusters; ++g) {
          std::vector<std::vector<double>> own;
          std::vector<double> score;
          for (std::size_t r = g; r < rows.size(); r += clusters) own.push_back(rows[r]);
          for (std::size_t i = 0; i < 7; ++i)
            score.push_back(30 * std::cos(static_cast<double>(3 * g + i * i)));
          const auto part = both_forms(own);
          dense.push_back({part.dense, score});
          arrow.push_back({part.arrow, score});
        }
      }
      const std::vector<double> x(7, 0.5);
      const Bounds bounds{std::vector<double>(7, -10), std::vector<double>(7, 10)};
      const auto a = uncertainty({bread.dense, meat.dense, dense, {}, {}, {}}, x, bounds, 100);
      const auto b = uncertainty({bread.arrow, meat.arrow, arrow, {}, {}, {}}, x, bounds, 100);
      for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(a[i].status, b[i].status);
      EXPECT_EQ(a[5].status,
                rows == twin ? ParameterStatus::not_identifiable : ParameterStatus::free);
      if (rows != twin) {
        EXPECT_NEAR(b.condition / a.condition, 1, 1e-9);
      }
      for (std::size_t i = 0; i < 7; ++i) {
        if (a[i].status != ParameterStatus::free) continue;
        EXPECT_NEAR(b[i].std_error / a[i].std_error, 1, 1e-8);
        EXPECT_NEAR(b[i].t / a[i].t, 1, 1e-8);
        for (std::size_t k = 0; k < 7; ++k) {
          if (a[k].status != ParameterStatus::free) continue;
          EXPECT_NEAR(b.correlations[i][k], a.correlations[i][k], 1e-8);
        }
      }
    }
}

TEST(Uncertainty, KnowsNothingWithoutADegreeOfFreedom) {
  ByHand h;
  EXPECT_TRUE(std::isnan(uncertainty(h.s, h.x, h.bounds, 2)[0].std_error));
  EXPECT_FALSE(std::isnan(uncertainty(h.s, h.x, h.bounds, 3)[0].std_error));
  h.s.clusters = {{h.s.bread, {0, 0}}};
  EXPECT_TRUE(std::isnan(uncertainty(h.s, h.x, h.bounds, 100)[0].std_error));
}

/// Every channel's matrix would take place with their square.
TEST(Uncertainty, OfManyUnknownsKnowsTheCorrelationsOfOneChannelAlone) {
  for (const std::size_t channels : {63U, 64U, 2000U}) {
    std::vector<std::vector<std::size_t>> arms;
    for (std::size_t c = 0; c < channels; ++c) arms.push_back({1 + 2 * c, 2 + 2 * c});
    ArrowMatrix bread(std::make_shared<const ArrowLayout>(std::vector<std::size_t>{0}, arms));
    const std::size_t n = 1 + 2 * channels;
    for (std::size_t i = 0; i < n; ++i) bread.add(i, i, 4);
    for (std::size_t c = 0; c < channels; ++c) bread.add(1 + 2 * c, 2 + 2 * c, c == 5 ? -3.5 : 0.5);
    Bounds bounds;
    bounds.low.assign(n, -100);
    bounds.high.assign(n, 100);
    const std::vector<double> x(n, 0.5);
    const auto u = uncertainty({bread, bread, {}, {}, {}, {}}, x, bounds, 1e6);
    const bool all = n <= 128;
    ASSERT_EQ(u.correlated.size(), all ? n : 3U);
    EXPECT_EQ(u.correlations.size(), u.correlated.size());
    const std::size_t a = all ? 11 : 1;
    EXPECT_EQ(u.correlated[a], 11U) << "of the channel that is told apart least";
    EXPECT_NEAR(u.correlations[a][a + 1], 3.5 / 4, 1e-9);
  }
}

}  // namespace
}  // namespace gonio
