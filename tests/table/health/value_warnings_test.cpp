// Values that are no f in 1/sr are said to be what they are, and those that are f are left alone.
#include "table/health/value_warnings.h"

#include <cmath>
#include <random>

#include "table/paint.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

TEST(ValueWarnings, SayNothingOfAPaint) {
  for (const double turn : {0.0, 180.0, 360.0})
    EXPECT_TRUE(said_of(painted(turn), as_it_is).empty())
        << turn << " " << said_of(painted(turn), as_it_is)[0];
  EXPECT_TRUE(said_of(painted(180, 0.01, 0.15), as_it_is).empty());
}

TEST(ValueWarnings, TellAChannelThatIsNegativeByItselfFromANoiseFloor) {
  const auto table = [](bool one, double noise) {
    Table t = painted(180, 0.01, 0.1);
    t.channels = {"r", "g", "b"};
    t.values.resize(3, t.values[0]);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (std::size_t c = 0; c < 3; ++c)
      for (double& v : t.values[c])
        v = v * std::exp(0.01 * normal(random)) + noise * normal(random) -
            (one && c == 0 ? 0.005
             : c > 0       ? -0.01
                           : 0);
    return t;
  };
  const Table gamut = table(true, 0);
  TableFacts facts(gamut);
  EXPECT_TRUE(std::ranges::any_of(value_warnings(facts), [](const ValueWarning& w) {
    return w.text.starts_with("all negative values are of channel r");
  }));
  EXPECT_EQ(facts.negative_channel(), std::size_t{0});
  EXPECT_EQ(facts.noise_floor(), 0);
  const Table dark = table(false, 0.004);
  EXPECT_FALSE(TableFacts(dark).negative_channel());
  EXPECT_GT(noise_floor(dark), 0);
}

TEST(ValueWarnings, TellAChannelOfAScaleOfItsOwnFromADarkColour) {
  // A blue whose diffuse light is next to nothing beside the highlight's, and one that was read in
  // another unit.
  const auto said = [](double kd, double scale) {
    Table t = painted(180, kd, 0.1);
    t.channels = {"r", "g", "b"};
    const Values red = painted(180, 0.3, 0.1).values[0];
    t.values = {red, red, t.values[0]};
    for (double& v : t.values[2]) v *= scale;
    TableFacts facts(t);
    std::vector<std::string> texts;
    for (const auto& w : value_warnings(facts)) texts.push_back(w.text);
    return says(texts, "channel b holds at most");
  };
  EXPECT_FALSE(said(0.3, 1));
  EXPECT_FALSE(said(1e-4, 1));
  EXPECT_TRUE(said(0.3, 1e-3));
  EXPECT_TRUE(said(0.3, 3e-3));
  EXPECT_FALSE(said(0.3, 0.02));
}

TEST(Uncertainties, FarBelowTheOthersAreNamed) {
  Table t = painted(360);
  const auto said = [&] {
    TableFacts facts(t);
    const auto all = value_warnings(facts);
    return std::ranges::any_of(
        all, [](const ValueWarning& w) { return w.text.find("stated uncert") != w.text.npos; });
  };
  // Twice a part of the value, and once the same for all, though the highlight is then far surer.
  for (const double of_value : {0.02, 0.3, 0.0}) {
    t.errors = t.values;
    for (double& u : t.errors[0]) u = of_value > 0 ? of_value * u : 1e-3;
    EXPECT_FALSE(said()) << of_value;
    t.errors[0][16] = 1e-9;
    EXPECT_TRUE(said()) << of_value;
  }
}

/// Zenith angles, of light or viewer or both, as elevations above the surface.
TEST(ValueWarnings, TellAnOffsetBelowZeroFromNoise) {
  const auto said = [](double offset, double noise) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    return said_of(painted(180, 0.05, 0.15), [&](const auto&, double f) {
      return f * std::exp(0.01 * normal(random)) + noise * normal(random) - offset;
    });
  };
  EXPECT_TRUE(says(said(0.018, 0), "rather an offset than noise"));
  EXPECT_FALSE(says(said(0.018, 0.01), "rather an offset than noise"));
  EXPECT_FALSE(says(said(0, 0.02), "rather an offset than noise"));
}

}  // namespace
}  // namespace gonio
