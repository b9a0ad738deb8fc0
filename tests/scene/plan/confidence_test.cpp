#include "scene/plan/confidence.h"

#include <cmath>
#include <limits>

#include "base/random.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

TEST(Confidence, OfNoneBeyondIsInClosedForm) {
  for (const std::size_t n : {1U, 10U, 4096U})
    EXPECT_NEAR(exceedance_bound(0, n, 0.95), 1 - std::pow(0.05, 1.0 / static_cast<double>(n)),
                1e-12);
  EXPECT_EQ(exceedance_bound(5, 5, 0.95), 1);
}

TEST(Confidence, BoundsAShareFromBelowAsTheRestFromAbove) {
  EXPECT_EQ(exceedance_lower_bound(0, 50, 0.95), 0);
  EXPECT_NEAR(exceedance_lower_bound(50, 50, 0.95), std::pow(0.05, 1.0 / 50), 1e-12);
  EXPECT_LT(exceedance_lower_bound(5, 500, 0.95), 0.01);
  EXPECT_GT(exceedance_lower_bound(5, 500, 0.95), 0.003);
}

TEST(Confidence, BoundsAShareAsOftenAsItSays) {
  constexpr double share = 0.02;
  constexpr std::size_t n = 300, runs = 4000;
  std::size_t held = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    Draws draw(3, run);
    std::size_t exceeding = 0;
    for (std::size_t i = 0; i < n; ++i) exceeding += draw.uniform() < share;
    held += exceedance_bound(exceeding, n, 0.9) > share;
  }
  // at least 90 %, less three standard errors; a bound of half the size would hold in 60 %
  EXPECT_GT(static_cast<double>(held) / runs, 0.9 - 3 * std::sqrt(0.09 / runs));
  EXPECT_LT(static_cast<double>(held) / runs, 0.96);
}

TEST(Confidence, BoundsAQuantileAsOftenAsItSays) {
  constexpr std::size_t n = 500, runs = 4000;
  std::size_t held = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    Draws draw(4, run);
    std::vector<double> values(n);
    for (auto& v : values) v = draw.uniform();
    held += quantile_bound(values, 0.97, 0.95) > 0.97;
  }
  EXPECT_GT(static_cast<double>(held) / runs, 0.95 - 3 * std::sqrt(0.0475 / runs));
  EXPECT_LT(static_cast<double>(held) / runs, 0.985);
}

TEST(Confidence, HasNoBoundOfAQuantileFromTooFew) {
  std::vector<double> few(100, 0.0), enough(299, 0.0);
  EXPECT_EQ(quantile_bound(few, 0.99, 0.95), std::numeric_limits<double>::infinity());
  EXPECT_EQ(quantile_bound(enough, 0.99, 0.95), 0);  // 0.99^299 < 0.05 < 0.99^298
  enough.pop_back();
  EXPECT_EQ(quantile_bound(enough, 0.99, 0.95), std::numeric_limits<double>::infinity());
}

TEST(Confidence, AgreesBetweenQuantilesAndShares) {
  // The quantile's bound keeps a limit exactly where the bound of the share beyond it does.
  for (const std::size_t beyond :
       {100U, 136U, 137U, 138U, 139U, 140U, 141U, 142U, 143U, 144U, 150U, 164U}) {
    constexpr std::size_t n = 16'384;
    std::vector<double> values(n, 0.0);
    std::fill_n(values.begin(), beyond, 2.0);
    EXPECT_EQ(quantile_bound(values, 0.99, 0.95) <= 1, exceedance_bound(beyond, n, 0.95) <= 0.01)
        << beyond;
  }
}

TEST(Confidence, TellsTheShareThatAVerificationPasses) {
  constexpr std::size_t n = 2000;
  const double share = share_that_passes(0.99, n, 0.95);
  EXPECT_GT(share, 0.002);
  EXPECT_LT(share, 0.01);
  std::size_t passed = 0;
  constexpr std::size_t runs = 3000;
  for (std::size_t run = 0; run < runs; ++run) {
    Draws draw(5, run);
    std::size_t exceeding = 0;
    for (std::size_t i = 0; i < n; ++i) exceeding += draw.uniform() < share;
    passed += exceedance_bound(exceeding, n, 0.95) <= 0.01;
  }
  EXPECT_NEAR(static_cast<double>(passed) / runs, 0.95, 0.015);
  EXPECT_EQ(share_that_passes(0.99, 100, 0.95), 0);
}

}  // namespace
}  // namespace gonio::scene
