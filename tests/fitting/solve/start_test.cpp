// Where a fit begins: near enough to the truth, whatever the width.
#include "fitting/solve/start.h"

#include <cmath>

#include "fitting/solve/problem.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::vector<double> start_of(const BoundModel& truth, FitOptions o, Layout layout) {
  o.model = to_text(truth.model.spec);
  const Table t = synthesize(truth, {.layout = layout, .noise = 0.02});
  const Problem p = pose(t, o);
  const Sampling s(t, t.bins(), Metric::log, 0, true);
  return find_starts(p, fit_data<double>(s, 2048), no_huber).front().values;
}

TEST(Start, LiesNearTheTruthForEveryWidth) {
  for (const double alpha : {0.02, 0.08, 0.25, 0.7}) {
    const auto truth = test::bind("lambert+ggx/smith_ggx.correlated/schlick",
                                  "f0=0.3,kd=0.2,alpha=" + std::to_string(alpha), 1);
    const auto at = start_of(truth, {}, Layout::in_plane);
    for (const auto& p : truth.model.parameters)
      EXPECT_NEAR(at[p.first] / truth.values[p.first], 1, 0.15) << p.name << " " << alpha;
  }
}

TEST(Start, LeavesFixedValuesAsTheyAre) {
  const auto truth =
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "f0=0.3,kd=0.2,alpha=0.2", 1);
  FitOptions o;
  o.fixed = parse_settings(std::vector<std::string>{"alpha=0.4,f0=0.1"});
  const auto at = start_of(truth, o, Layout::random);
  EXPECT_EQ(at[truth.model.find("alpha")->first], 0.4);
  EXPECT_EQ(at[truth.model.find("f0")->first], 0.1);
}

}  // namespace
}  // namespace gonio
