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
  for (const char* c :
       {"\u061c", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u202d", "\u2066", "\u2069",
        "\ufeff", "\u00ad", "\u200b", "\ufffe", "\uffff", "\U000e0041"})
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

TEST(Beginning, EndsBetweenCharacters) {
  EXPECT_EQ(beginning("aωω", 4), "aω");
  EXPECT_EQ(beginning("aωω", 5), "aωω");
  EXPECT_EQ(beginning("ω", 1), "");
}

/// A name that does harm in each of these places.
const std::string name_of_harm = "--a <&\"'\x1b\x7f\u202e%";

TEST(InQuotes, CopiesNoMoreOfATextThanALineShows) {
  EXPECT_EQ(in_quotes("1,5x"), "'1,5x'");
  EXPECT_EQ(in_quotes(std::string(1 << 20, 'x')).size(), 102U);
}

TEST(NamesElsewhere, AreWordsOfAShell) {
  EXPECT_EQ(path_word("--help"), "./--help");
  EXPECT_EQ(path_word("-a b"), "'./-a b'");
  EXPECT_EQ(path_word("a-b"), "a-b");
}

TEST(NamesElsewhere, AreTextInXmlAndHtml) {
  EXPECT_EQ(markup_text(name_of_harm), "--a &lt;&amp;&quot;'\\x1b\\x7f\\xe2\\x80\\xae%");
}

TEST(NamesElsewhere, AreReferencesOfUris) {
  EXPECT_EQ(uri_of(name_of_harm), "--a%20%3C%26%22%27%1B%7F%E2%80%AE%25");
  EXPECT_EQ(uri_of("a/b_c~1.json"), "a/b_c~1.json");
  EXPECT_EQ(uri_of("c:d"), "./c:d") << "no scheme";
  EXPECT_EQ(uri_of("/c:d"), "/c:d");
}

TEST(NamesElsewhere, StayTheSameInJsonAndLeaveATerminalAlone) {
  EXPECT_EQ(printable_json("[\"ω\x7f\u202e🙂\xc2\x9bz\"]"),
            "[\"ω\\u007f\\u202e🙂\\u009bz\"]");
  EXPECT_EQ(printable_json("\n[\"漢\"]"), "\n[\"漢\"]");
}

}  // namespace
}  // namespace gonio
