#include "table/nearest_sample.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

DirectionPair pair(double theta_i_deg, double theta_o_deg, double phi_deg, double turn_deg = 0) {
  return {direction(theta_i_deg * degree, turn_deg * degree),
          direction(theta_o_deg * degree, (turn_deg + phi_deg) * degree)};
}

TEST(NearestSample, IsTheNearestWithinReachHoweverTheSurfaceIsTurned) {
  NearestSample nearest(5 * degree);
  nearest.add(pair(30, 30, 180), 0);
  nearest.add(pair(30, 36, 180, 77), 1);
  for (const double turn : {0.0, 50.0, 200.0}) {
    EXPECT_EQ(nearest(pair(31, 31, 180, turn)), 0U);
    EXPECT_EQ(nearest(pair(30, 34, 179, turn)), 1U);
    EXPECT_EQ(nearest(pair(30, 42, 180, turn)), std::nullopt);
    EXPECT_EQ(nearest(pair(36, 30, 180, turn)), std::nullopt);
    EXPECT_EQ(nearest(pair(30, 30, 150, turn)), std::nullopt);
  }
}

TEST(NearestSample, KnowsWhatWasAddedAndNotItsMirrorImage) {
  NearestSample nearest(2 * degree);
  nearest.add(pair(30, 50, 60), 3);
  EXPECT_EQ(nearest(pair(30, 50, 60)), 3U);
  EXPECT_EQ(nearest(mirrored(pair(30, 50, 60))), std::nullopt);
  EXPECT_EQ(nearest(swapped(pair(30, 50, 60))), std::nullopt);
}

}  // namespace
}  // namespace gonio
