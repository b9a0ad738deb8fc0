#include "scene/plan/budget.h"

#include <algorithm>
#include <limits>

#include "base/random.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

std::vector<Sharer> some_sharers(std::uint64_t seed, std::size_t materials, std::size_t choices) {
  Draws draw(seed, 1);
  std::vector<Sharer> all;
  for (std::size_t m = 0; m < materials; ++m) {
    Sharer s{draw.uniform(), {}};
    for (std::size_t i = 0; i < choices; ++i)
      s.choices.push_back({1 + 50 * draw.uniform(), 5 * draw.uniform()});
    all.push_back(std::move(s));
  }
  return all;
}

double mean_ns(const std::vector<Sharer>& all, const std::vector<std::size_t>& choice) {
  double ns = 0, covered = 0;
  for (std::size_t m = 0; m < all.size(); ++m) {
    ns += all[m].coverage * all[m].choices[choice[m]].ns;
    covered += all[m].coverage;
  }
  return ns / covered;
}

TEST(Budget, HasTheLeastWorstErrorOfAllWaysToShare) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto all = some_sharers(seed, 4, 5);
    const double budget = 25;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 625; ++i) {
      const std::vector<std::size_t> choice{i % 5, i / 5 % 5, i / 25 % 5, i / 125};
      if (mean_ns(all, choice) > budget) continue;
      double error = 0;
      for (std::size_t m = 0; m < 4; ++m) error = std::max(error, all[m].choices[choice[m]].error);
      least = std::min(least, error);
    }
    const auto s = share_out(all, budget);
    ASSERT_EQ(s.fits, least < std::numeric_limits<double>::infinity());
    if (!s.fits) continue;
    EXPECT_EQ(s.error, least);
    EXPECT_NEAR(s.ns, mean_ns(all, s.choice), 1e-12);
    EXPECT_LE(s.ns, budget);
  }
}

TEST(Budget, GivesWhatIsLeftToThoseWhoErrTooMuch) {
  const Sharer lost{0.5, {{1, 4.1}, {100, 0.2}}},
      saved{0.5, {{1, 1.4}, {2, 1.2}, {4, 0.9}, {9, 0.1}}};
  const double budget = 3;
  EXPECT_EQ(share_out({lost, saved}, budget).choice, (std::vector<std::size_t>{0, 0}));
  const auto s = share_out({lost, saved}, budget, 1);
  EXPECT_EQ(s.choice, (std::vector<std::size_t>{0, 2})) << "no more than is enough";
  EXPECT_EQ(s.ns, 2.5);
  EXPECT_EQ(s.error, 4.1);
  EXPECT_EQ(share_out({lost, saved}, 1.6, 1).choice, (std::vector<std::size_t>{0, 1}))
      << "the nearest that fits";
}

TEST(Budget, GivesWhatIsLeftToThoseWhoBreakTheToleranceByTheirWorstPoint) {
  const Sharer lost{0.5, {{1, 4.1}, {100, 0.2}}}, saved{0.5, {{1, 0.8, true}, {4, 0.9}}};
  EXPECT_EQ(share_out({lost, saved}, 3, 1).choice, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(share_out({lost, saved}, 2, 1).choice, (std::vector<std::size_t>{0, 0}))
      << "more than there is";
}

TEST(Budget, TakesTheLowestRankOfThoseThatAreAsFast) {
  const auto with = [](Choice second) {
    return std::vector<Sharer>{{0.5, {{1, 4.1}, {100, 0.2}}},
                               {0.5, {{1.27, 0.52, false, 0.04, 3}, second, {9, 0.1}}}};
  };
  const auto taken = [&](const Choice& second, double budget_ns = 3) {
    return share_out(with(second), budget_ns, 1).choice[1];
  };
  EXPECT_EQ(taken({1.28, 0.53, false, 0.04, 2}), 1U)
      << "it errs by more, but by no more than enough";
  EXPECT_EQ(taken({1.28, 0.53, false, 0.04, 4}), 0U);
  EXPECT_EQ(taken({1.28, 1.01, false, 0.04, 2}), 0U) << "it errs by too much";
  EXPECT_EQ(taken({1.28, 0.53, true, 0.04, 2}), 0U) << "it breaks the tolerance";
  EXPECT_EQ(taken({1.44, 0.53, false, 0.04, 2}), 0U) << "it is slower";
  EXPECT_EQ(taken({1.28, 0.53, false, 0.04, 2}, 1.137), 0U) << "it takes more than the budget";
  EXPECT_NEAR(share_out(with({1.28, 0.53, false, 0.04, 2}), 3, 1).ns, 1.14, 1e-12);
}

TEST(Budget, TakesTheCheapestWhereNothingFits) {
  const auto all = some_sharers(3, 3, 4);
  const auto s = share_out(all, 0.5);
  EXPECT_FALSE(s.fits);
  for (std::size_t m = 0; m < all.size(); ++m)
    for (const auto& c : all[m].choices) EXPECT_LE(all[m].choices[s.choice[m]].ns, c.ns);
}

TEST(Budget, IsNeverWorseThanTheSameTimeForEachMaterial) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto all = some_sharers(seed, 20, 30);
    constexpr double budget = 12;
    double each = 0;  // the worst error, each by itself within the budget
    bool possible = true;
    for (const auto& sharer : all) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& c : sharer.choices)
        if (c.ns <= budget) least = std::min(least, c.error);
      possible &= least < std::numeric_limits<double>::infinity();
      each = std::max(each, least);
    }
    if (possible) {
      EXPECT_LE(share_out(all, budget).error, each);
    }
  }
}

}  // namespace
}  // namespace gonio::scene
