// Of values that noise took away the right model is not accused, and a wrong one is told by those
// that it left.
#include <algorithm>
#include <cmath>
#include <random>

#include "fitting/fit.h"
#include "fitting/goniometer.h"
#include "fitting/judge/lack_of_fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* glossy = "lambert+ggx/smith_ggx.correlated/schlick";

FitDocument fit_of(const Table& t, const char* model) {
  FitOptions o;
  o.model = model;
  return fit(t, o).document;
}

/// A surface on a goniometer, with noise in proportion to a value and beside it, clipped at the least.
Table in_noise(const BoundModel& truth, unsigned seed, double part, double beside, double least) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  test::put_on_goniometer(t, truth);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (double& f : t.values[0])
    f = std::max(f * std::exp(part * normal(random)) + beside * normal(random), least);
  return t;
}

TEST(LackInNoise, MakesTheDiffuseTermsIntervalHoldWhatDarkNoiseTakesFromItsLogarithms) {
  const auto truth = test::bind(glossy, "alpha=0.15,f0=0.04,kd=0.03", 1);
  unsigned inside = 0, told = 0;
  constexpr unsigned seeds = 8;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    Table t = synthesize(truth, {.layout = Layout::random, .samples = 1});
    test::put_on_goniometer(t, truth);
    t.truth.reset();  // as if measured
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (double& f : t.values[0]) f += 0.0025 * normal(random);
    FitOptions o;
    o.model = glossy;
    const auto d = fit(t, o).document;
    const auto& of = test::parameter(d, "kd");
    inside += of.ci95_low[0] <= 0.03 && 0.03 <= of.ci95_high[0];
    told += std::ranges::any_of(d.warnings, [](const auto& w) {
      return w.starts_with("noise lowers the logarithms of the darkest values");
    });
  }
  EXPECT_GE(inside, seeds - 1);
  EXPECT_GE(told, seeds / 2);
}

TEST(LackInNoise, AccusesNoRightModelBesideNoiseThatWasClipped) {
  // Zeros are left out of logarithms: what is left of the dark values is lifted.
  const auto truth = test::bind(glossy, "alpha=0.2,f0=0.05,kd=0.004", 1);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Table t = in_noise(truth, seed, 0.02, 0.003, seed % 2 ? 0.0 : 1e-4);
    FitOptions o;
    o.model = glossy;
    const auto d = fit(t, o).document;
    EXPECT_FALSE(d.misfit.told) << seed << " " << d.misfit.size;
    const auto& matte = test::parameter(d, "kd");
    EXPECT_EQ(matte.status[0], ParameterStatus::upper_limit) << seed;
    EXPECT_GT(matte.limit[0], 0.004) << seed;
    const auto& alpha = test::parameter(d, "alpha");
    EXPECT_LE(alpha.ci95_low[0], 0.2) << seed;
    EXPECT_GE(alpha.ci95_high[0], 0.2) << seed;
    for (const auto& w : d.warnings)
      EXPECT_EQ(w.find("noise lowers"), w.npos) << "what is clipped lifts them";
  }
}

TEST(LackInNoise, LimitsTheDiffuseTermWhereFewValuesWereClippedAndKeepsTheHighlight) {
  const auto truth = test::bind(glossy, "alpha=0.2,f0=0.1,kd=0.02", 1);
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const double least : {0.0, 5e-5, 1e-6}) {  // about one of a hundred values
      const Table t = in_noise(truth, seed, 0.02, 0.0055, least);
      const auto d = fit_of(t, glossy);
      EXPECT_FALSE(d.misfit.told) << seed << " " << least;
      EXPECT_FALSE(d.misfit.too_few) << seed << " " << least;
      const auto& matte = test::parameter(d, "kd");
      EXPECT_EQ(matte.status[0], ParameterStatus::upper_limit) << seed << " " << least;
      EXPECT_GT(matte.limit[0], 0.02) << seed << " " << least;
      EXPECT_EQ(test::parameter(d, "alpha").status[0], ParameterStatus::free) << seed << least;
      EXPECT_EQ(test::parameter(d, "f0").status[0], ParameterStatus::free) << seed << least;
    }
}

