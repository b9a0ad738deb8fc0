#include "base/rounded.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(RoundedUp, WritesNoPowerOfTenForAHundred) {
  EXPECT_EQ(rounded_up(100), "100");
  EXPECT_EQ(rounded_up(99.2), "100");
  EXPECT_EQ(rounded_up(9.96, 1), "10");
  EXPECT_EQ(rounded_down(99.9), "99");
}

TEST(RoundedDown, NeverLiesAboveTheNumber) {
  EXPECT_EQ(rounded_down(1.4502), "1.4");
  EXPECT_EQ(rounded_down(33.76), "33");
  EXPECT_EQ(rounded_down(1.9589), "1.9");
  EXPECT_EQ(rounded_down(0.9), "0.9");
  EXPECT_EQ(rounded_down(7.8e-6), "7.8e-06");
  EXPECT_EQ(rounded_down(0), "0");
  EXPECT_EQ(rounded_down(123.6), "123");
}

TEST(InPercent, KeepsAllDigitsOfAShare) {
  EXPECT_EQ(in_percent(0.99), "99");
  EXPECT_EQ(in_percent(0.995), "99.5");
  EXPECT_EQ(in_percent(0.9995), "99.95");
  EXPECT_EQ(in_percent(1 - 0.999), "0.1");
}

}  // namespace
}  // namespace gonio
