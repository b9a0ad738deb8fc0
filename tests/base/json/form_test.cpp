#include "base/json/form.h"

#include "refusal.h"

namespace gonio {
namespace {

enum class Unit { degrees, radians };

struct Point {
  double x = 1, y = 2, z = 3;
};
struct Ball {
  double radius = 0.5;
};
struct Box {
  Point size;
};
struct Thing {
  std::string name;
  Unit unit = Unit::degrees;
  std::array<double, 2> range{0, 1};
  std::uint64_t seed = 7;
  std::optional<double> budget;
  std::vector<Ball> balls;
  std::vector<std::pair<std::string, Ball>> named;
  std::variant<Ball, Box> shape;
  std::variant<Ball, Box> other;
  double inner = 1;
};

template <class Form>
void keys(Form& f, Ball& b) {
  f.required("radius", b.radius, "of it", Numbers{0, 10, true});
}
template <class Form>
void keys(Form& f, Box& b) {
  f.required("size", b.size, "");
}
template <class Form>
void keys(Form& f, Thing& t) {
  f.constant("schema", "thing/1");
  f.required("name", t.name, "");
  f.optional("unit", t.unit, "");
  f.optional("range", t.range, "both ends", Numbers{0, 1});
  f.optional("seed", t.seed, "");
  f.optional("budget", t.budget, "", Numbers{0, 5, false, true});
  f.optional("balls", t.balls, "", Entries{1, 2});
  f.optional("named", t.named, "", Entries{0, 2});
  f.by_name("shape", t.shape, {"ball", "box"});
  f.group("other", "", [&](auto& within) { within.by_key(t.other, {"radius", "size"}); });
  f.group("group", "", [&](auto& within) { within.optional("inner", t.inner, ""); });
  f.expect(t.range[0] <= t.range[1], "range", "[low, high]");
}

}  // namespace

template <>
inline constexpr std::array<std::string_view, 2> names_of<Unit>{"degrees", "radians"};

namespace {

Thing thing(const std::string& text) {
  const std::string file = "file";
  const Json document = parse_json(file, text);
  Thing t;
  read_form(JsonReader(file, document, "", Places::pointer), t);
  return t;
}

constexpr const char* kLeast =
    R"({"schema":"thing/1","name":"n","shape":"ball","radius":1,"other":{"radius":2},"group":{}})";

/// The least document with one more key, or another value of it.
std::string complaint(const std::string& key, const std::string& value) {
  Json document = Json::parse(kLeast);
  document[key] = Json::parse(value);
  return test::refusal([&] { thing(document.dump()); });
}

TEST(JsonForm, ReadsEveryKindOfValue) {
  const Thing t =
      thing(R"({"schema":"thing/1","name":"n","unit":"radians","range":[0.25,1],"seed":9,
    "budget":2,"balls":[{"radius":1},{"radius":2}],"named":{"a":{"radius":3}},"shape":"box","size":[4,5,6],
    "other":{"radius":7},"group":{"inner":8}})");
  EXPECT_EQ(t.name, "n");
  EXPECT_EQ(t.unit, Unit::radians);
  EXPECT_EQ(t.range, (std::array{0.25, 1.0}));
  EXPECT_EQ(t.seed, 9U);
  EXPECT_EQ(t.budget, 2.0);
  ASSERT_EQ(t.balls.size(), 2U);
  EXPECT_EQ(t.balls[1].radius, 2);
  ASSERT_EQ(t.named.size(), 1U);
  EXPECT_EQ(t.named[0].first, "a");
  EXPECT_EQ(t.named[0].second.radius, 3);
  EXPECT_EQ(std::get<Box>(t.shape).size.z, 6);
  EXPECT_EQ(std::get<Ball>(t.other).radius, 7);
  EXPECT_EQ(t.inner, 8);
}

TEST(JsonForm, KeepsWhatTheStructHasWhereAKeyIsLeftOut) {
  const Thing t = thing(kLeast);
  EXPECT_EQ(t.unit, Unit::degrees);
  EXPECT_EQ(t.range, (std::array{0.0, 1.0}));
  EXPECT_EQ(t.seed, 7U);
  EXPECT_FALSE(t.budget);
  EXPECT_EQ(t.inner, 1);
}

TEST(JsonForm, RefusesWithPlaceFoundAndExpected) {
  EXPECT_EQ(complaint("schema", "\"thing/2\""),
            "file: /schema: found \"thing/2\", expected thing/1");
  EXPECT_EQ(complaint("name", "\"\""),
            "file: /name: found \"\", expected a string that is not empty");
  EXPECT_EQ(complaint("unit", "\"grad\""),
            "file: /unit: found \"grad\", expected degrees or radians");
  EXPECT_EQ(complaint("range", "[0, 1.5]"),
            "file: /range/1: found 1.5, expected a number in [0, 1]");
  EXPECT_EQ(complaint("range", "[1, 0]"), "file: /range: found an array, expected [low, high]");
  EXPECT_EQ(complaint("range", "[1]"), "file: /range: found an array of 1, expected an array of 2");
  EXPECT_EQ(complaint("range", "1"), "file: /range: found 1, expected an array of 2");
  EXPECT_EQ(complaint("range", "[0, null]"),
            "file: /range/1: found null, expected a number in [0, 1]");
  EXPECT_EQ(complaint("radius", "0"), "file: /radius: found 0, expected a number in (0, 10]");
  EXPECT_EQ(complaint("budget", "5"), "file: /budget: found 5, expected a number in [0, 5)");
  EXPECT_EQ(complaint("seed", "-1"), "file: /seed: found -1, expected a whole number");
  EXPECT_EQ(complaint("balls", "[]"),
            "file: /balls: found an array of 0, expected an array of 1 to 2");
  EXPECT_EQ(complaint("balls", "[{\"radius\":\"a\"}]"),
            "file: /balls/0/radius: found \"a\", expected a number in (0, 10]");
  EXPECT_EQ(complaint("named", "{\"a/b~\":{}}"),
            "file: /named/a~1b~0/radius: found nothing, expected a value");
  EXPECT_EQ(complaint("named", "{\"\":{}}"),
            "file: /named/: found a key without a name, expected a name");
  EXPECT_EQ(complaint("shape", "\"cone\""), "file: /shape: found \"cone\", expected ball or box");
  EXPECT_EQ(complaint("other", "{}"),
            "file: /other: found none of its keys, expected one of radius or size");
  EXPECT_EQ(complaint("other", R"({"radius":1,"size":[1,1,1]})"),
            "file: /other: found radius and size, expected one of radius or size");
  EXPECT_EQ(complaint("group", "{\"outer\":1}"),
            "file: /group/outer: found 1, expected no such key; inner");
  EXPECT_HAS(complaint("size", "[1,1,1]"),
             "file: /size: found an array, expected no such key; schema, name");
}

TEST(JsonForm, RefusesALongListBeforeItIsTakenApart) {
  std::string balls = "[0";
  for (int i = 0; i < 1'000'000; ++i) balls += ",0";
  EXPECT_EQ(complaint("balls", balls + "]"),
            "file: /balls: found an array of 1000001, expected an array of 1 to 2");
}

TEST(JsonForm, HasASchemaOfTheSameKeysValuesAndDefaults) {
  const Json schema = form_schema_of<Thing>();
  ASSERT_EQ(schema["anyOf"].size(), 2U) << "one alternative for each shape";
  const Json& ball = schema["anyOf"][0];
  EXPECT_EQ(ball["required"].dump(), R"(["schema","name","shape","radius","other","group"])");
  EXPECT_EQ(ball["additionalProperties"], false);
  const Json& of = ball["properties"];
  EXPECT_EQ(of["shape"].dump(), R"({"const":"ball"})");
  EXPECT_EQ(of["radius"].dump(),
            R"({"type":"number","exclusiveMinimum":0.0,"maximum":10.0,"description":"of it"})");
  EXPECT_EQ(of["unit"].dump(), R"({"enum":["degrees","radians"],"default":"degrees"})");
  EXPECT_EQ(
      of["range"].dump(),
      R"({"type":"array","items":{"type":"number","minimum":0.0,"maximum":1.0},"minItems":2,"maxItems":2,)"
      R"("default":[0.0,1.0],"description":"both ends"})");
  EXPECT_EQ(of["budget"].dump(), R"({"type":"number","minimum":0.0,"exclusiveMaximum":5.0})");
  EXPECT_EQ(of["other"]["anyOf"].size(), 2U);
  EXPECT_EQ(schema["anyOf"][1]["properties"]["size"]["items"].dump(), R"({"type":"number"})");
}

}  // namespace
}  // namespace gonio
