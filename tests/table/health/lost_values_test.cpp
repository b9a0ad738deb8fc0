// Values that noise, digits or a full detector took away are named, and those that were measured
// are left alone.
#include "table/health/lost_values.h"

#include <cmath>
#include <random>

#include "table/paint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

TEST(ValueWarnings, SayThatValuesAreRoundedCoarsely) {
  const auto rounded = [](double step) {
    return said_of(painted(180),
                   [=](const auto&, double f) { return step * std::round(f / step); });
  };
  EXPECT_TRUE(says(rounded(0.01), "rounded to steps of 0.01 1/sr, typically 2.9 % of a value"));
  EXPECT_TRUE(rounded(0.001).empty());
  const auto one_digit = [](const auto&, double f) {
    const double place = std::pow(10, std::floor(std::log10(f)));
    return place * std::round(f / place);
  };
  EXPECT_TRUE(says(said_of(painted(180, 0.1, 0.15), one_digit), "1 significant digit,"));
}

TEST(ValueWarnings, SayThatZerosAreLeftOut) {
  const auto clipped =
      said_of(painted(180, 0.05), [](const auto& a, double f) { return a.nov < 0.3 ? 0 : f; });
  EXPECT_TRUE(says(clipped, "values are 0, shadow or clipped noise, which biases every metric"));
  const auto rounded = said_of(painted(180, 0.005, 0.15),
                               [](const auto&, double f) { return std::round(f * 1000) / 1000; });
  EXPECT_TRUE(says(rounded, "values are rounded to one digit or to 0"));
  const auto nearly_all = said_of(painted(180, 0.005, 0.3),
                                  [](const auto&, double f) { return std::round(f * 100) / 100; });
  EXPECT_TRUE(says(nearly_all, "values are rounded to one digit or to 0"));
  EXPECT_FALSE(says(nearly_all, "clipped"));
}

TEST(ValueWarnings, KnowHowLargeValuesAreThatNoiseTookAway) {
  const Table clean = painted(180, 0.005, 0.15);
  TableFacts of_clean(clean);
  EXPECT_EQ(lost_below(of_clean), std::vector<double>{0});
  Table clipped = clean, rounded = clean;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (double& f : clipped.values[0]) f = std::max(f + 0.003 * normal(random), 0.0);
  for (double& f : rounded.values[0]) f = std::round(f * 100) / 100;
  TableFacts of_clipped(clipped), of_rounded(rounded);
  EXPECT_GT(lost_below(of_clipped)[0], 0.002);
  EXPECT_LT(lost_below(of_clipped)[0], 0.008);
  EXPECT_NEAR(lost_below(of_rounded)[0], 0.005, 1e-6);
  EXPECT_FALSE(is_clipped(of_clean));
  EXPECT_TRUE(is_clipped(of_clipped));
  EXPECT_FALSE(is_clipped(of_rounded));
}

TEST(ValueWarnings, TakeZerosBetweenSmoothValuesForMarks) {
  Table t = painted(180, 0.1, 0.3);
  std::mt19937 random(1);
  for (auto& v : t.values[0])
    if (random() % 20 == 0) v = 0;
  TableFacts facts(t);
  EXPECT_EQ(lost_below(facts), std::vector<double>{0});
}

TEST(ValueWarnings, TakeAValueFarBelowAllOthersForAMarkThoughTheOthersFallByMuch) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto all = said_of(painted(180, 0.002, 0.35), [&](const auto&, double f) {
    return uniform(random) < 0.3 ? 1e-9 : f * std::exp(0.01 * normal(random));
  });
  EXPECT_TRUE(says(all, "a mark for missing data?"));
  EXPECT_FALSE(says(all, "clipped noise?"));
}

