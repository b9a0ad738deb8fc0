#include "base/text.h"

#include "support.h"

namespace gonio {
namespace {

TEST(Split, GivesEveryPartEmptyOnesIncluded) {
  using Parts = std::vector<std::string>;
  EXPECT_EQ(split("a,bc,d", ','), (Parts{"a", "bc", "d"}));
  EXPECT_EQ(split(",a,,", ','), (Parts{"", "a", "", ""}));
  EXPECT_EQ(split("a,b", '+'), Parts{"a,b"});
  EXPECT_EQ(split("", ','), Parts{""});
}

TEST(Printable, KeepsUtf8AndShowsAnyOtherByte) {
  EXPECT_EQ(printable("ω_o × 90°, 漢 🙂"), "ω_o × 90°, 漢 🙂");
  EXPECT_EQ(printable("a\n\x1b[31m\x7f"), "a\\x0a\\x1b[31m\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "a control character of two bytes";
  EXPECT_EQ(printable("\xff\xc0\xaf"), "\\xff\\xc0\\xaf") << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcd", 4), "abcd");
  EXPECT_EQ(printable("abcde", 4), "abcd…");
  EXPECT_EQ(printable("aωωω", 4), "aωω…");
}

}  // namespace
}  // namespace gonio
