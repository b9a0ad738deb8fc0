// Text with columns: records, fields, quotes, line ends, encodings.
#include "table/format/delimited.h"

#include "refusal.h"
#include "support.h"

namespace gonio {
namespace {

using Lines = std::vector<std::string>;

struct Parsed {
  Lines names;
  std::vector<Lines> rows;
};
Parsed parsed(const std::string& text) {
  Delimited d("file", text);
  Parsed p{d.names(), {}};
  while (d.next()) p.rows.emplace_back(d.fields().begin(), d.fields().end());
  return p;
}
std::string complaint_of_text(const std::string& text) {
  return test::refusal([&] { parsed(text); });
}

TEST(Delimited, TakesAnyCharacterWithinQuotes) {
  const auto p = parsed(
      "a,\"b,c\",\"d \"\"e\"\"\",\" f;\t \",\"\",\"g\n#h\r\n\"\n"
      "1,\"2\",\" 3 \",\"\"\"x\"\"\",\"\",\"6\n7\"\r\n"
      "1,2,3,4,5,6\n");
  EXPECT_EQ(p.names, (Lines{"a", "b,c", "d \"e\"", " f;\t ", "", "g\n#h\r\n"}));
  ASSERT_EQ(p.rows.size(), 2U);
  EXPECT_EQ(p.rows[0], (Lines{"1", "2", "3", "\"x\"", "", "6\n7"}));
}

TEST(Delimited, TakesAQuoteForItselfWhereNoFieldBegins) {
  const auto p = parsed("a;5\";b \"c;d\ne;\"f\" g;h;\"i\"\n");
  EXPECT_EQ(p.names, (Lines{"a", "5\"", "b \"c", "d"}));
  EXPECT_EQ(p.rows[0], (Lines{"e", "\"f\" g", "h", "i"}));
}

TEST(Delimited, CountsTheLinesWithinQuotes) {
  EXPECT_EQ(complaint_of_text("a,\"b\n\n\"\n\n1,2\n1.0,2,3\n"),
            "file: line 6: found 3 fields, expected 2");
}

TEST(Delimited, NamesTheLineOfAQuoteThatDoesNotEnd) {
  const std::string found = "found a quote that does not end";
  EXPECT_NE(complaint_of_text("a,b\n1,\"2\n3,4\n").find("file: line 2: " + found),
            std::string::npos);
  EXPECT_NE(complaint_of_text("\n\"a,b\n1,2\n").find("file: line 2: " + found), std::string::npos);
}

/// Were every quote looked for again from each field on, it would take minutes.
TEST(Delimited, OfManyQuotesTakesLinearTime) {
  std::string text = "a";
  for (int i = 0; i < 500'000; ++i) text += ",\"b\"";
  EXPECT_EQ(parsed(text).names.size(), 500'001U);
  EXPECT_NE(complaint_of_text(text + "\n\"" + std::string(2'000'000, ',')), "");
  EXPECT_NE(complaint_of_text(text + "\n" + text.substr(0, text.size() - 1)), "");
}

TEST(Delimited, KeepsNoMoreFieldsOfARowThanThereAreNames) {
  const std::string text = "a,b\n" + std::string(1'000'000, ',');
  Delimited lines("file", text);
  EXPECT_EQ(test::refusal([&] { lines.next(); }).substr(0, 44),
            "file: line 2: found 1000001 fields, expected");
  EXPECT_EQ(lines.fields().size(), 2U);
}

TEST(Delimited, RefusesMoreColumnsThanAnyTableHas) {
  EXPECT_EQ(complaint_of_text(std::string(1 << 20, ',') + "\n"),
            "file: line 1: found more than 1048576 columns, expected fewer");
}

TEST(Delimited, RefusesALongName) {
  EXPECT_EQ(complaint_of_text("a," + std::string(65'537, 'b') + "\n1,2\n"),
            "file: line 1: found a name of 65537 bytes, expected at most 65536");
}

TEST(Delimited, TakesTheLineEndsOfOldMacs) {
  const auto p = parsed("# x\ra,b\r\r1,2\r3,4");
  EXPECT_EQ(p.names, (Lines{"a", "b"}));
  EXPECT_EQ(p.rows, (std::vector<Lines>{{"1", "2"}, {"3", "4"}}));
  EXPECT_EQ(complaint_of_text("a,b\r1,2\r3\r"), "file: line 3: found 1 fields, expected 2");
  EXPECT_TRUE(looks_delimited("a,b,c\r1,2,3\r"));
  EXPECT_EQ(first_fields("# x\ra,b\r1,2"), (Lines{"a", "b"}));
}

std::string utf16(const std::string& text, bool big) {
  std::string out;
  for (const char c : text) out += big ? std::string{'\0', c} : std::string{c, '\0'};
  return out;
}

TEST(Delimited, RefusesUtf16ByName) {
  const std::string text = "theta_i,theta_o,f\n10,20,0.5\n",
                    said = "file: byte 0: found text in UTF-16, expected UTF-8";
  EXPECT_EQ(complaint_of_text("\xff\xfe" + utf16(text, false)), said);
  EXPECT_EQ(complaint_of_text("\xfe\xff" + utf16(text, true)), said);
  EXPECT_EQ(complaint_of_text(utf16(text, false)), said);
  EXPECT_EQ(complaint_of_text(utf16(text, true)), said);
  EXPECT_EQ(complaint_of_text(text), "");
}

TEST(CommaField, IsQuotedWhereItMustBeAndReadsBack) {
  for (const char* plain : {"r", "532nm", "a b", "#1", "f_ä", "5'"})
    EXPECT_EQ(comma_field(plain), plain);
  EXPECT_EQ(comma_field("a\"b"), "\"a\"\"b\"");
  const Lines names{"a,b", "\"", "\"\"", "\",\"", " a", "a ", "a\nb",    "a\r\nb",
                    "\t",  ";,", "",     "r",     "\r", "=1", "\"a\"b\""};
  std::string line;
  for (const auto& name : names) line += (line.empty() ? "" : ",") + comma_field(name);
  EXPECT_EQ(comma_fields(line), names);
}

/// Each part has the names: of long ones there are few parts.
TEST(Delimited, OfLongNamesIsNotCutIntoManyParts) {
  std::string rows;
  while (rows.size() < 9'000'000) rows += "1,2\n";
  EXPECT_EQ(Delimited("file", "a,b\n" + rows).parts().size(), 9U);
  std::string names;
  for (int k = 0; k < 20; ++k) names += std::string(50'000, 'a') + ",";
  EXPECT_LE(Delimited("file", names + "b\n" + rows).parts().size(), 1U);
}

}  // namespace
}  // namespace gonio
