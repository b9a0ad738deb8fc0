#include "reports/pages/inspect_page.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tables.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;
using test::glossy;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t masked(const TrustMap& m, Mask why) {
  const auto& counts = m.masked[static_cast<std::size_t>(why)];
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}
/// The cell of a map that holds two angles [degrees].
std::size_t cell(const std::vector<double>& x,
                 double at_x,
                 const std::vector<double>& y,
                 double at_y) {
  const auto bin = [](const std::vector<double>& edges, double at) {
    return static_cast<std::size_t>(std::ranges::upper_bound(edges, at) - edges.begin() - 1);
  };
  return bin(x, at_x) * (y.size() - 1) + bin(y, at_y);
}

TEST(SlicePicture, OfAGridIsTheTableAtNinetyDegreesOfPhiD) {
  const auto p = make_slice_picture(test::filled(test::half_difference_grid(90), glossy()));
  EXPECT_NEAR(p.phi_d_deg, 90, 1e-12);
  ASSERT_EQ(p.theta_h_deg.size(), 91U);
  ASSERT_EQ(p.value.size(), 3U);
  for (const auto& [h, d] : {std::pair(1.0, 30.0), std::pair(10.0, 60.0), std::pair(50.0, 20.0)}) {
    const std::size_t k = cell(p.theta_h_deg, h, p.theta_d_deg, d), row = k / 90, column = k % 90;
    const double theta_h = std::pow((static_cast<double>(row) + 0.5) / 90, 2) * 90,
                 theta_d = static_cast<double>(column) + 0.5;
    const HalfDifference middle{theta_h * degree, 0, theta_d * degree, test::right_angle};
    const auto f = evaluate(glossy(), std::vector{angles(directions(middle))});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(p.value[c][k] / f[c][0], 1, 0.01);
  }
}

TEST(SlicePicture, OfAnImageSliceHasItsCells) {
  Grid g = test::half_difference_grid(30);
  g.axes[2] = {"phi_d", Axis::Spacing::constant, 1, 1.0};
  const Table t = test::filled(g, glossy());
  const auto p = make_slice_picture(t);
  EXPECT_NEAR(p.phi_d_deg, 1 / degree, 1e-12);
  ASSERT_EQ(p.value[0].size(), 900U);
  EXPECT_NEAR(p.value[1][4 * 30 + 7], t.values[1][4 * 30 + 7], 1e-12);
}

TEST(SlicePicture, OfAListIsTheMeanOfEachCell) {
  Table t;
  t.channels = {"f"};
  t.where = DirectionList{{30, 30, 30, 50}, {0, 0, 0, 0}, {30, 30, 30, 50}, {180, 180, 180, 180}};
  t.values.resize(1);
  for (const double v : {1.0, 2.0, -5.0, 7.0}) t.values[0].push_back(v);
  const auto p = make_slice_picture(t);
  EXPECT_TRUE(std::isnan(p.phi_d_deg));
  EXPECT_EQ(p.value[0][cell(p.theta_h_deg, 0, p.theta_d_deg, 30.5)], 1.5)
      << "the masked one is left out";
  EXPECT_EQ(p.value[0][cell(p.theta_h_deg, 0, p.theta_d_deg, 50.5)], 7);
  EXPECT_TRUE(std::isnan(p.value[0][0]));
}

TEST(TrustMap, CountsWhatIsMaskedWhereItIs) {
  Table t = test::filled(test::in_out_grid(), glossy());
  t.values[0][0] = -1;
  t.values[1][0] = nan;
  t.values[2][(4 * 17 + 10) * 13 + 3] = -2;  // theta_i 40°, theta_o 50°
  const auto m = make_trust_map(t);
  EXPECT_EQ(m.x, "theta_i");
  EXPECT_EQ(m.x_deg.size(), 10U);
  EXPECT_EQ(std::accumulate(m.values.begin(), m.values.end(), std::size_t{0}), 3 * t.size());
  EXPECT_EQ(masked(m, Mask::negative), 2U);
  EXPECT_EQ(masked(m, Mask::not_finite), 1U);
  const auto& negative = m.masked[static_cast<std::size_t>(Mask::negative)];
  EXPECT_EQ(negative[0], 1U);
  EXPECT_EQ(negative[cell(m.x_deg, 40.1, m.y_deg, 50.1)], 1U);
}

TEST(TrustMap, ShowsWhereATableIsNotReciprocal) {
  Grid g = test::in_out_grid();
  g.axes[1] = {"theta_o", Axis::Spacing::inclusive, 9, 80 * degree};
  Table t = test::filled(g, glossy());
  for (auto& plane : t.values)
    for (std::size_t k = 0; k < 13; ++k) plane[(2 * 9 + 5) * 13 + k] *= 1.5;  // 20° in, 50° out
  const auto m = make_trust_map(t);
  const auto at = [&](double i, double o) { return m.reciprocity[cell(m.x_deg, i, m.y_deg, o)]; };
  EXPECT_NEAR(at(20.1, 50.1), 0.4, 1e-9);
  EXPECT_NEAR(at(50.1, 20.1), 0.4, 1e-9);
  EXPECT_NEAR(at(20.1, 40.1), 0, 1e-9);
}

TEST(TrustMap, OfHalfAnglesIsOverThem) {
  const Table t = test::filled(test::half_difference_grid(20), glossy());
  const auto m = make_trust_map(t);
  EXPECT_EQ(m.x, "theta_h");
  EXPECT_EQ(m.y, "theta_d");
  EXPECT_GT(masked(m, Mask::below_horizon), 0U);
  for (const double r : m.reciprocity) EXPECT_TRUE(std::isnan(r)) << "each pair is held once";
}

TEST(InspectPage, DataHoldTheHealthAndTheFigures) {
  const Table t = test::filled(test::in_out_grid(), glossy());
  const InspectPage page = make_inspect_page(t);
  const json data = json::parse(to_json(page, R"({"valid": 3})"));
  EXPECT_EQ(data.at("health"), (json{{"valid", 3}}));
  ASSERT_EQ(data.at("curves").size(), page.curves.size());
  EXPECT_TRUE(data.at("curves")[0].at("model").empty());
  EXPECT_EQ(data.at("picture").at("value").size(), 3U);
  EXPECT_EQ(data.at("picture").at("value")[0].size(), 90U * 90);
  const json& trust = data.at("trust");
  EXPECT_EQ(trust.at("values").size(),
            (trust.at("x_deg").size() - 1) * (trust.at("y_deg").size() - 1));
  for (const char* why : {"below_horizon", "negative", "not_finite"})
    EXPECT_EQ(trust.at("masked").at(why).size(), trust.at("values").size());
  EXPECT_EQ(data.at("albedo").size(), 18U);
  EXPECT_EQ(data.at("albedo")[1].at("theta_i_deg"), 5);
}

TEST(InspectPage, OfANastyFileNameOrAnEmptyTableIsWhole) {
  Table t = test::filled(test::in_out_grid(), glossy());
  t.path = "</script><img src=x onerror=alert(1)>\xff.csv";
  for (auto& plane : t.values) std::ranges::fill(plane, -1);
  const std::string data = to_json(make_inspect_page(t), to_json(t, inspect(t)));
  EXPECT_TRUE(json::parse(data).at("curves").empty());
  const std::string html = inspect_page_html(t, inspect(t), make_inspect_page(t));
  EXPECT_EQ(html.find("<img"), html.npos);
}

}  // namespace
}  // namespace gonio
