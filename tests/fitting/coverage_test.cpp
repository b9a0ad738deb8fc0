// The 95 % intervals hold the truth 95 times in a hundred, for every metric.
#include <gtest/gtest.h>

#include "data_synth/synth.h"
#include "fitting/fit.h"

namespace gonio {
namespace {

class Coverage : public testing::TestWithParam<std::size_t> {};

TEST_P(Coverage, Of95PercentIntervalsLiesBetween90And99Percent) {
  const BoundModel truth =
      bind_model("lambert+ggx/smith_ggx.correlated/schlick",
           parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  FitOptions o;
  o.metric = static_cast<Metric>(GetParam());
  std::size_t inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto t = synthesize(
        truth, {.layout = Layout::random, .samples = 300, .noise = 0.02, .seed = seed});
    const auto d = fit(t, o).document;
    for (const auto& p : truth.model.parameters)
      for (const auto& q : d.parameters)
        if (q.name == p.name)
          for (std::size_t c = 0; c < p.count; ++c, ++all)
            inside += q.ci95_low[c] <= truth.values[p.first + c] &&
                      truth.values[p.first + c] <= q.ci95_high[c];
  }
  ASSERT_EQ(all, 700U);
  const double coverage = static_cast<double>(inside) / static_cast<double>(all);
  RecordProperty("coverage_percent", static_cast<int>(100 * coverage));
  EXPECT_GE(coverage, 0.90);
  EXPECT_LE(coverage, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Metrics, Coverage, testing::Values(0U, 1U, 2U), [](const auto& i) {
  return std::string(metric_names[i.param]);
});

}  // namespace
}  // namespace gonio
