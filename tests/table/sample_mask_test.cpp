// Samples are left out by an expression, and what is no such expression is said with its place.
#include "table/sample_mask.h"

#include <cmath>

#include "refusal.h"
#include "table/example.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

Table of_directions() {
  Table t;
  t.path = "t.csv";
  t.format = "csv";
  t.channels = {"r", "g"};
  DirectionList l;
  for (const double in : {10.0, 40.0})
    for (double out = -80; out <= 80; out += 10) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out > 0 ? 180 : 0);
    }
  const std::size_t n = l.theta_i_deg.size();
  t.where = std::move(l);
  t.values.assign(2, Values(n));
  for (std::size_t i = 0; i < n; ++i) t.values[0][i] = static_cast<double>(i), t.values[1][i] = 2;
  t.weights.assign(n, 1);
  return t;
}

std::size_t left(std::string_view expression) {
  Table t = of_directions();
  leave_out(t, expression);
  EXPECT_EQ(t.weights.size(), t.size());
  EXPECT_EQ(t.list()->phi_o_deg.size(), t.size());
  return t.size();
}

TEST(SampleMask, LeavesOutTheSamplesForWhichItHolds) {
  EXPECT_EQ(left("theta_o > 75"), 30U);
  EXPECT_EQ(left("theta_o >= 80 and theta_i < 20"), 32U);
  EXPECT_EQ(left("not (theta_o < 75)"), 30U);
  EXPECT_EQ(left("20 < theta_o <= 40"), 26U);
  EXPECT_EQ(left("retro < 8"), 32U) << "wo = wi at both incident angles";
  EXPECT_EQ(left("mirror < 8"), 32U);
  EXPECT_EQ(left("theta_h < 1"), 32U);
  EXPECT_EQ(left("f_r > 29.5 or f_r == 0"), 29U);
  EXPECT_EQ(left("f < 1.5 + 1 * 0.5 - -1/2"), 31U) << "means of 0 and 2, of 1 and 2 …";
  EXPECT_EQ(left("phi == 180"), 18U);
}

TEST(SampleMask, TakesTheValuesOfAGridAway) {
  Table t = test::mbsdf_example(5, 4);
  const std::size_t n = t.size();
  leave_out(t, "theta_o > 45");
  EXPECT_EQ(t.size(), n);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_EQ(std::isnan(t.values[0][i]), at(i).nov < std::cos(45 * degree)) << i;
}

TEST(SampleMask, CountsTheValuesThatItLeavesOut) {
  Table list = of_directions();
  EXPECT_EQ(values_left_out(list), 0U);
  leave_out(list, "theta_o > 75");
  EXPECT_EQ(list.mask, "theta_o > 75");
  EXPECT_EQ(values_left_out(list), 2U * 4U) << "of two channels";
  Table grid = test::mbsdf_example(5, 4);
  const auto valid = [](const Table& t) {
    const SampleAngles at(t);
    std::size_t n = 0;
    for (std::size_t i = 0; i < t.size(); ++i) n += mask(at(i), t.values[0][i]) == Mask::valid;
    return n * t.values.size();
  };
  const auto before = valid(grid);
  leave_out(grid, "theta_o > 45");
  EXPECT_EQ(valid(grid) + values_left_out(grid), before);
}

TEST(SampleMask, RefusesWithItsPlaceWhatIsNoExpression) {
  const auto refused = [](std::string_view expression, Exit code) {
    Table t = of_directions();
    return test::refusal([&] { leave_out(t, expression); }, code);
  };
  for (const char* none :
       {"", "theta_o >", "theta_o > 80 80", "theta > 80", "theta_o", "(theta_o > 80",
        "1 + (theta_o > 80) > 0", "not theta_o", "theta_o > 80 and 3", "theta_o ? 3"})
    EXPECT_HAS(refused(none, Exit::usage), "character ");
  EXPECT_HAS(refused(std::string(200, '(') + "1 < 2", Exit::usage), "levels");
  EXPECT_HAS(refused("theta_o > 0 or theta_o < 1", Exit::bad_input), "no sample left");
  EXPECT_HAS(refused("1/theta_o > 2", Exit::bad_input), "division by 0 at sample");
}

}  // namespace
}  // namespace gonio
