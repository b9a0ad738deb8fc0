#include "base/numbers.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Numbers, AreWhatTheWholeTextIs) {
  EXPECT_EQ(number_from<double>("0.1"), 0.1);
  EXPECT_EQ(number_from<double>("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(number_from<double>("+2"), 2.0);
  EXPECT_EQ(number_from<double>(".5"), 0.5);
  EXPECT_EQ(number_from<double>("inf"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(*number_from<double>("nan")));
  EXPECT_EQ(number_from<std::size_t>("18446744073709551615"), ~std::size_t{0});
  EXPECT_EQ(number_from<int>("-7"), -7);
}

TEST(Numbers, AreNothingElse) {
  for (const char* text :
       {"", " 1", "1 ", "1x", "+", "-", "+-1", "++1", "1,5", "0x10", "1e", "1e999", "1_0"})
    EXPECT_FALSE(number_from<double>(text)) << text;
  for (const char* text : {"", "-1", "1.5", "18446744073709551616", "+ 1"})
    EXPECT_FALSE(number_from<std::size_t>(text)) << text;
}

}  // namespace
}  // namespace gonio
