#include "number/known.h"

namespace gonio {
namespace {

TEST(Known, IsTheNumberItNames) {
  constexpr double x = 0.3;
  constexpr Known<-1> minus_one;
  EXPECT_EQ(Zero{} + x, x);
  EXPECT_EQ(x + Zero{}, x);
  EXPECT_EQ(x - Zero{}, x);
  EXPECT_EQ(Zero{} - x, -x);
  EXPECT_EQ(One{} + x, 1 + x);
  EXPECT_EQ(x + One{}, 1 + x);
  EXPECT_EQ(One{} - x, 1 - x);
  EXPECT_EQ(x - One{}, x - 1);
  EXPECT_EQ(One{} * x, x);
  EXPECT_EQ(x * One{}, x);
  EXPECT_EQ(minus_one * x, -x);
  EXPECT_EQ(minus_one + x, x - 1);
}

TEST(Known, StaysKnownWhereItCan) {
  static_assert(std::same_as<decltype(One{} - One{}), Zero>);
  static_assert(std::same_as<decltype(Zero{} + One{}), One>);
  static_assert(std::same_as<decltype(One{} * Zero{}), Zero>);
  static_assert(std::same_as<decltype(-One{}), Known<-1>>);
  static_assert(std::same_as<decltype(Zero{} * 2.0), Zero>);
  static_assert(std::same_as<decltype(2.0 * Zero{}), Zero>);
}

TEST(Partials, FollowTheRulesOfSumsAndProducts) {
  const auto x = input<0, 2>(3.0);
  const auto y = input<1, 2>(5.0);
  const auto f = x * y - (x + y);
  EXPECT_EQ(f.v, 7);
  EXPECT_EQ(std::get<0>(f.d), 4);
  EXPECT_EQ(std::get<1>(f.d), 2);
  EXPECT_EQ(std::get<0>((-f).d), -4);
}

}  // namespace
}  // namespace gonio
