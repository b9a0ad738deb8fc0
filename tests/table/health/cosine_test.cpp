// A cosine left in is named, and surfaces that fall like one are left alone.
#include "table/health/cosine.h"

#include <cmath>
#include <random>

#include "table/paint.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

TEST(ValueWarnings, SayWhichCosineIsLeftIn) {
  const auto said = [](double incident, double outgoing) {
    return said_of(painted(180), [=](const auto& a, double f) {
      return f * std::pow(a.nol, incident) * std::pow(a.nov, outgoing);
    });
  };
  EXPECT_TRUE(says(said(0, 1), "they look like f cos(theta_o) (gonio columns FILE --cosine)"));
  EXPECT_TRUE(says(said(1, 0), "they look like f cos(theta_i)"));
  EXPECT_TRUE(
      says(said(-1, 0), "they look like f/cos(theta_i) (gonio columns FILE --cosines=-1,0)"));
  EXPECT_TRUE(says(said(0, -1), "they look like f/cos(theta_o)"));
  EXPECT_TRUE(says(said(1, 1), "probably they are f cos(theta_i) cos(theta_o)"));
}

TEST(ValueWarnings, SayWhichCosineIsLeftInWhereNoSampleHasAPartner) {
  const auto said = [](double incident, double outgoing) {
    const auto change = [=](const auto& a, double f) {
      return f * std::pow(a.nol, incident) * std::pow(a.nov, outgoing);
    };
    return said_of(painted(180, 0.3, 0.3, 4), change);
  };
  EXPECT_TRUE(said(0, 0).empty());
  EXPECT_TRUE(says(said(0, 1), "they look like f cos(theta_o) (gonio columns FILE --cosine)"));
  EXPECT_TRUE(says(said(1, 0), "they look like f cos(theta_i)"));
  EXPECT_TRUE(says(said(-1, 0), "they look like f/cos(theta_i)"));
  EXPECT_TRUE(says(said(0, -1), "they look like f/cos(theta_o)"));
  EXPECT_FALSE(says(said(-1, -1), "radiance factor")) << "the cosines make the light";
  // At one incident angle only the other cosine can be told.
  const auto of_one = [](double cosine) {
    return said_of(painted(180, 0.3, 0.3, 4), [cosine](const auto& a, double f) {
      return std::abs(a.nol - std::cos(44 * degree)) < 1e-9 ? f * std::pow(a.nov, cosine)
                                                            : std::nan("");
    });
  };
  EXPECT_TRUE(of_one(0).empty());
  EXPECT_TRUE(says(of_one(1), "probably they are f cos(theta_o)"));
  // A metal's tail falls, too.
  for (const double alpha : {0.2, 0.5, 0.9})
    EXPECT_TRUE(said_of(painted(180, 0, alpha, 4), as_it_is).empty()) << alpha;
}

TEST(ValueWarnings, NameBothCosinesWhereNoExchangeTellsThemApart) {
  // Sheen changes with the angles as a cosine does.
  const auto sheen = as_painted(0, 0, "charlie/smith_charlie.correlated/schlick",
                                {{"alpha", {0.5}}, {"f0", {0.05}}});
  const auto all = said_of(sheen, [](const auto& a, double f) { return f * a.nov; });
  EXPECT_TRUE(says(all, "f/cos(theta_i)"));
  EXPECT_TRUE(says(all, "f cos(theta_o)"));
}

TEST(ValueWarnings, DoNotRefuseAnAnisotropicSurface) {
  const auto all = warnings_of(painted(180),
                               [](const auto& a, double f) { return a.nol > a.nov ? 1.5 * f : f; });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].text.find("an anisotropic surface"), std::string::npos) << all[0].text;
  EXPECT_FALSE(all[0].of_unit) << "an anisotropic model may be right";
}

TEST(ValueWarnings, SayThatExchangedDirectionsChangeValuesByFarMoreThanNoise) {
  EXPECT_TRUE(says(
      said_of(painted(180), [](const auto& a, double f) { return a.nol > a.nov ? 1.5 * f : f; }),
      "exchanging the directions"));
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  EXPECT_FALSE(
      says(said_of(painted(180),
                   [&](const auto&, double f) { return f * std::exp(0.1 * normal(random)); }),
           "exchanging the directions"));
}

TEST(ValueWarnings, LeaveAModelInPlayWhereTheInstrumentChangesValuesAnExchangeKeeps) {
  for (const auto& [share, told] : {std::pair{0.08, true}, {0.03, false}}) {
    const double more = 1 + share;
    const auto all = warnings_of(
        painted(180), [more](const auto& a, double f) { return a.nol > a.nov ? more * f : f; });
    ASSERT_EQ(all.size(), told ? 1u : 0u) << share;
    EXPECT_FALSE(told && all[0].of_unit) << "a model may still be chosen by them";
  }
}

TEST(Reciprocity, KnowsNoAzimuthAtTheNormal) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  t.where = DirectionList{{0, 45}, {0, 0}, {45, 0}, {180, 0}};
  t.values.emplace_back(2);
  t.values[0][0] = 0.3182;
  t.values[0][1] = 0.3208;
  ASSERT_TRUE(reciprocity(t).error);
  EXPECT_NEAR(*reciprocity(t).error, 0.0026 / 0.3195, 1e-4);
}

}  // namespace
}  // namespace gonio