TEST(ValueWarnings, KnowWhichChannelNoiseTookValuesFrom) {
  for (const bool clipped : {false, true}) {
    Table t = painted(180, 0.005, 0.15);
    t.channels = {"r", "g", "b"};
    t.values.resize(3, t.values[0]);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (double& f : t.values[2]) {
      f += 0.003 * normal(random);
      if (clipped) f = std::max(f, 0.0);
    }
    TableFacts facts(t);
    const auto lost = lost_below(facts);
    EXPECT_EQ(lost[0], 0);
    EXPECT_EQ(lost[1], 0);
    EXPECT_GT(lost[2], 0.0015);
    EXPECT_FALSE(facts.negative_channel()) << "noise is no gamut";
    EXPECT_EQ(facts.noise_floor() > 0, !clipped);
  }
}

TEST(ValueWarnings, SayThatADetectorWasFull) {
  const auto said = said_of(painted(180), [](const auto&, double f) { return std::min(f, 0.12); });
  EXPECT_TRUE(says(said, "values of channel f are 0.12, and none is more: a full detector?"));
  EXPECT_TRUE(says(said, "(--mask 'f >= 0.12' leaves them out)"));
  // Few in each channel, but of one detector.
  Table t = painted(180);
  t.channels = {"r", "g", "b"};
  t.values.resize(3, t.values[0]);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto three = said_of(t, [&](const auto&, double f) {
    return std::min(f * std::exp(0.01 * normal(random)), 0.33);
  });
  EXPECT_TRUE(says(three, "values of channel r, g, b are 0.33, and none is more"));
  EXPECT_TRUE(says(three, "(--mask 'f_r >= 0.33 or f_g >= 0.33 or f_b >= 0.33' leaves them out)"));
  // A spectrum has thousands of channels: a sentence lists a few.
  Table many = painted(180);
  many.channels.clear();
  for (int c = 0; c < 1000; ++c)
    many.channels.push_back("a channel of a long name " + std::to_string(c));
  many.values.resize(1000, many.values[0]);
  for (const auto& sentence :
       said_of(many, [](const auto&, double f) { return std::min(f, 0.12); }))
    EXPECT_LT(sentence.size(), 1500U) << sentence;
  // Short numbers are shared by many samples, the greatest by no more than others.
  EXPECT_FALSE(
      says(said_of(painted(180), [](const auto&, double f) { return std::round(f * 100) / 100; }),
           "full detector"));
  EXPECT_FALSE(says(said_of(painted(180), [](const auto&, double) { return 0.2; }), "detector"));
  // Below 0.1 the second digit is ten times as fine.
  std::mt19937_64 digits(1);
  EXPECT_FALSE(says(said_of(painted(180),
                            [&](const auto&, double) {
                              const double f = 0.0995 * std::exp(0.005 * normal(digits));
                              return std::stod(fmt::format("{:.2g}", f));
                            }),
                    "detector"));
}

TEST(ValueWarnings, SayThatNoiseWasClippedToALeastValue) {
  const auto said = [](double noise, double least) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    return said_of(painted(180, 0.002, 0.15), [&](const auto&, double f) {
      return std::max(f + noise * normal(random), least);
    });
  };
  EXPECT_TRUE(says(said(0.002, 1e-4),
                   "are 0.0001, and none is less: clipped noise? It biases every metric"));
  EXPECT_FALSE(says(said(0, 1e-4), "clipped noise?"));
  Table matt = painted(0);  // in plane, and computed: its base is shared
  test::put_values(matt, bind_model("oren_nayar", {{"kd", {0.5}}, {"sigma", {0.5}}}, 1));
  EXPECT_FALSE(says(said_of(matt, as_it_is), "clipped noise?"));
  // Nor is that of a narrow highlight, beside whose slope are few values.
  Table narrow = painted(180);
  test::put_values(narrow, bind_model("lambert+beckmann/smith_beckmann.correlated/schlick",
                                      {{"kd", {0.1}}, {"alpha", {0.03}}, {"f0", {0.5}}}, 1));
  EXPECT_FALSE(says(said_of(narrow, as_it_is), "clipped noise?"));
  // Far from a computed highlight all values may be those of its base.
  EXPECT_FALSE(says(said_of(painted(180), [](const auto&, double f) { return std::max(f, 0.1); }),
                    "clipped noise?"));
}

}  // namespace
}  // namespace gonio