TEST(LackInNoise, LimitsTheDiffuseTermOfOnlyTheChannelThatNoiseCovers) {
  const auto truth = test::bind(glossy, "alpha=0.2,f0=0.05,kd=0.004", 1);
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  test::put_on_goniometer(t, truth);
  t.channels = {"r", "g", "b"};
  t.values.resize(3, t.values[0]);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (auto& plane : t.values)
    for (double& f : plane) f *= std::exp(0.01 * normal(random));
  for (double& f : t.values[2]) f += 0.003 * normal(random);
  FitOptions o;
  o.model = glossy;
  const auto d = fit(t, o).document;
  const auto& matte = test::parameter(d, "kd");
  for (const std::size_t c : {0, 1}) {
    EXPECT_EQ(matte.status[c], ParameterStatus::free) << c;
    EXPECT_LE(matte.ci95_low[c], 0.004) << c;
    EXPECT_GE(matte.ci95_high[c], 0.004) << c;
  }
  EXPECT_EQ(matte.status[2], ParameterStatus::upper_limit);
  EXPECT_GT(matte.limit[2], 0.004);
  EXPECT_TRUE(std::ranges::any_of(d.warnings, [](const auto& w) {
    return w.starts_with("negative values of channel b betray a noise floor");
  }));
}

TEST(LackInNoise, OfAWrongModelIsToldByBrightValuesThatItTakesForDark) {
  const auto truth = test::bind(glossy, "alpha=0.15,f0=0.05,kd=0.002", 1);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Table t = in_noise(truth, seed, 0.01, 0.004, 0);
    const auto matte = fit_of(t, "lambert");
    EXPECT_TRUE(matte.misfit.told) << seed << " " << matte.misfit.note;
    EXPECT_FALSE(fit_of(t, glossy).misfit.told) << seed;
    // So few bright values that nothing can be regressed on them are enough where all are far off.
    for (std::size_t i = 0; i < t.size(); ++i)
      if (i % 9 > 0 && t.values[0][i] > 0.02) t.values[0][i] = 0.001;
    const auto few = fit_of(t, "lambert");
    EXPECT_TRUE(few.misfit.told) << seed << " " << few.misfit.note;
    EXPECT_GT(few.misfit.size, 0.7);
  }
}

TEST(LackInNoise, OfTheRightModelIsJudgedBesideMarksOfWhatIsMissing) {
  // Six curves of one plane, in which neighbours of a mark lie on slopes and are not alike.
  const auto truth = test::bind(glossy, "alpha=0.2,f0=0.05,kd=0.02", 1);
  int accused = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Table t;
    t.format = "csv";
    t.channels = {"f"};
    DirectionList l;
    for (int in = 0; in <= 75; in += 15)
      for (int out = -80; out <= 80; out += 5) {
        l.theta_i_deg.push_back(in), l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(std::abs(out)), l.phi_o_deg.push_back(out < 0 ? 0 : 180);
      }
    t.where = std::move(l);
    test::put_values(t, truth);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (double& f : t.values[0]) f *= std::exp(0.01 * normal(random));
    for (std::size_t k = 0; k < 6; ++k)  // of the highlights, where values change fast
      t.values[0][k * 33 + 16 + 3 * k + 2] = 0;
    const auto d = fit_of(t, glossy);
    EXPECT_FALSE(d.misfit.too_few) << seed << d.misfit.note;
    accused += d.misfit.told;
    const auto& matte = test::parameter(d, "kd");
    EXPECT_EQ(matte.status[0], ParameterStatus::free) << seed;
    EXPECT_NEAR(matte.value[0], 0.02, 4e-4) << seed;
    EXPECT_TRUE(fit_of(t, "lambert").misfit.told) << seed;
  }
  EXPECT_LE(accused, 1) << "by chance";
}

}  // namespace
}  // namespace gonio
