#include "reports/page/numbers.h"

#include <limits>

#include <gtest/gtest.h>

namespace gonio::page {
namespace {

TEST(PageNumbers, HaveTheDigitsThatCount) {
  EXPECT_EQ(significant(0.031249), "0.0312");
  EXPECT_EQ(significant(9.996, 3), "10.0") << "rounded before it is counted";
  EXPECT_EQ(significant(-4.12e-6, 2), "−4.1·10⁻⁶");
  EXPECT_EQ(significant(123456, 3), "123\u202f456");
  EXPECT_EQ(significant(1.5e9, 2), "1.5·10⁹");
  EXPECT_EQ(significant(0), "0");
  EXPECT_EQ(significant(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(PageNumbers, ArePlainWhereTheyAreRound) {
  EXPECT_EQ(plain(15), "15");
  EXPECT_EQ(plain(-0.04), "−0.04");
  EXPECT_EQ(plain(1.0 / 3, 3), "0.333");
  EXPECT_EQ(degrees_text(55.26), "55.3°");
  EXPECT_EQ(count_text(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(count_text(123), "123");
  EXPECT_EQ(many(1, "point"), "1 point");
  EXPECT_EQ(many(0, "point"), "0 points");
  EXPECT_EQ(signed_percent(0.042), "+4.2\u202f%");
  EXPECT_EQ(percent(0.99878), "99.9\u202f%") << "not all";
  EXPECT_EQ(percent(1), "100\u202f%");
  EXPECT_EQ(percent(-0.0312, 3), "−3.12\u202f%");
}

TEST(PageNumbers, SayRatiosAsFactors) {
  EXPECT_EQ(ratio_text(0.5), "×1.65");
  EXPECT_EQ(ratio_text(-0.05), "÷1.051");
  EXPECT_EQ(ratio_text(1e-5), "×1");
  EXPECT_EQ(times(7.04), "7.0\u202f×");
  EXPECT_EQ(times(0.0292), "0.029\u202f×") << "not 0.0";
  EXPECT_EQ(factor_text(0.6), "×/÷\u202f1.82");
}

TEST(PageNumbers, EndAtTheSecondDigitOfTheirError) {
  EXPECT_EQ(with_error(0.31234, 0.012), "0.312");
  EXPECT_EQ(with_error(-31.2, 9.96), "−31");
  EXPECT_EQ(with_error(0.5, std::numeric_limits<double>::quiet_NaN()), "0.5");
}

}  // namespace
}  // namespace gonio::page
