#include "scene/plan/difference.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

TEST(Differences, AreThoseOfDisplayColours) {
  const std::vector<Rgb> white{{1, 1, 1}}, grey{{0.5, 0.5, 0.5}};
  // L* of half the light is 76.07; ΔE2000 = ΔL/S_L, S_L = 1 + 0.015 d²/√(20 + d²), d = 88.03 − 50
  EXPECT_NEAR(differences(Metric::delta_e_2000, 1, white, grey)[0], 15.275, 0.005);
  EXPECT_EQ(differences(Metric::delta_e_2000, 1, white, white)[0], 0);
}

TEST(Differences, SeeNothingBeyondWhite) {
  const std::vector<Rgb> bright{{4, 4, 4}}, brighter{{9, 5, 7}};
  EXPECT_EQ(differences(Metric::delta_e_2000, 1, bright, brighter)[0], 0);
  EXPECT_GT(differences(Metric::delta_e_2000, 0.1, bright, brighter)[0], 5);
}

TEST(Differences, RelativeAreTheLargestOfTheChannels) {
  const std::vector<Rgb> a{{1, 2, 0}}, b{{1.1, 1.5, 0}}, c{{1, 2, 1e-9}};
  EXPECT_NEAR(differences(Metric::relative, 1, a, b)[0], 0.25, 1e-12);
  EXPECT_EQ(differences(Metric::relative, 1, a, c)[0], 1);
}

TEST(Judgement, CountsWhatIsBeyondTheLimit) {
  std::vector<double> values(1000, 0.2);
  values[7] = 1.5;
  values[9] = 3;
  const auto j = judge(values, Tolerance{});
  EXPECT_EQ(j.samples, 1000U);
  EXPECT_EQ(j.exceeding, 2U);
  EXPECT_EQ(j.worst, 3);
  EXPECT_EQ(j.quantile, 0.2);
  EXPECT_TRUE(j.keeps(Tolerance{}));
  EXPECT_FALSE(j.keeps({.max = 2}));
  values.assign(1000, 0.2);
  std::fill_n(values.begin(), 8, 1.5);
  EXPECT_FALSE(judge(values, Tolerance{}).keeps(Tolerance{}));  // 99.2 % of 1000 prove no 99 %
}

TEST(Judgement, BreaksATolerancesQuantileOnlyByMorePointsThanThatLeaves) {
  const auto with = [](std::size_t exceeding) {
    std::vector<double> values(1000, 0.2);
    std::fill_n(values.begin(), exceeding, 1.5);
    return judge(values, Tolerance{});
  };
  EXPECT_FALSE(with(8).holds(Tolerance{}));
  EXPECT_FALSE(with(8).breaks(Tolerance{})) << "too few points to show either";
  EXPECT_TRUE(with(11).breaks(Tolerance{}));
  EXPECT_TRUE(with(8).breaks({.max = 1.4}));
  EXPECT_FALSE(with(2).breaks(Tolerance{}));
}

TEST(Margin, IsTakenByTheWorstPointOrByTheShareBeyondTheLimit) {
  const Margin m{0.0075, 3.6};
  Judgement j;
  j.bound = 0.015, j.worst = 5.4;
  EXPECT_FALSE(m.is_kept(j));
  EXPECT_DOUBLE_EQ(m.taken(j), 2);
  EXPECT_FALSE(m.is_taken_by_worst(j)) << "which takes 1.5 of it";
  j.worst = 10.8;
  EXPECT_DOUBLE_EQ(m.taken(j), 3);
  EXPECT_TRUE(m.is_taken_by_worst(j));
  j.bound = 0.0075, j.worst = 3.6;
  EXPECT_TRUE(m.is_kept(j));
  j.worst = 3.7;
  EXPECT_FALSE(m.is_kept(j));
  j.worst = 0;
  EXPECT_TRUE((Margin{0.0075, 0}).is_kept(j));
  EXPECT_DOUBLE_EQ((Margin{0.0075, 0}).taken(j), 1);
}

}  // namespace
}  // namespace gonio::scene
