// Angles counted from the surface are named, and no surface is taken for them.
#include "table/health/elevation.h"

#include <cmath>

#include "table/paint.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

TEST(ValueWarnings, TakeNoMatteSurfaceTimesBothCosinesForElevations) {
  for (const double turn : {0.0, 180.0}) {
    const auto matte = as_painted(turn, 4, "oren_nayar", {{"kd", {0.5}}, {"sigma", {0.5}}});
    const auto all = said_of(matte, [](const auto& a, double f) { return f * a.nol * a.nov; });
    EXPECT_TRUE(says(all, "f cos(theta_i) cos(theta_o) (gonio columns FILE --cosines=1,1)"))
        << turn;
    EXPECT_FALSE(says(all, "90-theta")) << turn;
  }
}

Table as_elevations(Table t, bool incident, bool outgoing) {
  auto& l = std::get<DirectionList>(t.where);
  for (auto& [theta, turns] : {std::pair(&l.theta_i_deg, incident), {&l.theta_o_deg, outgoing}})
    if (turns)
      for (double& deg : *theta) deg = 90 - deg;
  return t;
}

TEST(ValueWarnings, SayThatZenithAnglesAreElevations) {
  for (const double alpha : {0.1, 0.2, 0.4}) {
    const Table t = painted(180, 0.1, alpha, 4);
    EXPECT_TRUE(
        says(said_of(as_elevations(t, true, true), as_it_is), "are zenith angles elevations?"))
        << alpha;
    EXPECT_TRUE(says(said_of(as_elevations(t, false, true), as_it_is), "is theta_o an elevation?"))
        << alpha;
    EXPECT_TRUE(says(said_of(as_elevations(t, true, false), as_it_is), "is theta_i an elevation?"))
        << alpha;
    for (const double kd : {0.0, 0.02, 0.6})
      for (const double turn : {0.0, 180.0})
        EXPECT_FALSE(says(said_of(painted(turn, kd, alpha, 4), as_it_is), "elevation"))
            << alpha << " " << kd;
  }
}

}  // namespace
}  // namespace gonio
