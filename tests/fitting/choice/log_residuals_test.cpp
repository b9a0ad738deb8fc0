#include "fitting/choice/log_residuals.h"

#include <cmath>
#include <random>

#include "data_synth/synth.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Residuals of some angles, each the sum of one of the angle and one of its own.
ResidualsByAngle drawn(std::size_t angles, std::size_t each, double of_angle, double of_value) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  ResidualsByAngle all;
  for (std::size_t a = 0; a < angles; ++a) {
    const double shared = of_angle * normal(random);
    for (std::size_t i = 0; i < each; ++i) {
      const double r = shared + of_value * normal(random);
      all[a].add({1, r, r * r});
    }
  }
  return all;
}

TEST(EffectiveValues, AreAllWhereResidualsAreIndependent) {
  const double n = effective_values(drawn(200, 50, 0, 1));
  EXPECT_GT(n, 0.8 * 10'000);
  EXPECT_LE(n, 10'000);
}

TEST(EffectiveValues, AreTheAnglesWhereEachSharesOneError) {
  EXPECT_NEAR(effective_values(drawn(200, 50, 1, 1e-3)), 200, 1);
}

TEST(EffectiveValues, FollowTheDesignEffectBetween) {
  // ρ = 0.1: 1 + 49 · 0.1 = 5.9
  EXPECT_NEAR(effective_values(drawn(2000, 50, 1, 3)) / (100'000 / 5.9), 1, 0.1);
}

TEST(LogResiduals, AreThoseOfTheModelAtTheSamples) {
  const auto settings = parse_settings(std::vector<std::string>{"alpha=0.3", "f0=0.8"});
  const BoundModel metal = bind_model("ggx/smith_ggx.correlated/schlick", settings, 1);
  SynthOptions s;
  s.layout = Layout::random;
  const Table t = synthesize(metal, s);
  BoundModel twice = metal;
  twice.values[twice.model.find("f0")->first] = 0.4;
  const Sampling sampling(t, t.bins(), Metric::log, 0, false);
  EXPECT_LT(total(log_residuals(sampling, metal)).rms(), 1e-12);
  const auto off = total(log_residuals(sampling, twice));
  EXPECT_EQ(off.values, static_cast<double>(t.size()));
  EXPECT_NEAR(off.rms(), std::log(2), 0.1) << "Schlick's edge is white all the same";
}

}  // namespace
}  // namespace gonio
