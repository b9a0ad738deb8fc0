#include "base/json/reader.h"

#include <cmath>
#include <filesystem>

#include "base/json/memory.h"
#include "refusal.h"
#include "support.h"

#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::string complaint(const std::string& text) {
  return test::refusal([&] { parse_json("file", text); });
}

TEST(ParseJson, GivesEveryKindOfValueInTheOrderOfTheText) {
  const std::string text =
      R"({"z":[1,-2,2.5,18446744073709551615],"a":{"b":null,"c":[true,false,{}]},"m":"\u00b5","e":[]})";
  EXPECT_EQ(
      parse_json("file", text).dump(),
      R"({"z":[1,-2,2.5,18446744073709551615],"a":{"b":null,"c":[true,false,{}]},"m":"µ","e":[]})");
  for (const char* lone : {"7", "-7", "2.5", "null", "true", "\"x\"", "[]", "{}"})
    EXPECT_EQ(parse_json("file", lone).dump(), lone);
}

TEST(ParseJson, KeepsTheLastValueOfANameWhereItsFirstStands) {
  EXPECT_EQ(parse_json("file", R"({"a":1,"b":2,"a":{"c":3,"c":4},"d":5,"b":6})").dump(),
            R"({"a":{"c":4},"b":6,"d":5})");
}

TEST(ParseJson, NamesLineAndColumnOfWhatIsNoJson) {
  EXPECT_EQ(complaint("{\n  \"a\": ?"), "file: line 2, column 8: found ?, expected JSON");
  EXPECT_EQ(complaint("[1,"), "file: line 1, column 4: found the end of the file, expected JSON");
  EXPECT_EQ(complaint("{} x"), "file: line 1, column 4: found x, expected JSON");
  EXPECT_EQ(complaint("[\n1e999]"),
            "file: line 2, column 5: found 1e999, expected a number that a double holds");
}

/// In time quadratic in the keys this takes half an hour, in linear time a second.
TEST(ParseJson, OfAMillionKeysTakesLinearTime) {
  constexpr std::size_t n = 1'000'000;
  std::string text = "{\"0\":0";
  for (std::size_t i = 1; i < n; ++i) text += ",\"" + std::to_string(i) + "\":" + std::to_string(i);
  const Json document = parse_json("file", text + "}");
  const auto members = JsonReader("file", document, "top").members();
  ASSERT_EQ(members.size(), n);
  EXPECT_EQ(members.back().first, "999999");
  EXPECT_EQ(members.back().second.number(), 999'999);
}

TEST(ReadJson, RefusesADocumentOfTooManyBytesBeforeItIsRead) {
  const test::Folder folder;
  const std::string path = folder.write("d", "[1, 2]");
  EXPECT_EQ(read_json(path).size(), 2U);
  std::filesystem::resize_file(path, most_document_bytes + 1);  // a hole
  EXPECT_HAS(test::refusal([&] { read_json(path); }),
             "d: byte 0: found 67108865 bytes, expected at most 67108864");
}

TEST(JsonReader, NamesThePlaceOfAMember) {
  const Json document = parse_json("file", R"({"a":{"b":"x"}})");
  const auto members = JsonReader("file", document).at("a").members();
  ASSERT_EQ(members.size(), 1U);
  EXPECT_EQ(test::refusal([&] { members[0].second.number(); }),
            "file: a.b: found \"x\", expected a number or null");
}

TEST(JsonReader, NamesPlacesAsPointersWhereAsked) {
  const Json document = parse_json("file", R"({"a/b":[{"c~d":"x"}]})");
  const std::string file = "file";
  const JsonReader root(file, document, "", Places::pointer);
  EXPECT_EQ(test::refusal([&] { root.at("a/b").at(0).at("c~d").number(); }),
            "file: /a~1b/0/c~0d: found \"x\", expected a number or null");
  EXPECT_EQ(test::refusal([&] { root.at("a/b").at(1); }),
            "file: /a~1b/1: found nothing, expected a value");
  EXPECT_EQ(test::refusal([&] { root.number(); }),
            "file: the document: found an object, expected a number or null");
  EXPECT_EQ(test::refusal([&] { JsonReader(file, document).at("a/b").at(1); }),
            "file: a/b[1]: found nothing, expected a value");
}

/// Each of them with the whole name takes 100 GB.
TEST(JsonReader, OfManyValuesUnderALongNameTakesLinearMemory) {
  std::string text = "{\"" + std::string(1'000'000, 'n') + "\":[0";
  for (int i = 0; i < 100'000; ++i) text += ",0";
  const Json document = parse_json("file", text + "]}");
  const auto members = JsonReader("file", document).members();
  EXPECT_EQ(members[0].second.elements().size(), 100'001U);
}

TEST(ParseJson, RefusesValuesThatTakeManyTimesTheirText) {
  const auto many = [](const std::string& one, std::size_t n) {
    std::string text = "[";
    text.reserve(n * (one.size() + 1) + 2);
    for (std::size_t i = 0; i < n; ++i) text += one + ",";
    return text + one + "]";
  };
  for (const char* one : {"[]", "0", "\"\"", "{\"\":0}"})
    EXPECT_HAS(complaint(many(one, (most_document_bytes - 8) / (std::string(one).size() + 1))),
               "more values than");
  EXPECT_EQ(complaint(many("0.12345678901234567", most_document_bytes / 20)), "");
}

TEST(CountedJson, OfSeveralDocumentsMayTakeWhatOneMay) {
  std::string text = "[[]";
  for (int i = 0; i < 2'000'000; ++i) text += ",[]";
  text += "]";
  std::size_t bytes = 0;
  const auto parsed = [&] { parse_json("file", text); };
  {
    const CountedJson all(bytes);
    EXPECT_EQ(test::refusal(parsed), "");
    EXPECT_GT(bytes, std::size_t{1} << 27);
  }
  EXPECT_EQ(test::refusal(parsed), "") << "counts to nothing";
  const CountedJson all(bytes);
  for (int k = 0; k < 3; ++k) test::refusal(parsed);
  EXPECT_HAS(test::refusal(parsed), "file: JSON: found more values than 536870912 bytes hold");
}

}  // namespace
}  // namespace gonio
