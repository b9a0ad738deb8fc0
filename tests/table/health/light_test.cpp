// Tables that return more light than arrives are said to, and those that do not are left alone.
#include "table/health/light.h"

#include <random>

#include "table/format/measured_by.h"
#include "table/paint.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

TEST(ValueWarnings, SayThatMoreLightLeavesThanArrivesHoweverFarRoundTheSamplesGo) {
  for (const double turn : {180.0, 360.0})
    EXPECT_TRUE(says(said_of(painted(turn), [](const auto&, double f) { return 3 * M_PI * f; }),
                     "times the light at theta_i"))
        << turn;
  EXPECT_TRUE(
      says(said_of(painted(0, 0.6), [](const auto&, double f) { return M_PI * f; }), "probably"));
  EXPECT_TRUE(says(said_of(painted(180, 0.6), [](const auto&, double f) { return M_PI * f; }),
                   "a radiance factor? (gonio columns FILE --scale 0.3183099)"));
  EXPECT_TRUE(says(said_of(painted(180), [](const auto&, double f) { return 100 * M_PI * f; }),
                   "in percent? (gonio columns FILE --scale 0.003183099)"));
  EXPECT_TRUE(says(said_of(painted(0, 0.02), [](const auto&, double f) { return 100 * M_PI * f; }),
                   "in percent?"))
      << "a black paint in one plane";
  EXPECT_TRUE(
      says(said_of(painted(180), [](const auto&, double f) { return 1e5 * f; }), "counts?"));
  EXPECT_TRUE(says(said_of(painted(180), [](const auto&, double f) { return 1e-4 * f; }),
                   "relative scale?"));
}

TEST(ValueWarnings, SayThatMoreLightLeavesThanArrivesWhereNoDirectionRepeats) {
  Table t = painted(180);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> apart(0, 1e-3);
  auto& list = std::get<DirectionList>(t.where);
  for (auto& theta : list.theta_i_deg) theta += apart(random);
  EXPECT_TRUE(said_of(t, [](const auto&, double f) { return f; }).empty());
  EXPECT_TRUE(says(said_of(t, [](const auto&, double f) { return 1e5 * f; }), "counts?"));
}

TEST(ValueWarnings, NameTheReferenceOfValuesInPercentOfATarget) {
  Table t = painted(180);
  for (double& f : t.values[0])
    f *= 100 * M_PI / 0.99;  // what a target of 0.99 is worth, in percent
  take_reference(t, 0.99);
  EXPECT_TRUE(
      says(said_of(t, as_it_is), "in percent of the target? (gonio fit FILE --reference 0.0099)"));
  EXPECT_FALSE(says(said_of(t, as_it_is), "--scale"));
}

TEST(ValueWarnings, BlameNoBrightMirrorForItsNarrowHighlight) {
  for (const double alpha : {0.01, 0.02, 0.05}) {
    Table t = painted(360, 0, alpha);
    test::put_values(
        t, bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1));
    EXPECT_FALSE(says(said_of(t, as_it_is), "the light")) << alpha;
  }
}

TEST(ValueWarnings, NameTheOnlyChannelWithAnotherScale) {
  const auto said = [](std::array<double, 3> scale) {
    Table t = painted(180, 0.1);
    t.channels = {"r", "g", "b"};
    t.values.resize(3, t.values[0]);
    for (std::size_t c = 0; c < 3; ++c)
      for (double& f : t.values[c]) f *= scale[c];
    return said_of(t, as_it_is);
  };
  EXPECT_TRUE(says(said({1, 100, 1}), "channel g returns"));
  EXPECT_TRUE(says(said({1, 100, 1}), "(gonio fit FILE --channels r b leaves it out)"));
  EXPECT_FALSE(says(said({100, 100, 100}), "channel"));
  EXPECT_FALSE(says(said({20, 2, 2}), "channel")) << "a red pigment in other units";
  EXPECT_TRUE(says(said({1, 0, 1}), "no value of channel g is above 0"));
}

}  // namespace
}  // namespace gonio
