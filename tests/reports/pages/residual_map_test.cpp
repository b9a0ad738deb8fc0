#include "reports/pages/residual_map.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::glossy;

TEST(ResidualMap, OfAPerfectModelIsZero) {
  for (const Table& t : {test::filled(test::half_difference_grid(), glossy()),
                         test::filled(test::in_out_grid(), glossy())}) {
    const auto map = make_residual_map(t, glossy());
    ASSERT_EQ(map.count.size(), (map.theta_h_deg.size() - 1) * (map.theta_d_deg.size() - 1));
    for (std::size_t k = 0; k < map.count.size(); ++k) {
      if (map.count[k]) {
        EXPECT_EQ(map.mean[k], 0);
        EXPECT_EQ(map.rms[k], 0);
      } else {
        EXPECT_TRUE(std::isnan(map.mean[k]) && std::isnan(map.rms[k]));
      }
    }
  }
}

TEST(ResidualMap, CountsEveryValidValueOnce) {
  Table t = test::filled(test::half_difference_grid(), glossy());
  const SampleAngles at(t);
  std::size_t above = 0;
  for (std::size_t i = 0; i < t.size(); ++i) above += at(i).nol > 0 && at(i).nov > 0;
  t.values[0][0] = -1;
  t.values[1][0] = 0;  // has no logarithm
  t.values[2][0] = std::numeric_limits<double>::quiet_NaN();
  const auto map = make_residual_map(t, glossy());
  EXPECT_EQ(std::accumulate(map.count.begin(), map.count.end(), std::size_t{0}), 3 * above - 3);
}

TEST(ResidualMap, OfADoubledModelIsLnTwo) {
  Table t = test::filled(test::half_difference_grid(), glossy());
  for (auto& channel : t.values)
    for (double& v : channel) v /= 2;
  const auto map = make_residual_map(t, glossy());
  for (std::size_t k = 0; k < map.count.size(); ++k)
    if (map.count[k]) {
      EXPECT_NEAR(map.mean[k], std::log(2), 1e-12);
      EXPECT_NEAR(map.rms[k], std::log(2), 1e-12);
    }
}

TEST(ResidualMap, PutsASampleWhereItsAnglesAre) {
  DirectionList l;  // theta_h = 10°, theta_d = 40°
  l.theta_i_deg = {30};
  l.phi_i_deg = {0};
  l.theta_o_deg = {50};
  l.phi_o_deg = {180};
  const auto map = make_residual_map(test::filled(l, glossy()), glossy());
  const std::size_t bins_d = map.theta_d_deg.size() - 1;
  for (std::size_t k = 0; k < map.count.size(); ++k) {
    const std::size_t h = k / bins_d, d = k % bins_d;
    const bool here = map.theta_h_deg[h] <= 10 && 10 < map.theta_h_deg[h + 1] &&
                      map.theta_d_deg[d] <= 40 && 40 < map.theta_d_deg[d + 1];
    EXPECT_EQ(map.count[k], here ? 3U : 0U);
  }
}

}  // namespace
}  // namespace gonio
