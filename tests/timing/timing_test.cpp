#include "timing/timing.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Timing, IsTheMedianAndHalfTheDistanceOfTheQuartiles) {
  const auto t = spread_of({9, 1, 5, 3, 100});
  EXPECT_EQ(t.ns, 5);
  EXPECT_EQ(t.spread_ns, 3);
  EXPECT_EQ(spread_of({7}).ns, 7);
  EXPECT_EQ(spread_of({7}).spread_ns, 0);
}

TEST(Timing, ADifferenceCarriesBothSpreads) {
  const auto one_process = difference({{2, 0.3}}, {{9, 0.4}});
  EXPECT_DOUBLE_EQ(one_process.ns, 7);
  EXPECT_DOUBLE_EQ(one_process.spread_ns, 0.5);
  EXPECT_TRUE(one_process.survives);
  EXPECT_FALSE(difference({{2, 0.3}}, {{2.6, 0.4}}).survives);
}

TEST(Timing, ADifferenceSurvivesWhereEveryProcessFindsIt) {
  const std::vector<double> from{1, 4, 2, 8, 3}, to{1.5, 4.4, 2.6, 8.5, 3.5},
      but_one{1.5, 3.9, 2.6, 8.5, 3.5};
  const auto found = difference({{3, 2}, from}, {{3.5, 2}, to});
  EXPECT_NEAR(found.ns, 0.5, 1e-12);
  EXPECT_NEAR(found.spread_ns, 0, 1e-12);  // though the processes themselves differ
  EXPECT_TRUE(found.survives);
  EXPECT_FALSE(difference({{3, 2}, from}, {{3.5, 2}, but_one}).survives);
  EXPECT_FALSE(difference({{30, 2}, from}, {{30.5, 2}, to}).survives);  // 2 % are not told
}

TEST(Timing, IsOfOneSample) {
  volatile double x = 1;
  const auto work = [&] {
    for (int i = 0; i < 1000; ++i) x = x + 1;
  };
  const auto t = time_all({{1000, work}, {1, work}}, {5, 1e-4, true});
  ASSERT_EQ(t.size(), 2U);
  EXPECT_GT(t[0].ns, 0);
  EXPECT_GE(t[0].spread_ns, 0);
  EXPECT_GT(t[1].ns, 30 * t[0].ns);  // a thousand times as long, whatever disturbs it
}

TEST(Timing, RunsEachThingAndSaysHowFarItIs) {
  std::vector<int> times(3);
  std::vector<double> done;
  std::vector<Timed> things;
  for (std::size_t i = 0; i < 3; ++i) things.push_back({1, [&times, i] { ++times[i]; }});
  time_all(things, {4, 1e-9, true}, [&](double x) { done.push_back(x); });
  for (const int n : times) EXPECT_GE(n, 4);
  ASSERT_FALSE(done.empty());
  EXPECT_TRUE(std::ranges::is_sorted(done));
  EXPECT_GE(done.front(), 0);
  EXPECT_LE(done.back(), 1);
  EXPECT_GT(done.back(), 0.5);
}

TEST(Timing, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  time_all({{1, [] {}}}, {2, 1e-9, false});
  EXPECT_TRUE(time_all({}).empty());
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Timing, LeavesNothingBehindWhenAThingThrows) {
  EXPECT_THROW(time_all({{1, [] { throw 1; }}}, {2, 1e-9, false}), int);
  EXPECT_EQ(time_all({{1, [] {}}}, {2, 1e-9, false}).size(), 1U);
}

}  // namespace
}  // namespace gonio
