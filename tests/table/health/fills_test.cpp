// A value that fills gaps is named; rounding, flat surfaces and dark floors are no fills.
#include "table/health/fills.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "table/health/value_warnings.h"
#include "table/table.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Smooth values with noise at 10 incident and 40 outgoing angles, as a file of directions.
Table measured(double noise, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  DirectionList l;
  Values f;
  for (int i = 0; i < 10; ++i)
    for (int o = 0; o < 40; ++o) {
      l.theta_i_deg.push_back(8.0 * i);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(2.0 * o);
      l.phi_o_deg.push_back(180);
      f.push_back((0.05 + std::exp(-std::pow((o - 4 * i) / 8.0, 2))) *
                  std::exp(noise * normal(random)));
    }
  Table t;
  t.where = l;
  t.channels = {"f"};
  t.values = {f};
  return t;
}
std::optional<Fill> fill_in(const Table& t) {
  return fill_of(t);
}

TEST(Fills, AreNamedWithTheirNumberWhateverTheyAre) {
  for (const double fill : {1e-9, 1e-6, 1e-4, 0.21, 999.0, 1e30}) {
    Table t = measured(0.02);
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t.list()->theta_o_deg[i] > 70) t.values[0][i] = fill;
    const auto found = fill_in(t);
    ASSERT_TRUE(found) << fill;
    EXPECT_EQ(found->value, fill);
    EXPECT_EQ(found->sharers, 40u);
    EXPECT_EQ(found->values, 400u);
    TableFacts facts(t);
    const auto all = value_warnings(facts);
    EXPECT_TRUE(std::ranges::any_of(all, [](const auto& w) { return w.of_unit; }))
        << "no model is to blame";
  }
}

TEST(Fills, MayStandAnywhere) {
  Table t = measured(0.02);
  std::mt19937 random(2);
  std::size_t n = 0;
  for (double& v : t.values[0])
    if (random() % 20 == 0) v = 999, ++n;
  const auto found = fill_in(t);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sharers, n);
}

TEST(Fills, MayEqualWhatStandsBesideThemWhereThatIsNoisy) {
  Table t = measured(0.005);
  std::mt19937 random(2);
  std::size_t n = 0;
  for (double& v : t.values[0])
    if (v < 0.053 && random() % 3 == 0) v = 0.0503, ++n;
  const auto found = fill_in(t);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->value, 0.0503);
  EXPECT_EQ(found->sharers, n);
}

TEST(Fills, AreNoneOfATableWithoutThem) {
  EXPECT_FALSE(fill_in(measured(0.02)));
  EXPECT_FALSE(fill_in(measured(0)));
}

TEST(Fills, AreNotWhatDigitsMakeEqual) {
  for (const double per_unit : {1000, 100, 20}) {
    Table t = measured(0.02);
    for (double& v : t.values[0]) v = std::max(1.0, std::round(v * per_unit)) / per_unit;
    EXPECT_FALSE(fill_in(t)) << per_unit;
  }
}

TEST(Fills, AreNotAFlatSurfaceBesideItsHighlight) {
  Table t = measured(0);
  for (double& v : t.values[0]) v = std::max(v, 0.06);  // reached without a step
  EXPECT_FALSE(fill_in(t));
  Table narrow = measured(0);
  for (std::size_t i = 0; i < narrow.size(); ++i)
    narrow.values[0][i] = i % 40 == 4 * (i / 40) ? 30 : 0.1;  // most of the table
  EXPECT_FALSE(fill_in(narrow));
}

}  // namespace
}  // namespace gonio
