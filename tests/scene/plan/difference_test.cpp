#include "scene/plan/difference.h"

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

}  // namespace
}  // namespace gonio::scene
