#include "base/json/reader.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include "base/json/memory.h"
#include "refusal.h"
#include "support.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

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
  std::size_t k = 0;
  JsonReader("file", document, "top").visit_members([&](const auto& name, const auto& value) {
    if (++k == n) {
      EXPECT_EQ(name + " " + std::to_string(value.whole_number()), "999999 999999");
    }
  });
  EXPECT_EQ(k, n);
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
  JsonReader("file", document).at("a").visit_members([](const auto&, const JsonReader& value) {
    EXPECT_EQ(test::refusal([&] { value.number(); }),
              "file: a.b: found \"x\", expected a number or null");
  });
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
  std::vector<JsonReader> all;
  JsonReader("file", document).visit_members([&](const auto&, const JsonReader& value) {
    for (std::size_t i = 0; i < value.size(); ++i) all.push_back(value.at(i));
  });
  EXPECT_EQ(all.size(), 100'001U);
}

TEST(JsonDocument, IsFreedWithoutMoreMemory) {
  const auto most_so_far = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // kB
  };
  std::string text = "[0";
  for (int i = 1; i < 1 << 22; ++i) text += ",0";
  auto document = std::make_unique<JsonDocument>("file", text + "]");
  const auto before = most_so_far();
  document.reset();
  EXPECT_LT(most_so_far() - before, 16'000) << "its values take 67 MB";
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
