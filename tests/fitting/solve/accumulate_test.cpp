// The sums over columns are the sums over samples, whatever the threads.
#include "fitting/solve/accumulate.h"

#include <algorithm>
#include <cmath>

#include "fitting/support.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

namespace gonio {
namespace {

using test::Case;
using test::small;

TEST(NormalEquations, GradientIsTheSlopeOfTheCost) {
  const Case c;
  for (std::size_t m = 0; m < names_of<Metric>.size(); ++m)
    for (const double huber : {no_huber, 0.05}) {
      const auto data = fit_data<double>(c.sampling(static_cast<Metric>(m)));
      const Accumulator<double> a(c.model.model, data, c.free, huber);
      const auto e = a.normal_equations(c.off);
      for (std::size_t i = 0; i < c.off.size(); ++i) {
        auto low = c.off, high = c.off;
        const double h = 1e-5 * c.off[i];
        low[i] -= h;
        high[i] += h;
        const double slope =
            (a.normal_equations(high).cost - a.normal_equations(low).cost) / (2 * h);
        EXPECT_NEAR(e.g[i], slope, 1e-5 * std::abs(slope) + 1e-7 * e.cost)
            << names_of<Metric>[m] << i;
      }
    }
}

TEST(NormalEquations, AreTheNaiveSumsOverResiduals) {
  const Case c = small();
  const auto data = fit_data<double>(c.sampling(Metric::log));
  const Accumulator<double> a(c.model.model, data, c.free);
  const auto e = a.normal_equations(c.off);
  const auto r = a.residuals(c.off);
  ASSERT_EQ(r.size(), data.counts.used);
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
      EXPECT_NEAR(e.h(p, q), sum, 1e-6 * size + 1e-12) << p << q;
    }
}

TEST(NormalEquations, AreTheSameBitsForAnyNumberOfThreads) {
  const Case c({.layout = Layout::random, .samples = 60000, .noise = 0.1});
  const auto data = fit_data<float>(c.sampling(Metric::log));
  const Accumulator<float> a(c.model.model, data, c.free);
  const auto many = a.normal_equations(c.off);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = a.normal_equations(c.off);
  EXPECT_TRUE(std::ranges::equal(many.h.entries(), single.h.entries()));
  EXPECT_EQ(many.g, single.g);
  EXPECT_EQ(many.cost, single.cost);
}

// A loop within one that an exception ends is told to stop, and says nothing of it.
TEST(NormalEquations, AreWholeThoughTheLoopAroundThemIsCancelled) {
  const Case c({.layout = Layout::random, .samples = 60000, .noise = 0.1});
  const auto data = fit_data<float>(c.sampling(Metric::log));
  ASSERT_GT(data.tasks.size(), 1U);
  const Accumulator<float> a(c.model.model, data, c.free);
  const auto alone = a.normal_equations(c.off);
  const auto alone_costs = a.channel_costs(c.off);
  tbb::task_group_context outer;
  bool was_in_it = false;
  tbb::parallel_for(
      0, 1,
      [&](int) {
        was_in_it = true;
        outer.cancel_group_execution();
        const auto e = a.normal_equations(c.off);
        EXPECT_EQ(e.g, alone.g);
        EXPECT_EQ(e.cost, alone.cost);
        EXPECT_EQ(a.channel_costs(c.off), alone_costs);
      },
      outer);
  EXPECT_TRUE(was_in_it);
}

}  // namespace
}  // namespace gonio
