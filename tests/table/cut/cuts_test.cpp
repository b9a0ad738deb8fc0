#include "table/cut/cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "table/sample_mask.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::glossy;

std::size_t points(const std::vector<double>& data) {
  return static_cast<std::size_t>(
      std::ranges::count_if(data, [](double v) { return std::isfinite(v); }));
}

/// Largest |data/model − 1| where both are there.
double farthest(const Cut& cut) {
  double most = 0;
  for (std::size_t c = 0; c < cut.data.size(); ++c)
    for (std::size_t i = 0; i < cut.deg.size(); ++i)
      if (std::isfinite(cut.data[c][i]) && std::isfinite(cut.model[c][i]))
        most = std::max(most, std::abs(cut.data[c][i] / cut.model[c][i] - 1));
  return most;
}

TEST(Cuts, AreAscendingAndAsLongAsTheyAre) {
  const auto cuts = make_cuts(test::filled(test::half_difference_grid(), glossy()), glossy());
  ASSERT_EQ(cuts.size(), 5U);
  for (const Cut& cut : cuts) {
    EXPECT_TRUE(std::ranges::is_sorted(cut.deg));
    EXPECT_EQ(cut.data.size(), 3U);
    EXPECT_EQ(cut.model.size(), 3U);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(cut.data[c].size(), cut.deg.size());
      EXPECT_EQ(points(cut.model[c]), cut.deg.size());
    }
  }
}

TEST(Cuts, OfIncidentAndOutgoingAnglesHitTheModelAtTheNodes) {
  const auto cuts = make_cuts(test::filled(test::in_out_grid(), glossy()), glossy());
  ASSERT_EQ(cuts.size(), 5U);
  EXPECT_NEAR(cuts[1].at_deg, 30, 1e-12);
  for (const Cut& cut : cuts) {
    EXPECT_EQ(points(cut.data[0]), 2U * 17 - 1);
    EXPECT_LT(farthest(cut), 1e-12);
  }
}

TEST(Cuts, OfHalfAnglesFollowTheModelToTheirInterpolation) {
  const auto cuts = make_cuts(test::filled(test::half_difference_grid(90), glossy()), glossy());
  ASSERT_EQ(cuts.size(), 5U);
  for (const Cut& cut : cuts) {
    EXPECT_GT(points(cut.data[0]), 60U);
    if (cut.at_deg < 70) {
      EXPECT_LT(farthest(cut), 0.06) << cut.at_deg;
    }
  }
}

TEST(Cuts, WithoutAModelAreTheDataAlone) {
  const Table t = test::filled(test::in_out_grid(), glossy());
  const auto with = make_cuts(t, glossy()), without = make_cuts(t);
  ASSERT_EQ(without.size(), with.size());
  EXPECT_TRUE(without[1].model.empty());
  EXPECT_EQ(without[1].deg.size(), 2U * 17 - 1);
  EXPECT_EQ(points(without[1].data[2]), points(with[1].data[2]));
}

TEST(Cuts, MirrorSideIsPositive) {
  const auto cuts = make_cuts(test::filled(test::in_out_grid(), glossy(0)), glossy(0));
  const Cut& at_60 = cuts[3];
  const auto peak = std::ranges::max_element(at_60.model[0], {}, [&](const double& v) {
    const double deg = at_60.deg[static_cast<std::size_t>(&v - at_60.model[0].data())];
    return std::abs(deg) < 75 ? v : 0;
  });
  EXPECT_GT(at_60.deg[static_cast<std::size_t>(peak - at_60.model[0].begin())], 55);
}

TEST(Cuts, OfASliceOutOfThePlaneRunAlongTheHalfAngle) {
  Grid g = test::half_difference_grid();
  g.axes[2] = {"phi_d", Axis::Spacing::constant, 1, test::right_angle};
  const auto cuts = make_cuts(test::filled(g, glossy()), glossy());
  ASSERT_EQ(cuts.size(), 5U);
  for (const Cut& cut : cuts) {
    EXPECT_EQ(cut.at, "theta_d");
    EXPECT_EQ(cut.along, "theta_h");
    EXPECT_EQ(points(cut.data[2]), 45U);
    EXPECT_LT(farthest(cut), 1e-9);
  }
}

TEST(Cuts, AGridOfOneAzimuthSaysNothingAboutTheOtherSide) {
  Grid g = test::in_out_grid();
  g.axes[2] = {"phi", Axis::Spacing::constant, 1, 2 * test::right_angle};
  const auto cuts = make_cuts(test::filled(g, glossy()), glossy());
  ASSERT_EQ(cuts.size(), 5U);
  for (const Cut& cut : cuts)
    for (std::size_t i = 0; i < cut.deg.size(); ++i)
      if (cut.deg[i] < 0) {
        EXPECT_TRUE(std::isnan(cut.data[0][i])) << cut.deg[i];
      }
}

