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
}

}  // namespace
}  // namespace gonio
