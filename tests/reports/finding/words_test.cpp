#include "reports/finding/words.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(ListText, SetsAWordBeforeTheLast) {
  EXPECT_EQ(list_text({}), "");
  EXPECT_EQ(list_text({"a"}), "a");
  EXPECT_EQ(list_text({"a", "b"}), "a and b");
  EXPECT_EQ(list_text({"a", "b", "c"}, " or "), "a, b or c");
}

TEST(RoundedUp, NeverLiesBelowTheNumber) {
  EXPECT_EQ(rounded_up(0.00391006), "0.004");
  EXPECT_EQ(rounded_up(0.272217), "0.28");
  EXPECT_EQ(rounded_up(0.28), "0.28");
  EXPECT_EQ(rounded_up(1.0398, 3), "1.04");
  EXPECT_EQ(rounded_up(0.99999), "1");
  EXPECT_EQ(rounded_up(1.01328e-06), "1.1e-06");
  EXPECT_EQ(rounded_up(0), "0");
  EXPECT_EQ(rounded_up(123.4), "124") << "no power of ten";
}

TEST(Words, NoBoundIsBelowItsNumber) {
  EXPECT_EQ(at_most(2.412), "≤ 2.5");
  EXPECT_EQ(at_most(23.29), "≤ 24");
  EXPECT_EQ(at_most(0.1915), "≤ 0.2");
  EXPECT_EQ(at_most(3e-6), "≤ 0.0001");
  EXPECT_EQ(at_most(14 * 0.1), "≤ 1.4") << "which is a bit more in double";
  EXPECT_EQ(at_most(0), "≤ 0");
  EXPECT_EQ(at_most(1.0398, 3), "≤ 1.04");
}

}  // namespace
}  // namespace gonio
