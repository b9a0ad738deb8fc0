#include "table/lookup.h"

#include <cmath>
#include <limits>

#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double reach = 5 * degree;

DirectionPair turned_pair(double theta_i_deg, double theta_o_deg, double phi_deg) {
  return {direction(theta_i_deg * degree, 0), direction(theta_o_deg * degree, phi_deg * degree)};
}

/// What a table says there, in its first channel.
double value(const Table& t, const DirectionPair& p) {
  return Lookup(t, reach)(p).mean_of(t.values[0]);
}

Table listed(DirectionList where) {
  return test::filled(std::move(where), test::glossy());
}

TEST(Lookup, OfAGridIsItsValueBetweenTheSamples) {
  for (const auto& grid : {test::half_difference_grid(), test::in_out_grid()}) {
    const Table t = test::filled(grid, test::glossy());
    const Interpolator between(t);
    for (const auto& p :
         {turned_pair(20, 25, 170), turned_pair(45, 45, 180), turned_pair(5, 60, 30)})
      EXPECT_NEAR(value(t, p), between(p, 0), 1e-12);
  }
}

TEST(Lookup, OfAGridSaysNothingWhereHalfOfTheWeightHasNoValueInAnyChannel) {
  Table t = test::filled(test::in_out_grid(), test::glossy());
  const std::size_t sample = (3 * 17 + 6) * 13 + 6;  // 30°, 30°, 90°
  t.values[2][sample] = none;
  EXPECT_TRUE(std::isnan(value(t, turned_pair(30, 30, 90))));
  EXPECT_TRUE(std::isnan(value(t, turned_pair(31, 30, 90))));
  EXPECT_TRUE(std::isfinite(value(t, turned_pair(36, 30, 90))));
  EXPECT_TRUE(
      std::isfinite(Interpolator(t)(turned_pair(30, 30, 90), 0)));  // the first channel alone
}

// phi_d past the horizon: of a cell there only what is above it can have a value
TEST(Lookup, OfAGridTakesWhatIsAboveTheHorizonBesideIt) {
  const Table t = test::filled(test::half_difference_grid(9), test::glossy());
  std::size_t beside = 0;
  for (double phi = 0; phi < 180; phi += 1) {
    const auto p = turned_pair(88.5, 60, phi);
    const double found = value(t, p);
    beside += std::isfinite(found) && std::isnan(Interpolator(t)(p, 0));
  }
  EXPECT_GT(beside, 0U);
}

TEST(Lookup, OfAGridThatEndsEarlySaysNothingBeyondItsReach) {
  const Table t = test::filled(test::in_out_grid(), test::glossy());  // up to 80°
  EXPECT_TRUE(std::isfinite(value(t, turned_pair(84, 30, 90))));
  EXPECT_TRUE(std::isnan(value(t, turned_pair(86, 30, 90))));
  EXPECT_TRUE(std::isnan(value(t, turned_pair(30, 86, 90))));
}

TEST(Lookup, OfASliceSpeaksForItsOwnAzimuth) {
  using enum Axis::Spacing;
  const Grid slice{Grid::Kind::half_difference,
                   {Axis{"theta_h", uniform, 45, test::right_angle},
                    Axis{"theta_d", uniform, 45, test::right_angle},
                    Axis{"phi_d", constant, 1, test::right_angle}}};
  const Table t = test::filled(slice, test::glossy());
  const auto at = [](double theta_d_deg, double phi_d_deg) {
    return directions(HalfDifference{30 * degree, 0, theta_d_deg * degree, phi_d_deg * degree});
  };
  for (const double phi_d : {90.0, -90.0, 80.0, -97.0}) {
    EXPECT_TRUE(std::isfinite(value(t, at(25, phi_d)))) << phi_d;
    EXPECT_TRUE(std::isfinite(value(t, swapped(at(25, phi_d))))) << phi_d;
  }
  for (const double phi_d : {0.0, 60.0, 120.0, 180.0, -60.0})
    EXPECT_TRUE(std::isnan(value(t, at(25, phi_d)))) << phi_d;
  EXPECT_TRUE(std::isfinite(value(t, at(2, 0))));  // light and viewer are that close
}

TEST(Lookup, OfAListIsItsNearestSampleMirroredOrSwapped) {
  const Table t = listed({{30, 30}, {0, 0}, {50, 57}, {60, 60}});
  EXPECT_EQ(value(t, turned_pair(31, 52, 61)), t.values[0][0]);
  EXPECT_EQ(value(t, turned_pair(31, 56, 61)), t.values[0][1]);
  EXPECT_EQ(value(t, mirrored(turned_pair(31, 52, 61))), t.values[0][0]);
  EXPECT_EQ(value(t, swapped(turned_pair(31, 56, 61))), t.values[0][1]);
  EXPECT_TRUE(std::isnan(value(t, turned_pair(30, 50, 75))));
}

TEST(Lookup, OfAListTakesTheNearerOfBothWays) {
  const Table t = listed({{30, 53.5}, {0, 0}, {50, 30}, {60, 60}});
  EXPECT_EQ(value(t, turned_pair(30, 50.5, 60)), t.values[0][0]);
  EXPECT_EQ(value(t, turned_pair(30, 53, 60)), t.values[0][1]);
}

TEST(Lookup, OfAListTakesNoSampleThatAChannelMasks) {
  Table t = listed({{30, 30}, {0, 0}, {50, 53}, {60, 60}});
  t.values[1][0] = -1;
  EXPECT_EQ(value(t, turned_pair(30, 50, 60)), t.values[0][1]);
  t.values[2][1] = none;
  EXPECT_TRUE(std::isnan(value(t, turned_pair(30, 50, 60))));
}

}  // namespace
}  // namespace gonio
