#include "base/json/describe.h"

#include <limits>
#include <map>

#include "base/csv_describe.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {

enum class Colour { red, green };
template <>
inline constexpr std::array<std::string_view, 2> names_of<Colour>{"red", "green"};

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Width {
  std::string name;
  std::vector<double> alpha;
  Colour colour = Colour::red;
};
struct More {
  int steps = 0;
};
struct Shown {
  std::string model = "ggx";
  double rms = 0.12345678;
  std::size_t values = 3;
  bool robust = false;
  std::vector<Width> widths;
  std::optional<More> more, later;
  std::optional<double> bound;
  std::array<double, 2> ci95{1, 2};
  std::map<std::string, std::size_t> masked;
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
};

}  // namespace

template <>
struct Description<Width> {
  static constexpr auto fields() {
    return FieldList{field("alpha", "", per_channel(&Width::alpha), "width"),
                     field("colour", "", &Width::colour, "")};
  }
};
template <>
struct Description<More> {
  static constexpr auto fields() { return FieldList{field("steps", "", &More::steps, "")}; }
};
template <>
struct Description<Shown> {
  static constexpr auto fields() {
    return FieldList{constant_text("schema", "gonio.test/1"),
                     field("model", "", &Shown::model, "name"),
                     field("rms", "1/sr", &Shown::rms, "of f"),
                     field("values", "", &Shown::values, ""),
                     field("robust", "", &Shown::robust, ""),
                     field("widths", "", by_name(&Shown::widths), ""),
                     inlined(&Shown::more),
                     field("later", "", if_there(&Shown::later), ""),
                     group("errors", "how well it is known", field("bound", "", &Shown::bound, ""),
                           field("ci95", "", &Shown::ci95, "")),
                     field("masked", "", &Shown::masked, ""),
                     field("parameters", "", per_name(&Shown::parameters), ""),
                     field(
                         "twice", "", [](const Shown& s) { return 2 * s.values; }, "")};
  }
};

namespace {

static_assert(describes_every_member<Shown>());
static_assert(describes_every_member<More>());
static_assert(!describes_every_member<Width>(), "its name is a key, not a field");

Shown example() {
  Shown s;
  s.widths = {{"a", {0.5}, Colour::green}, {"b", {0.25, nan}, Colour::red}};
  s.masked = {{"zero", 4}};
  s.parameters = {{"kd", {0.5, nan}}, {"alpha", {0.25}}};
  return s;
}

/// Were each name looked for among all others, it would take half an hour.
TEST(JsonOf, AMillionNamesTakesLinearTime) {
  std::vector<std::pair<std::string, std::vector<double>>> all;
  for (std::size_t i = 0; i < 1'000'000; ++i) all.push_back({std::to_string(i), {1.0, 2.0}});
  EXPECT_EQ(json_of(PerName<const decltype(all)&>{all}).size(), all.size());
}

TEST(JsonOf, HasTheFieldsInTheirOrderAndForms) {
  EXPECT_EQ(
      json_of(example()).dump(),
      R"({"schema":"gonio.test/1","model":"ggx","rms":0.12345678,"values":3,"robust":false,)"
      R"("widths":{"a":{"alpha":0.5,"colour":"green"},"b":{"alpha":[0.25,null],"colour":"red"}},)"
      R"("errors":{"bound":null,"ci95":[1.0,2.0]},"masked":{"zero":4},"parameters":{"kd":[0.5,null],"alpha":0.25},"twice":6})");
}

TEST(JsonOf, AnOptionalStructIsAmongTheFieldsOrAKeyWhereItIsThere) {
  Shown s = example();
  s.more = More{7};
  s.later = More{8};
  const Json j = json_of(s);
  EXPECT_EQ(j["steps"], 7);
  EXPECT_EQ(j["later"]["steps"], 8);
}

TEST(JsonOf, WhatIsNotFiniteIsNullAndPagesHaveSixDigits) {
  EXPECT_TRUE(json_of(nan).is_null());
  EXPECT_TRUE(json_of(-std::numeric_limits<double>::infinity()).is_null());
  EXPECT_EQ(json_of(std::vector{0.12345678, nan}, Digits::six).dump(), "[0.123457,null]");
  EXPECT_EQ(json_of(std::vector{true, false}).dump(), "[true,false]");
}

TEST(SchemaOf, SaysWhatEachKeyMayHoldAndWhichMustBeThere) {
  const Json s = schema_of<Shown>();
  const Json& p = s["properties"];
  EXPECT_EQ(
      s["required"].dump(),
      R"(["schema","model","rms","values","robust","widths","errors","masked","parameters","twice"])");
  EXPECT_EQ(s["additionalProperties"], false);
  EXPECT_EQ(p["schema"].dump(), R"({"const":"gonio.test/1"})");
  EXPECT_EQ(p["rms"].dump(), R"({"type":["number","null"],"description":"of f [1/sr]"})");
  EXPECT_EQ(p["values"].dump(), R"({"type":"integer","minimum":0})");
  EXPECT_EQ(p["robust"].dump(), R"({"type":"boolean"})");
  EXPECT_EQ(p["steps"].dump(), R"({"type":"integer"})");
  const Json& width = p["widths"]["additionalProperties"]["properties"];
  EXPECT_EQ(width["alpha"]["anyOf"].dump(),
            R"([{"type":["number","null"]},{"type":"array","items":{"type":["number","null"]}}])");
  EXPECT_EQ(width["colour"].dump(), R"({"enum":["red","green"]})");
  EXPECT_EQ(p["later"]["properties"]["steps"].dump(), R"({"type":"integer"})");
  const Json& errors = p["errors"]["properties"];
  EXPECT_EQ(errors["bound"].dump(), R"({"type":["number","null"]})");
  EXPECT_EQ(errors["ci95"]["maxItems"], 2);
  EXPECT_EQ(p["errors"]["description"], "how well it is known");
  EXPECT_EQ(p["masked"]["additionalProperties"].dump(), R"({"type":"integer","minimum":0})");
}

TEST(SchemaOf, AnOptionalMayBeNull) {
  EXPECT_EQ(schema_of<std::optional<Colour>>().dump(), R"({"enum":["red","green",null]})");
  EXPECT_EQ(schema_of<std::optional<std::string>>().dump(), R"({"type":["string","null"]})");
  EXPECT_EQ(schema_of<std::optional<More>>()["type"].dump(), R"(["object","null"])");
  EXPECT_EQ(schema_of<std::optional<Json>>().dump(), R"({"anyOf":[{},{"type":"null"}]})");
}

TEST(CsvCells, StandUnderTheirColumns) {
  constexpr FieldList fields{field("model", "", &Shown::model, ""),
                             field("rms", "1/sr", &Shown::rms, ""),
                             field("values", "", &Shown::values, "")};
  Shown s = example();
  EXPECT_EQ(csv_columns(fields), "model,rms,values");
  EXPECT_EQ(csv_cells(fields, s), "ggx,0.12345678,3");
  s.model = "=a,b";
  s.rms = nan;
  EXPECT_EQ(csv_cells(fields, s), "\"'=a,b\",,3");
}

}  // namespace
}  // namespace gonio
