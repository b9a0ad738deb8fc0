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

TEST(Printable, ShowsWhatTurnsTextAroundOrEndsItsLine) {
  EXPECT_EQ(printable("\u202egpj.exe"), "\\xe2\\x80\\xaegpj.exe");
  for (const char* c : {"\u061c", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u202d",
                        "\u2066", "\u2069", "\ufeff"})
    EXPECT_TRUE(printable(c).starts_with('\\')) << printable(c);
  for (const char* c :
       {"\u061b", "\u200d", "\u2010", "\u2027", "\u202f", "\u2065", "\u206a", "\ufefe"})
    EXPECT_EQ(printable(c), c);
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcd", 4), "abcd");
  EXPECT_EQ(printable("abcde", 4), "abcd…");
  EXPECT_EQ(printable("aωωω", 4), "aωω…");
}

}  // namespace
}  // namespace gonio
