// The profile of the cost is that of fits with the parameter held.
#include "fitting/judge/cost_along.h"

#include <cmath>

#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

struct Asked {
  Table table;
  FitOptions options;
  Problem problem;
  FitData<double> data;
  Fitted best;
  static FitOptions asking(const char* model, Metric metric) {
    FitOptions o;
    o.model = model;
    o.metric = metric;
    return o;
  }
  Asked(const char* model, Table t, Metric metric)
      : table(std::move(t)),
        options(asking(model, metric)),
        problem(pose(table, options)),
        data(fit_data<double>(Sampling(table, Bins::centre, metric, 0, false))),
        best(minimise(problem, data, problem.start, no_huber)) {
    best.groups = data.groups;
  }
};

TEST(CostAlong, OfAValueThatTheResidualsFollowLinearlyIsAParabola) {
  const Asked a("lambert", test::list_of({0.1, 0.12, 0.09, 0.2, 0.11}), Metric::l2_cosine);
  CostAlong along(a.problem, a.data, a.best, 0);
  const double kd = a.best.model.values[0], h = a.best.solution.at.h(0, 0);
  for (const double step : {-0.1, -0.02, 0.05, 0.2})
    EXPECT_NEAR(along.rise(kd + step, h), h * step * step, 1e-9 * h) << step;
  EXPECT_NEAR(along.reach(1, h * 0.04), kd + 0.2, 0.01 * 0.2);
  EXPECT_NEAR(along.reach(0, h * 0.01), kd - 0.1, 0.01 * 0.1);
  EXPECT_EQ(along.reach(kd + 0.1, h), kd + 0.1) << "never that much";
  EXPECT_EQ(along.reach(kd + 0.1005, h * 0.01), kd + 0.1005)
      << "so near the end that it is the end";
  // Far below what the ends cost.
  EXPECT_NEAR(along.reach(1, h * 1e-12), kd + 1e-6, 0.02e-6);
}

TEST(CostAlong, MovesAllOthersToWhereTheyAreBest) {
  const auto truth =
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.05,kd=0.2", 1);
  const Table t = synthesize(truth, {.layout = Layout::random, .samples = 300, .noise = 0.05});
  const Asked a("lambert+ggx/smith_ggx.correlated/schlick", t, Metric::log);
  const std::size_t alpha = a.problem.free.index(truth.model.find("alpha")->first);
  FitOptions held = a.options;
  held.fixed = parse_settings(std::vector<std::string>{"alpha=0.32"});
  const Problem p = pose(t, held);
  const double cost = minimise(p, a.data, p.start, no_huber).solution.at.cost;
  const double rise = 2 * (cost - a.best.solution.at.cost);
  CostAlong along(a.problem, a.data, a.best, alpha);
  EXPECT_NEAR(along.rise(0.32, rise), rise, 0.01 * rise);
  along.rise(0.35, rise);  // whose values the next one begins from
  EXPECT_NEAR(along.rise(0.32, rise), rise, 0.01 * rise);
  // Less than with the others held.
  auto moved = a.best.model.values;
  moved[a.problem.free.slots()[alpha]] = 0.32;
  const double alone =
      Accumulator<double>(p.start.model, a.data, a.problem.free).normal_equations(moved).cost;
  EXPECT_LT(rise, 1.9 * (alone - a.best.solution.at.cost));
}

}  // namespace
}  // namespace gonio
