#include "reports/picture/figure_scale.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Figure figure(FigureCurve curve, bool log = false) {
  Figure f{"f", "F", "", {"x"}, {"y"}, {std::move(curve)}};
  f.y.log = log;
  return f;
}
void expect_scale(const FigureScale& s, double low, double high) {
  EXPECT_NEAR(s.low, low, 1e-12 * std::abs(high));
  EXPECT_NEAR(s.high, high, 1e-12 * std::abs(high));
}
void expect_values(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size()) << testing::PrintToString(found);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-12 * std::abs(expected[i]));
}

TEST(FigureScale, OfPointsHasRoomBesideThem) {
  auto f = figure({"c", {0, 10}, {1, 1}});
  expect_scale(x_scale(f), 0, 10);
  f.curves[0].kind = FigureCurve::Kind::points;
  expect_scale(x_scale(f), -0.4, 10.4);
  f.curves[0].x = {1, 100};
  f.x.log = true;
  expect_scale(x_scale(f), std::pow(100, -0.04), std::pow(100, 1.04));
}

TEST(FigureScale, HasTheEndsThatItsAxisIsGiven) {
  auto f = figure({"c", {0, 10}, {1, 2}});
  f.x.from = -1, f.x.to = 20;
  f.y.from = 0.5, f.y.to = 3;
  expect_scale(x_scale(f), -1, 20);
  expect_scale(y_scale(f), 0.5, 3);
}

TEST(FigureScale, OfValuesBeginsAtZeroUnlessSomeAreBelow) {
  expect_scale(y_scale(figure({"c", {0, 1}, {5, 10}})), 0, 10.6);
  expect_scale(y_scale(figure({"c", {0, 1}, {-10, 10}})), -11.2, 11.2);
  expect_scale(y_scale(figure({"c", {0, 1}, {1, 100}}, true)), std::pow(100, -0.06),
               std::pow(100, 1.06));
}

TEST(FigureScale, HoldsTheBarsOfItsPoints) {
  auto f = figure({.name = "c", .x = {0, 1}, .y = {5, 10}, .y_error = {0, 10}});
  expect_scale(y_scale(f), 0, 21.2);
  f.y.log = true;  // which has no place for the lower end
  expect_scale(y_scale(f), 5 * std::pow(4, -0.06), 20 * std::pow(4, 0.06));
}

TEST(FigureScale, IsOfWhatCanBeDrawn) {
  const auto f = figure({"c", {0, 1, 2, 3, 4}, {0, -1, 10, none, 1}}, true);
  expect_scale(y_scale(f), std::pow(10, -0.06), std::pow(10, 1.06));
  expect_scale(x_scale(f), 2, 4);
  expect_scale(y_scale(figure({"c", {}, {}})), 0, 1);
  expect_scale(x_scale(figure({"c", {4}, {1}})), 2, 6);
}

TEST(FigureScale, MapsItsEndsToThoseOfItsLength) {
  const FigureScale log{1, 100, true}, linear{-1, 3, false};
  EXPECT_EQ(log.part(10), 0.5);
  EXPECT_EQ(linear.part(0), 0.25);
}

TEST(ScaleTicks, AreRoundNumbersWithin) {
  expect_values(scale_ticks({0, 10, false}, 7), {0, 2, 4, 6, 8, 10});
  expect_values(scale_ticks({0.13, 0.87, false}, 4), {0.2, 0.4, 0.6, 0.8});
  expect_values(scale_ticks({0, 1.6, false}, 4), {0, 0.5, 1, 1.5});
  expect_values(scale_ticks({0.5, 20, true}, 7), {0.5, 1, 2, 5, 10, 20});
  expect_values(scale_ticks({3e-4, 30, true}, 7), {1e-3, 1e-2, 1e-1, 1, 10});
  expect_values(scale_ticks({1e-12, 1e12, true}, 7), {1e-12, 1e-8, 1e-4, 1, 1e4, 1e8, 1e12});
  expect_values(scale_ticks({2, 5, true}, 7), {2, 3, 4, 5});
  expect_values(scale_ticks({1.02, 1.08, true}, 4), {1.02, 1.04, 1.06, 1.08});
}

