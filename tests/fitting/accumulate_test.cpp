// The sums over columns are the sums over samples, whatever the threads; Ceres sees the same
// problem.
#include "fitting/accumulate.h"

#include <cmath>

#include "data_synth/synth.h"
#include "fitting/fit.h"
#include "fitting/solve.h"
#include "fitting/uncertainty.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

BoundModel paint() {
  return bind_model(
      "lambert.coupled+gtr/smith_ggx.correlated/schlick",
      parse_settings(std::vector<std::string>{"alpha=0.2,gamma=1.7,f0=0.05,kd=0.2,0.1,0.05"}), 3);
}

struct Case {
  BoundModel model = paint();
  FitData data;
  FreeSlots free{std::vector<bool>(8, true)};
  std::vector<double> off;  ///< values away from the optimum
  explicit Case(Metric metric, std::size_t samples = 3000) {
    Table t = synthesize(model, {.layout = Layout::random, .samples = samples, .noise = 0.1});
    for (std::size_t i = 0; i < t.size(); i += 11) t.values[i % 3][i] = i % 2 ? -1 : std::nan("");
    t.weights.assign(t.size(), 1);
    for (std::size_t i = 0; i < t.size(); i += 7) t.weights[i] = 0.5 * static_cast<double>(i % 5);
    data = fit_data(t, Bins::centre, metric, 0);
    off = model.values;
    for (auto& v : off) v *= 1.1;
  }
};

TEST(NormalEquations, GradientIsTheSlopeOfTheCost) {
  for (std::size_t m = 0; m < metric_names.size(); ++m)
    for (const double huber : {std::numeric_limits<double>::max(), 0.05}) {
      const Case c(static_cast<Metric>(m));
      const Accumulator a(c.model.model, c.data, c.free, {static_cast<Metric>(m), huber});
      const auto e = a.normal_equations(c.off);
      for (std::size_t i = 0; i < c.off.size(); ++i) {
        auto low = c.off, high = c.off;
        const double h = 1e-5 * c.off[i];
        low[i] -= h;
        high[i] += h;
        const double slope =
            (a.normal_equations(high).cost - a.normal_equations(low).cost) / (2 * h);
        EXPECT_NEAR(e.g[i], slope, 1e-5 * std::abs(slope) + 1e-7 * e.cost) << metric_names[m] << i;
      }
    }
}

TEST(NormalEquations, AreTheNaiveSumsOverResiduals) {
  const Case c(Metric::log, 500);
  const Accumulator a(c.model.model, c.data, c.free, {Metric::log});
  const auto e = a.normal_equations(c.off);
  const auto r = a.residuals(c.off);
  ASSERT_EQ(r.size(), c.data.values_used);
  double cost = 0;
  for (const double x : r) cost += x * x / 2;
  EXPECT_NEAR(e.cost, cost, 1e-12 * cost);
  // J by differences of the residuals themselves
  std::vector<std::vector<double>> j;
  for (std::size_t i = 0; i < c.off.size(); ++i) {
    auto low = c.off, high = c.off;
    const double h = 1e-6 * c.off[i];
    low[i] -= h;
    high[i] += h;
    auto up = a.residuals(high);
    const auto down = a.residuals(low);
    for (std::size_t k = 0; k < up.size(); ++k) up[k] = (up[k] - down[k]) / (2 * h);
    j.push_back(std::move(up));
  }
  for (std::size_t p = 0; p < 8; ++p)
    for (std::size_t q = 0; q < 8; ++q) {
      double sum = 0, size = 0;
      for (std::size_t k = 0; k < r.size(); ++k) {
        sum += j[p][k] * j[q][k];
        size += std::abs(j[p][k] * j[q][k]);
      }
      EXPECT_NEAR(e.h[p * 8 + q], sum, 1e-6 * size + 1e-12) << p << q;
    }
}

