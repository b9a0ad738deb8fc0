// The 95 % intervals hold the truth 95 times in a hundred, for every metric.
#include <cmath>
#include <random>

#include "brdf/model/evaluate.h"
#include "data_synth/synth.h"
#include "fitting/fit.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

class MetricCoverage : public testing::TestWithParam<std::size_t> {};

TEST_P(MetricCoverage, Of95PercentIntervalsLiesBetween90And99Percent) {
  const BoundModel truth =
      bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                 parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  FitOptions o;
  o.metric = static_cast<Metric>(GetParam());
  std::size_t inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto t =
        synthesize(truth, {.layout = Layout::random, .samples = 300, .noise = 0.02, .seed = seed});
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

INSTANTIATE_TEST_SUITE_P(Metrics, MetricCoverage, testing::Values(0U, 1U, 2U), [](const auto& i) {
  return std::string(metric_names[i.param]);
});

/// A goniometer whose gain drifts by 2 % from one incident angle to the next: 24 angles, the values
/// of each share its error.
Table drifting(const BoundModel& truth, unsigned seed) {
  Table t;
  t.format = "csv";
  t.channels = {"r", "g", "b"};
  DirectionList l;
  std::vector<double> gain;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  for (int in = 3; in < 75; in += 3) {
    const double drift = std::exp(0.02 * normal(engine));
    for (int out = 2; out < 80; out += 12)
      for (int phi = 0; phi <= 180; phi += 45) {
        l.theta_i_deg.push_back(in);
        l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(out);
        l.phi_o_deg.push_back(phi);
        gain.push_back(drift);
      }
  }
  t.where = std::move(l);
  t.values.assign(3, Values(gain.size()));
  const SampleAngles at(t);
  std::vector<Angles<double>> angles;
  for (std::size_t i = 0; i < gain.size(); ++i) angles.push_back(at(i));
  const auto f = evaluate(truth, angles);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < gain.size(); ++i)
      t.values[c][i] = f[c][i] * gain[i] * std::exp(0.005 * normal(engine));
  return t;
}

TEST(Coverage, HoldsForAHandfulOfValues) {
  const BoundModel truth =
      bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.3"}), 1);
  FitOptions o;
  o.model = "lambert";
  std::size_t inside = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const auto t =
        synthesize(truth, {.layout = Layout::random, .samples = 6, .noise = 0.02, .seed = seed});
    const auto kd = fit(t, o).document.parameters[0];
    inside += kd.ci95_low[0] <= 0.3 && 0.3 <= kd.ci95_high[0];
  }
  // A binomial of 400 at 95 % lies in [366, 394] with 99.9 % probability; 1.96 would give about
  // 352.
  EXPECT_GE(inside, 366U);
  EXPECT_LE(inside, 394U);
}

TEST(Coverage, CountsOnlyIncidentAnglesThatHaveAValue) {
  const BoundModel truth =
      bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.2"}), 1);
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  t.values.resize(1);
  for (int in = 0; in < 41; ++in)
    for (int out = 0; out < 60; out += 2) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(out);
      l.phi_o_deg.push_back(180);
      const double ripple = 1 + 0.02 * (out % 4 == 0 ? 1 : -1);
      t.values[0].push_back(in == 20 ? 0.2 / M_PI * ripple : std::nan(""));
    }
  t.where = std::move(l);
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  EXPECT_EQ(d.clusters, 0U);
  EXPECT_NEAR(d.parameters[0].std_error[0], 0.2 * 0.02 / std::sqrt(30), 2e-4);
  ASSERT_EQ(d.warnings.size(), 1U);
  EXPECT_NE(d.warnings[0].find("1 incident angles are few"), std::string::npos) << d.warnings[0];
}

TEST(Coverage, ClustersByAFewAnglesWhenAskedToAndWarnsWhenNot) {
  const BoundModel truth = bind_model("lambert", {}, 1);
  Table t = synthesize(truth, {.layout = Layout::hemisphere, .noise = 0.02});
  t.truth.reset();  // as if measured
  FitOptions o;
  o.model = "lambert";
  EXPECT_EQ(fit(t, o).document.clusters, 0U);
  EXPECT_EQ(fit(t, o).document.warnings.size(), 1U);
  o.intervals = Intervals::by_angle;
  EXPECT_EQ(fit(t, o).document.clusters, 6U);
}

TEST(Coverage, HoldsForErrorsSharedByAnIncidentAngleOnlyWhenTheyAreClustered) {
  const BoundModel truth =
      bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                 parse_settings(std::vector<std::string>{"alpha=0.3,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  const auto coverage_of_kd = [&](Intervals intervals, unsigned seeds) {
    FitOptions o;
    o.intervals = intervals;
    std::size_t inside = 0;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const auto d = fit(drifting(truth, seed), o).document;
      EXPECT_EQ(d.clusters, intervals == Intervals::independent ? 0U : 24U);
      const auto& kd = d.parameters[0];
      inside += kd.ci95_low[0] <= 0.2 && 0.2 <= kd.ci95_high[0];
    }
    return inside;
  };
  // A binomial of 100 at 95 % lies in [88, 100] with 99.8 % probability.
  EXPECT_GE(coverage_of_kd(Intervals::automatic, 100), 88U);  // the table is taken as measured
  EXPECT_LE(coverage_of_kd(Intervals::independent, 40), 24U);
}

}  // namespace
}  // namespace gonio