TEST(TickText, IsShortAndHasPowersWhereNumbersAreLong) {
  for (const auto& [x, text] : {std::pair(0.0, "0"),
                                {0.05, "0.05"},
                                {-5.0, "−5"},
                                {1234.0, "1234"},
                                {1e-4, "10⁻⁴"},
                                {2e-6, "2·10⁻⁶"},
                                {-1e5, "−10⁵"},
                                {-1.5e12, "−1.5·10¹²"}})
    EXPECT_EQ(tick_text(x), text);
}

TEST(CellEdges, LieBetweenTheCells) {
  FigureMap::Axis a{"x", {1, 2, 4}};
  expect_values(cell_edges(a), {0.5, 1.5, 3, 5});
  a.from = 0, a.to = 6;
  expect_values(cell_edges(a), {0, 1.5, 3, 6});
  a = {"x", {3}};
  expect_values(cell_edges(a), {2.5, 3.5});
  a = {"x", {1, 100}};
  a.log = true;
  expect_values(cell_edges(a), {0.1, 10, 1000});
  a.names = {"one", "two"};
  expect_values(cell_edges(a), {0, 1, 2});
}

FigureMap map_of(std::vector<double> values, bool diverging, FigureMap::Scale scale) {
  FigureMap m{"m", "M", "", {"x", {1}}, {"y", {1}}, "v", std::move(values), diverging};
  m.scale = scale;
  return m;
}

TEST(FigureScale, OfARootGivesSmallValuesRoom) {
  const FigureScale s{0, 90, false, true};
  EXPECT_DOUBLE_EQ(s.part(22.5), 0.5);
  FigureMap::Axis a;
  a.root = true, a.at = {2.5, 22.5, 62.5}, a.from = 0, a.to = 90;  // thirds of the root, squared
  EXPECT_NEAR(cell_edges(a)[1], 10, 1e-9);
  EXPECT_NEAR(cell_edges(a)[2], 40, 1e-9);
  for (const double t : scale_ticks(s, 7)) EXPECT_LE(t, 90);
}

TEST(ColourScale, OfRatiosIsEvenAboutOne) {
  FigureMap m;
  m.scale = FigureMap::Scale::log, m.diverging = true, m.limit = 2, m.values = {1, 1.5};
  const auto s = colour_scale(m);
  EXPECT_DOUBLE_EQ(colour_part(m, s, 1), 0.5);
  EXPECT_DOUBLE_EQ(colour_part(m, s, 0.5), 0);
  EXPECT_DOUBLE_EQ(colour_part(m, s, 4), 1);
}

TEST(ColourScale, EndsAtRoundNumbersThatHoldTheValues) {
  using enum FigureMap::Scale;
  const auto even = colour_scale(map_of({0.3, none, 0.03}, false, linear));
  EXPECT_EQ(even.low, 0);
  EXPECT_EQ(even.high, 0.5);
  expect_values(even.ticks, {0, 0.25, 0.5});
  const auto both = colour_scale(map_of({0.3, -7}, true, root));
  EXPECT_EQ(both.low, -10);
  expect_values(both.ticks, {-10, -3, -0.5, 0, 0.5, 3, 10});
  const auto decades = colour_scale(map_of({2e-3, 0.3, 0, -9}, false, log));
  EXPECT_DOUBLE_EQ(decades.low, 1e-3);
  EXPECT_EQ(decades.high, 0.5);
  auto limited = map_of({0.3}, false, linear);
  limited.limit = 0.2;
  EXPECT_EQ(colour_scale(limited).high, 0.2);
}

TEST(ColourPart, IsThePlaceOfAValueBetweenTheEnds) {
  using enum FigureMap::Scale;
  const auto part = [](const FigureMap& m, double v) { return colour_part(m, colour_scale(m), v); };
  const auto even = map_of({1}, false, linear), both = map_of({1}, true, linear),
             roots = map_of({1}, true, root), decades = map_of({0.01, 1}, false, log);
  EXPECT_EQ(part(even, 0.25), 0.25);
  EXPECT_EQ(part(even, 7), 1);
  EXPECT_EQ(part(both, 0), 0.5);
  EXPECT_EQ(part(both, -1), 0);
  EXPECT_EQ(part(roots, 0.25), 0.75);
  EXPECT_EQ(part(roots, -0.25), 0.25);
  EXPECT_DOUBLE_EQ(part(decades, 0.1), 0.5);
  EXPECT_EQ(part(decades, -1), 0);
}

}  // namespace
}  // namespace gonio