TEST(Sandwich, OfIndependentValuesIsTheSumOfSquaredScoresAndOfClustersTheSquareOfTheirSums) {
  const Case c(Metric::l2_cosine, 500);
  const Accumulator a(c.model.model, c.data, c.free, {Metric::l2_cosine});
  const auto e = a.normal_equations(c.off);
  const auto independent = a.sandwich(c.off, false);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(independent.bread[i], e.h[i], 1e-12 * std::abs(e.h[i]));
  // One cluster holding all: its score is the whole gradient.
  Case one(Metric::l2_cosine, 500);
  std::fill(one.data.incident.begin(), one.data.incident.end(), std::uint32_t{0});
  one.data.clusters = 1;
  const Accumulator b(one.model.model, one.data, one.free, {Metric::l2_cosine});
  const auto s = b.sandwich(one.off, true);
  for (std::size_t p = 0; p < 8; ++p)
    for (std::size_t q = 0; q < 8; ++q)
      EXPECT_NEAR(s.meat[p * 8 + q], e.g[p] * e.g[q], 1e-9 * std::abs(e.g[p] * e.g[q]) + 1e-20);
  // Each value its own cluster.
  Case each(Metric::l2_cosine, 500);
  for (std::size_t i = 0; i < each.data.incident.size(); ++i)
    each.data.incident[i] = static_cast<std::uint32_t>(i);
  each.data.clusters = each.data.samples();
  for (std::size_t ch = 1; ch < 3; ++ch)
    for (std::size_t i = 0; i < each.data.samples(); ++i) each.data.y[ch][i] = -1;
  const Accumulator d(each.model.model, each.data, each.free, {Metric::l2_cosine});
  const auto lone = d.sandwich(each.off, true), free = d.sandwich(each.off, false);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(lone.meat[i], free.meat[i], 1e-10 * std::abs(free.meat[i]) + 1e-20);
}

TEST(NormalEquations, AreTheSameBitsForAnyNumberOfThreads) {
  const Case c(Metric::log, 60000);
  const Accumulator a(c.model.model, c.data, c.free, {Metric::log});
  const auto many = a.normal_equations(c.off);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = a.normal_equations(c.off);
  EXPECT_EQ(many.h, single.h);
  EXPECT_EQ(many.g, single.g);
  EXPECT_EQ(many.cost, single.cost);
}

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
  const auto s = solve(evaluate, {10, -10}, {{-100, -100}, {100, 100}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.x[0], 1, 1e-6);
  EXPECT_NEAR(s.x[1], 2, 1e-6);
  EXPECT_NEAR(s.at.cost, 3, 1e-12);
  const auto inside = solve(evaluate, {10, -10}, {{-100, -100}, {100, 1}});
  EXPECT_EQ(inside.x[1], 1);
  EXPECT_NEAR(inside.x[0], 1.5, 1e-4);  // 2 (x − 1) + (1 − 2) = 0
}

TEST(Solve, SurvivesADirectionInWhichNothingChanges) {
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = x[0] + x[1] - 1;
    return NormalEquations{{1, 1, 0, 1, 1, 0, 0, 0, 0}, {a, a, 0}, a * a / 2 + 1};
  };
  const auto s = solve(evaluate, {0, 0, 5}, {{-9, -9, -9}, {9, 9, 9}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.x[0] + s.x[1], 1, 1e-6);
  EXPECT_EQ(s.x[2], 5);
}

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

TEST(Fit, IsTheSameDocumentForAnyNumberOfThreads) {
  const Table t = synthesize(paint(), {.layout = Layout::mbsdf, .noise = 0.05});
  FitOptions o;
  o.model = paint().model.spec;
  o.robust = true;
  const auto strip = [](FitDocument d) {
    d.solver.phase_ms.clear();
    return to_json(d);
  };
  const auto many = strip(fit(t, o).document);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(strip(fit(t, o).document), many);
}

}  // namespace
}  // namespace gonio
