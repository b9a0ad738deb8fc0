#include "base/csv.h"

#include <limits>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(CsvText, IsQuotedWhereItMustBe) {
  EXPECT_EQ(csv_text("paint"), "paint");
  EXPECT_EQ(csv_text(""), "");
  EXPECT_EQ(csv_text("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_text("say \"no\""), "\"say \"\"no\"\"\"");
}

TEST(CsvText, LeavesATerminalAlone) {
  EXPECT_EQ(csv_text("a\nb\r"), "a\\x0ab\\x0d");
  EXPECT_EQ(csv_text("\x1b[31mred,\x7f\u202e"), "\"\\x1b[31mred,\\x7f\\xe2\\x80\\xae\"");
}

TEST(CsvText, IsNoFormula) {
  for (const std::string begin : {"=", "+", "-", "@"})
    EXPECT_EQ(csv_text(begin + "1+1"), "\"'" + begin + "1+1\"");
  EXPECT_EQ(csv_text("=A1,\"b\""), "\"'=A1,\"\"b\"\"\"");
  EXPECT_EQ(csv_text("\t=1"), "\\x09=1");
  EXPECT_EQ(csv_text("a=1"), "a=1");
}

TEST(CsvNumber, StaysANumber) {
  EXPECT_EQ(csv_number(-0.5), "-0.5");
  EXPECT_EQ(csv_number(0.1), "0.1");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "");
}

}  // namespace
}  // namespace gonio
