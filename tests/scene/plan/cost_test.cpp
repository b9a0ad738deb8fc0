#include "scene/plan/cost.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

TEST(Cost, TakesTimesWithinTwiceTheirSpreadsForTheSame) {
  EXPECT_TRUE(are_too_near({10, 0.3}, {11.2, 0.3}));
  EXPECT_TRUE(are_too_near({11.2, 0.3}, {10, 0.3}));
  EXPECT_FALSE(are_too_near({10, 0.3}, {11.3, 0.3}));
  for (const double same : {1.0, 1.03, 0.97, 1.12, 1 / 1.12}) EXPECT_TRUE(is_as_fast(same)) << same;
  for (const double other : {1.14, 1 / 1.14, 3.0}) EXPECT_FALSE(is_as_fast(other)) << other;
}

}  // namespace
}  // namespace gonio::scene
