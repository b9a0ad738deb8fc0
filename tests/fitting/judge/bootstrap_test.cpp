// Intervals from fits of tables drawn from the fitted one's own samples.
#include "fitting/judge/bootstrap.h"

#include <cmath>
#include <map>
#include <random>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";

FitDocument fitted(const Table& t, Intervals intervals, const char* model = paint) {
  FitOptions o;
  o.model = model;
  o.intervals = intervals;
  return fit(t, o).document;
}

TEST(Bootstrap, OfIndependentValuesIsTheSandwich) {
  const Table t = synthesize(test::bind(paint, "alpha=0.3,f0=0.05,kd=0.2", 1),
                             {.layout = Layout::random, .samples = 400, .noise = 0.05});
  const auto drawn = fitted(t, Intervals::bootstrap), sandwich = fitted(t, Intervals::automatic);
  EXPECT_EQ(drawn.intervals, "bootstrap of values");
  for (std::size_t k = 0; k < drawn.parameters.size(); ++k) {
    const auto &a = drawn.parameters[k], &b = sandwich.parameters[k];
    EXPECT_EQ(a.value[0], b.value[0]) << a.name;
    EXPECT_NEAR(a.std_error[0] / b.std_error[0], 1, 0.2) << a.name;
    EXPECT_NEAR((a.ci95_high[0] - a.ci95_low[0]) / (b.ci95_high[0] - b.ci95_low[0]), 1, 0.25)
        << a.name;
    EXPECT_LT(a.ci95_low[0], a.value[0]) << a.name;
    EXPECT_GT(a.ci95_high[0], a.value[0]) << a.name;
  }
}

TEST(Bootstrap, OfAMeasuredTableDrawsIncidentAngles) {
  DirectionList l;
  for (int in = 2; in < 80; in += 4)
    for (int out = 0; out < 80; out += 4) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(out);
      l.phi_o_deg.push_back(180);
    }
  Table t = test::list_of({0.1});
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::map<double, double> gains;
  t.values[0].clear();
  for (const double in : l.theta_i_deg) {
    const auto [gain, is_new] = gains.try_emplace(in, 0);
    if (is_new) gain->second = std::exp(0.05 * normal(engine));
    t.values[0].push_back(0.1 * gain->second);
  }
  t.where = std::move(l);
  const auto drawn = fitted(t, Intervals::bootstrap, "lambert");
  EXPECT_EQ(drawn.intervals, "bootstrap of incident angles");
  EXPECT_EQ(drawn.clusters, 20U);
  // The mean of 20 gains of 5 %.
  double mean = 0, squares = 0;
  for (const auto& [in, gain] : gains) mean += std::log(gain) / 20;
  for (const auto& [in, gain] : gains) squares += std::pow(std::log(gain) - mean, 2);
  const double relative = std::sqrt(squares / 19 / 20);
  EXPECT_NEAR(drawn.parameters[0].std_error[0] / drawn.parameters[0].value[0], relative,
              0.12 * relative);
}

TEST(Bootstrap, OfALargeTableIsThatOfAllItsValues) {
  const Table t = synthesize(test::bind("lambert", "kd=0.2", 1),
                             {.layout = Layout::random, .samples = 80'000, .noise = 0.1});
  const auto d = fitted(t, Intervals::bootstrap, "lambert");
  EXPECT_NEAR(d.parameters[0].std_error[0], 0.2 * 0.1 / std::sqrt(80'000.0), 1e-5);
}

TEST(Bootstrap, IsTheSameForAnyNumberOfThreads) {
  const Table t = synthesize(test::bind(paint, "alpha=0.3,f0=0.05,kd=0.2", 1),
                             {.layout = Layout::random, .samples = 60, .noise = 0.05});
  const auto two = fitted(t, Intervals::bootstrap);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = fitted(t, Intervals::bootstrap);
  for (std::size_t k = 0; k < two.parameters.size(); ++k)
    EXPECT_EQ(two.parameters[k].ci95_low, alone.parameters[k].ci95_low);
}

TEST(Bootstrap, OfOneValueIsNone) {
  const auto d = fitted(test::list_of({0.1}), Intervals::bootstrap, "lambert");
  EXPECT_EQ(d.intervals, "independent values");
  EXPECT_TRUE(std::isnan(d.parameters[0].std_error[0]));
}

/// Bootstrap of a Lambertian with as many values as that, which scatter by 2 %.
FittedParameter drawn_kd(const Table& t) {
  return fitted(t, Intervals::bootstrap, "lambert").parameters[0];
}
Table scattered(std::size_t samples, std::uint64_t seed) {
  return synthesize(test::bind("lambert", "kd=0.2", 1),
                    {.layout = Layout::random, .samples = samples, .noise = 0.02, .seed = seed});
}

TEST(Bootstrap, LeavesOutOneIn40AtEachEnd) {
  // The mean of many logarithms is normal, whose tails are known.
  constexpr int tables = 20;
  double below = 0, above = 0;
  for (std::uint64_t seed = 1; seed <= tables; ++seed) {
    const auto kd = drawn_kd(scattered(400, seed));
    const auto tail = [&](double end) {
      return std::erfc(std::abs(end - kd.value[0]) / kd.std_error[0] / std::sqrt(2.0)) / 2;
    };
    below += tail(kd.ci95_low[0]) / tables;
    above += tail(kd.ci95_high[0]) / tables;
  }
  EXPECT_NEAR(below, 1 / 40.0, 0.01);
  EXPECT_NEAR(above, 1 / 40.0, 0.01);
}

TEST(Bootstrap, OfFewValuesHasTheErrorOfTheirMean) {
  constexpr std::size_t n = 4;
  constexpr int tables = 20;
  double ratio = 0;  // to s/√n, whose s is that of n − 1 degrees of freedom
  for (std::uint64_t seed = 1; seed <= tables; ++seed) {
    const Table t = scattered(n, seed);
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < n; ++i) mean += std::log(t.values[0][i]) / n;
    for (std::size_t i = 0; i < n; ++i) squares += std::pow(std::log(t.values[0][i]) - mean, 2);
    const auto kd = drawn_kd(t);
    ratio += kd.std_error[0] / kd.value[0] / std::sqrt(squares / (n - 1) / n) / tables;
  }
  EXPECT_NEAR(ratio, 1, 0.06);
}

}  // namespace
}  // namespace gonio
