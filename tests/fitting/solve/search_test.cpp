// From nothing to the best fit of all samples.
#include "fitting/solve/search.h"

#include <cmath>

#include "base/error.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

Searched searched(const Table& t, const FitOptions& o) {
  std::vector<std::pair<std::string, double>> times;
  PhaseTimes watch(times);
  const Sampling s(t, t.bins(), o.metric, 0, !o.robust);
  SharedColumns columns;
  return search(pose(t, o), s, columns, watch, [](const char*) {});
}

TEST(Search, FindsTheValuesAndTheCostThatIsLeft) {
  const auto truth = test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.2,kd=0.3", 1);
  FitOptions o;
  o.model = to_text(truth.model.spec);
  const auto f = searched(synthesize(truth, {.layout = Layout::random}), o).best;
  EXPECT_TRUE(f.solution.converged);
  for (std::size_t i = 0; i < truth.values.size(); ++i)
    EXPECT_NEAR(f.model.values[i], truth.values[i], 1e-7);
  EXPECT_LT(f.solution.at.cost, 1e-12);
  EXPECT_EQ(f.huber, no_huber);
}

TEST(Search, SetsHubersThresholdAt1345StandardDeviationsOfNormalNoise) {
  FitOptions o;
  o.model = "lambert";
  o.robust = true;
  const auto truth = test::bind("lambert", "kd=0.3,0.2,0.1", 3);
  for (const double noise : {0.005, 0.02}) {
    const Table t = synthesize(truth, {.layout = Layout::random, .samples = 2000, .noise = noise});
    // The median size of 6000 normal deviates is known to 1.5 %.
    EXPECT_NEAR(searched(t, o).best.huber / noise, 1.345, 0.06);
  }
}

TEST(Search, ScansAboutAsManySamplesAsItSays) {
  FitOptions o;
  o.model = "lambert";
  const auto truth = test::bind("lambert", "kd=0.3", 1);
  const auto few = searched(synthesize(truth, {.layout = Layout::random, .samples = 500}), o);
  EXPECT_EQ(few.scanned.groups, 500U);
  const auto many = searched(synthesize(truth, {.layout = Layout::random, .samples = 200000}), o);
  EXPECT_NEAR(static_cast<double>(many.scanned.groups), scan_samples, 0.1 * scan_samples);
  EXPECT_EQ(many.best.groups, 200000U);
}

TEST(Search, TakesFloatsForManySamplesOnlyWhereTheyAreEnough) {
  FitOptions o;
  o.model = "lambert";
  const auto truth = test::bind("lambert", "kd=0.3", 1);
  constexpr std::size_t samples = 300'000;
  // With much noise the error is far above a float's rounding, with little it is not.
  for (const double noise : {0.1, 4e-4, 1e-4, 0.0}) {
    const Table t =
        synthesize(truth, {.layout = Layout::random, .samples = samples, .noise = noise});
    const Fitted f = searched(t, o).best;
    EXPECT_EQ(f.in_float, noise == 0.1) << noise;
    const auto all = fit_data<double>(Sampling(t, t.bins(), o.metric, 0, true));
    const double in_double = minimise(pose(t, o), all, f.model, no_huber).model.values[0];
    const double error = std::max(0.3 * noise / std::sqrt(samples), 1e-12);
    EXPECT_NEAR(f.model.values[0], in_double, error / 20) << noise;
  }
}

}  // namespace
}  // namespace gonio
