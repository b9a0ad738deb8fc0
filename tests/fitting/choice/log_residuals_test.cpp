#include "fitting/choice/log_residuals.h"

#include <cmath>

#include "base/random.h"
#include "data_synth/synth.h"
#include "fitting/fit.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Residuals of some angles, each the sum of one of the angle and one of its own.
ResidualsByAngle drawn(std::size_t angles, std::size_t each, double of_angle, double of_value) {
  ResidualsByAngle all;
  for (std::size_t a = 0; a < angles; ++a) {
    Draws draw(5, a);
    const double shared = of_angle * draw.normal();
    for (std::size_t i = 0; i < each; ++i) {
      const double r = shared + of_value * draw.normal();
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

TEST(EffectiveValues, OfAnglesThatShareOneErrorGoByTheirSizes) {
  ResidualsByAngle all;  // (Σ n)²/Σ n² = 3 of what each angle shares, yet no fewer than the angles
  for (const auto& [n, r] : {std::pair(90.0, 1.0), {30.0, -1.0}, {30.0, 0.5}, {30.0, -0.5}})
    all[static_cast<std::size_t>(all.size())] = {n, n * r, n * r * r};
  EXPECT_NEAR(effective_values(all), 4, 1e-9);
  // Next to nothing shared: all of them, each one of ten of the table.
  for (auto& [angle, a] : all) a.squares += 2000 * a.values;
  EXPECT_NEAR(effective_values(all, 10), 1800, 1e-9);
}

TEST(LogResiduals, AreTheFitsOwnWhereTheModelVanishes) {
  SynthOptions s;
  s.layout = Layout::random;
  const Table t = synthesize(
      bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {0.3}}, {"f0", {0.8}}}, 1), s);
  FitOptions o;
  o.model = "beckmann/smith_beckmann.correlated/schlick";
  o.fixed = {{"alpha", {0.02}}};
  const FitResult r = fit(t, o);
  const auto all = total(log_residuals(Sampling(t, t.bins(), Metric::log, 0, false), r.model));
  EXPECT_EQ(all.values, static_cast<double>(r.document.values_used));
  EXPECT_GT(all.rms(), 10);
  EXPECT_NEAR(all.rms(), std::sqrt(2 * r.document.cost / all.values), 1e-6 * all.rms());
}

TEST(LogResiduals, AreThoseOfTheModelAtTheSamples) {
  const auto settings = parse_settings(std::vector<std::string>{"alpha=0.3", "f0=0.8"});
  const BoundModel metal = bind_model("ggx/smith_ggx.correlated/schlick", settings, 1);
  SynthOptions s;
  s.layout = Layout::random;
  const Table t = synthesize(metal, s);
  BoundModel half = metal;
  half.values[half.model.find("f0")->first] = 0.4;
  const Sampling sampling(t, t.bins(), Metric::log, 0, false);
  EXPECT_LT(total(log_residuals(sampling, metal)).rms(), 1e-12);
  const auto off = total(log_residuals(sampling, half));
  EXPECT_EQ(off.values, static_cast<double>(t.size()));
  EXPECT_NEAR(off.rms(), std::log(2), 0.1) << "Schlick's edge is white all the same";
}

}  // namespace
}  // namespace gonio
