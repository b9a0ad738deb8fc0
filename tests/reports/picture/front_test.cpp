#include "reports/picture/front.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TimedError form(double ns, double spread_ns, double error) {
  return {{ns, spread_ns}, error};
}
FrontPlace place(const TimedError& own, const TimedError& rival) {
  const std::vector<TimedError> both{rival, own};
  return front_place(both, 1);
}

TEST(FrontPlace, IsLostToARivalThatIsAsExactAndFasterByMoreThanBothSpreads) {
  EXPECT_FALSE(place(form(2, 0.1, 0.5), form(1, 0.1, 0.5)).front);
  EXPECT_TRUE(place(form(2, 0.1, 0.5), form(1, 0.1, 0.51)).front) << "it is less exact";
  EXPECT_TRUE(place(form(2, 0.6, 0.5), form(1, 0.6, 0.5)).front) << "it may not be faster";
  EXPECT_TRUE(place(form(1, 0.1, 0.5), form(2, 0.1, 0.5)).front) << "it is slower";
}

TEST(FrontPlace, IsATieWhereABetterRivalTakesAsLongWithinBothSpreads) {
  EXPECT_TRUE(place(form(1, 0.2, 0.5), form(1.3, 0.2, 0.4)).tie);
  EXPECT_FALSE(place(form(1, 0.2, 0.4), form(1.3, 0.2, 0.5)).tie) << "the rival is worse";
  EXPECT_FALSE(place(form(1, 0.1, 0.5), form(1.3, 0.1, 0.4)).tie) << "the rival is slower";
}

TEST(FrontPlace, IsATieForBothOfThoseThatAreAsExactAndTakeAsLong) {
  const auto a = form(1, 0.2, 0.5), b = form(1.1, 0.2, 0.5);
  EXPECT_TRUE(place(a, b).tie);
  EXPECT_TRUE(place(b, a).tie);
  EXPECT_TRUE(place(a, b).on_line) << "it took less here";
  EXPECT_FALSE(place(b, a).on_line);
}

TEST(FrontPlace, TakesErrorsThatDifferByRoundingForTheSame) {
  const auto a = form(1, 0.2, 0.0600771), b = form(1.1, 0.2, 0.0600770);
  EXPECT_TRUE(place(a, b).tie);
  EXPECT_TRUE(place(b, a).tie);
  EXPECT_TRUE(place(a, b).on_line);
  EXPECT_FALSE(place(b, a).on_line) << "as exact, and slower";
  EXPECT_FALSE(place(form(2, 0.1, 0.0600770), form(1, 0.1, 0.0600771)).front);
}

TEST(FrontPlace, IsOnTheLineWhereNoneAsExactTookLess) {
  EXPECT_TRUE(place(form(1, 0.1, 0.5), form(2, 0.1, 0.5)).on_line);
  EXPECT_FALSE(place(form(2, 0.1, 0.5), form(1, 0.1, 0.5)).on_line) << "it is beaten";
  EXPECT_TRUE(place(form(1, 0.2, 0.5), form(1.3, 0.2, 0.4)).on_line)
      << "as it is drawn: the spreads hide which is faster, not which point is further left";
  EXPECT_FALSE(place(form(1.3, 0.2, 0.5), form(1, 0.2, 0.4)).on_line)
      << "the rival is better in both";
  EXPECT_FALSE(place(form(1, 0.1, 0.5), form(1, 0.1, 0.4)).on_line) << "as fast, and less exact";
}

const std::vector<FrontDot> dots{{"slow", form(3, 0.3, 0.01), true},
                                 {"beaten", form(2, 0.2, 0.7)},
                                 {"fast", form(1, 0.1, 0.5), true}};

TEST(FrontPoints, AreLabelledAndHaveTheSpreadsOfTheirTimes) {
  const FigureCurve c = front_points("forms", dots);
  EXPECT_EQ(c.name, "forms");
  EXPECT_EQ(c.kind, FigureCurve::Kind::points);
  EXPECT_EQ(c.labels, (std::vector<std::string>{"slow", "beaten", "fast"}));
  EXPECT_EQ(c.x, (std::vector<double>{3, 2, 1}));
  EXPECT_EQ(c.y, (std::vector<double>{0.01, 0.7, 0.5}));
  EXPECT_EQ(c.x_error, (std::vector<double>{0.3, 0.2, 0.1}));
}

TEST(FrontLine, GoesFromTheFastToTheSlowAndLeavesOutWhatIsBeaten) {
  const auto line = front_line("front", dots);
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->dashed);
  EXPECT_EQ(line->x, (std::vector<double>{1, 3}));
  EXPECT_EQ(line->y, (std::vector<double>{0.5, 0.01}));
}

TEST(FrontLine, NeedsTwo) {
  EXPECT_FALSE(front_line("front", std::span(dots).first(2)));
}

}  // namespace
}  // namespace gonio