TEST(Cuts, OfAListAreItsSamplesInThePlane) {
  DirectionList l;
  const auto add = [&](double ti, double pi, double to, double po) {
    l.theta_i_deg.push_back(ti);
    l.phi_i_deg.push_back(pi);
    l.theta_o_deg.push_back(to);
    l.phi_o_deg.push_back(po);
  };
  for (double deg = 5; deg < 90; deg += 5) {
    add(20, 90, deg, 270);  // mirror side
    add(20, 90, deg, 90);
    add(50, 0, deg, 180);
    add(50, 0, deg, 60);  // out of the plane, but for none
  }
  Table t = test::filled(l, glossy());
  t.values[0][0] = -1;
  t.values[1][1] = std::numeric_limits<double>::quiet_NaN();
  const auto cuts = make_cuts(t, glossy());
  ASSERT_EQ(cuts.size(), 2U);
  EXPECT_EQ(cuts[0].at_deg, 20);
  EXPECT_EQ(cuts[0].within_deg, 0);
  EXPECT_EQ(points(cuts[0].data[0]), 33U);
  EXPECT_EQ(points(cuts[0].data[1]), 33U);
  EXPECT_EQ(points(cuts[0].data[2]), 34U);
  EXPECT_EQ(points(cuts[1].data[0]), 17U);
  for (const Cut& cut : cuts) EXPECT_LT(farthest(cut), 1e-12);
  for (std::size_t i = 0; i < cuts[1].deg.size(); ++i)
    if (cuts[1].deg[i] < 0) {
      EXPECT_TRUE(std::isnan(cuts[1].data[0][i]));
    }
}

TEST(Cuts, HaveUncertaintiesAndWhatAMaskLeavesOut) {
  DirectionList l;
  for (double deg = 5; deg < 90; deg += 5) {
    l.theta_i_deg.push_back(20);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(deg);
    l.phi_o_deg.push_back(180);
  }
  Table t = test::filled(l, glossy());
  EXPECT_TRUE(make_cuts(t)[0].uncertainty.empty());
  EXPECT_TRUE(make_cuts(t)[0].left_out.empty());
  t.errors = t.values;
  leave_out(t, "theta_o > 60");
  const auto check = [&](const std::vector<Cut>& cuts) {
    ASSERT_EQ(cuts.size(), 1U);
    const Cut& cut = cuts[0];
    ASSERT_FALSE(cut.left_out.empty());
    for (std::size_t i = 0; i < cut.deg.size(); ++i) {
      if (!cut.uncertainty.empty() && !std::isnan(cut.data[0][i])) {
        EXPECT_EQ(cut.uncertainty[0][i], cut.data[0][i]);
      }
      EXPECT_FALSE(std::isfinite(cut.data[0][i]) && cut.deg[i] > 60);
      EXPECT_FALSE(std::isfinite(cut.left_out[0][i]) && cut.deg[i] <= 60);
    }
    EXPECT_EQ(points(cut.data[0]), 12U);
    EXPECT_EQ(points(cut.left_out[0]), 5U);
  };
  check(make_cuts(t));
  check(make_cuts(t, glossy()));
  Table grid = test::filled(test::in_out_grid(), glossy());
  const auto all = make_cuts(grid);
  leave_out(grid, "theta_o > 60");
  const auto cuts = make_cuts(grid);
  ASSERT_EQ(cuts.size(), all.size());
  for (std::size_t k = 0; k < cuts.size(); ++k)
    EXPECT_EQ(points(cuts[k].data[0]) + points(cuts[k].left_out[0]), points(all[k].data[0]));
  EXPECT_GT(points(cuts[0].left_out[0]), 0U);
}

TEST(Cuts, OfScatteredDirectionsSayHowFarTheirDataAreOff) {
  DirectionList l;
  for (int i = 0; i < 4000; ++i) {
    l.theta_i_deg.push_back(std::fmod(i * 0.618034 * 80, 80));
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(std::fmod(i * 0.754878 * 80, 80));
    l.phi_o_deg.push_back(std::fmod(i * 0.569840 * 360, 360));
  }
  const auto cuts = make_cuts(test::filled(l, glossy()), glossy());
  ASSERT_FALSE(cuts.empty());
  for (const Cut& cut : cuts) EXPECT_EQ(cut.within_deg, 1.5);
}

TEST(Cuts, ThereAreNoneWithoutDataInThem) {
  DirectionList l;
  l.theta_i_deg = l.theta_o_deg = {40, 40};
  l.phi_i_deg = {0, 0};
  l.phi_o_deg = {90, 100};
  EXPECT_TRUE(make_cuts(test::filled(l, glossy()), glossy()).empty());
}

}  // namespace
}  // namespace gonio
