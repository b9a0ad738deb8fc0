#include <cmath>
#include <limits>
#include <variant>

#include "base/json/describe.h"
#include "refusal.h"

#include <nlohmann/json.hpp>

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
  double inner = 1, known = 2;
  std::vector<double> widths;
  std::int16_t steps = 0;
};

}  // namespace

template <>
inline constexpr std::array<std::string_view, 2> names_of<Unit>{"degrees", "radians"};

template <>
struct Description<Ball> {
  static constexpr auto fields() {
    return FieldList{field("radius", "", &Ball::radius, "of it", Numbers{0, 10, true})};
  }
};
template <>
struct Description<Box> {
  static constexpr auto fields() { return FieldList{field("size", "", &Box::size, "", Numbers{})}; }
};
template <>
struct Description<Thing> {
  static constexpr auto fields() {
    return FieldList{
        constant_text("schema", "thing/1"),
        field("name", "", &Thing::name, "", not_empty),
        field("unit", "", &Thing::unit, "", or_default),
        field("range", "", &Thing::range, "both ends", Numbers{0, 1}, or_default),
        field("seed", "", &Thing::seed, "", or_default),
        field("steps", "", &Thing::steps, "", or_default),
        field("budget", "", if_there(&Thing::budget), "", Numbers{0, 5, false, true}),
        field("balls", "", &Thing::balls, "", Entries{1, 2}, or_default),
        field("named", "", &Thing::named, "", Entries{0, 2}, or_default),
        by_name("shape", &Thing::shape, "ball", "box"),
        group("other", "", by_key(&Thing::other)),
        group("group", "", field("inner", "", &Thing::inner, "", or_default)),
        field("known", "", &Thing::known, "null where it is not", or_default),
        field("widths", "", per_channel(&Thing::widths), "one or one per channel", or_default),
        field(
            "twice", "", [](const Thing& t) { return 2 * t.steps; }, "not read", or_default)};
  }
  static void check(Thing& t, Demand expect) {
    expect(t.range[0] <= t.range[1], "range", "[low, high]");
  }
};

namespace {

Thing thing(const std::string& text) {
  const std::string file = "file";
  const Json document = parse_json(file, text);
  Thing t;
  read_record(JsonReader(file, document, "", Places::pointer), t);
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

TEST(ReadRecord, ReadsEveryKindOfValue) {
  const Thing t =
      thing(R"({"schema":"thing/1","name":"n","unit":"radians","range":[0.25,1],"seed":9,"steps":-3,
    "known":null,"widths":0.5,"budget":2,"balls":[{"radius":1},{"radius":2}],"named":{"a":{"radius":3}},"shape":"box","size":[4,5,6],
    "other":{"radius":7},"group":{"inner":8}})");
  EXPECT_EQ(t.name, "n");
  EXPECT_EQ(t.unit, Unit::radians);
  EXPECT_EQ(t.range, (std::array{0.25, 1.0}));
  EXPECT_EQ(t.seed, 9U);
  EXPECT_EQ(t.steps, -3);
  EXPECT_TRUE(std::isnan(t.known));
  EXPECT_EQ(t.widths, (std::vector{0.5}));
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

TEST(ReadRecord, KeepsWhatTheStructHasWhereAKeyIsLeftOut) {
  const Thing t = thing(kLeast);
  EXPECT_EQ(t.unit, Unit::degrees);
  EXPECT_EQ(t.range, (std::array{0.0, 1.0}));
  EXPECT_EQ(t.seed, 7U);
  EXPECT_FALSE(t.budget);
  EXPECT_EQ(t.inner, 1);
}

TEST(ReadRecord, RefusesWithPlaceFoundAndExpected) {
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
  EXPECT_EQ(complaint("steps", "-32769"),
            "file: /steps: found -32769, expected a number of fewer digits");
  EXPECT_EQ(complaint("steps", "32768"),
            "file: /steps: found 32768, expected a number of fewer digits");
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
             "file: /size: found an array, expected no such key; nearest: name, of schema, name");
}

TEST(ReadRecord, RefusesALongListBeforeItIsTakenApart) {
  std::string balls = "[0";
  for (int i = 0; i < 1'000'000; ++i) balls += ",0";
  EXPECT_EQ(complaint("balls", balls + "]"),
            "file: /balls: found an array of 1000001, expected an array of 1 to 2");
}

TEST(SchemaOf, SaysWhatAReadKeyTakesAndWhatItIsWhenLeftOut) {
  const Json schema = schema_of<Thing>();
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

/// What is written is read as it was, not-a-number too.
TEST(ReadRecord, GivesBackWhatIsWritten) {
  Thing t;
  t.name = "n";
  t.unit = Unit::radians;
  t.budget = 0.1;
  t.balls = {{0.25}, {0.5}};
  t.named = {{"b", {1}}, {"a", {2}}};
  t.shape = Box{{4, 5, 6}};
  t.other = Ball{3};
  t.known = std::numeric_limits<double>::quiet_NaN();
  t.widths = {0.5, std::numeric_limits<double>::quiet_NaN()};
  t.steps = -4;
  const std::string text = json_text(t);
  EXPECT_HAS(text, "\"known\": null");
  const Thing back = thing(text);
  EXPECT_EQ(json_text(back), text);
  EXPECT_EQ(back.widths.size(), 2U);
  EXPECT_EQ(back.balls.size(), 2U);
  EXPECT_EQ(back.named.back().second.radius, 2);
  EXPECT_EQ(std::get<Box>(back.shape).size.y, 5);
  EXPECT_EQ(back.steps, -4);
}

TEST(ReadRecord, RefusesAKeyThatIsNotWhatItSays) {
  for (const auto& [key, value] :
       {std::pair("name", "7"), std::pair("unit", "0"), std::pair("seed", "1.5"),
        std::pair("steps", "true"), std::pair("balls", "{}"), std::pair("named", "[]"),
        std::pair("other", "[1]"), std::pair("group", "\"\""), std::pair("known", "\"2\""),
        std::pair("widths", "[[1]]"), std::pair("shape", "{}"), std::pair("schema", "null")}) {
    const std::string line = complaint(key, value);
    EXPECT_HAS(line, std::string("file: /") + key);
    EXPECT_EQ(line.find('\n'), line.npos) << line;
  }
}

/// The document with some text in place of its end.
std::string complaint_of(const std::string& more) {
  std::string text = kLeast;
  text.replace(text.size() - 1, 1, "," + more + "}");
  return test::refusal([&] { thing(text); });
}

TEST(ReadRecord, RefusesBracketsTenThousandDeepInOneLine) {
  const std::string deep(10'000, '['), shallow(10'000, ']');
  const std::string line = complaint_of("\"balls\":" + deep + shallow);
  EXPECT_HAS(line, "65 levels of brackets");
  EXPECT_EQ(line.find('\n'), line.npos);
}

TEST(ReadRecord, TakesTheLastOfAKeyThatIsRepeated) {
  std::string text = kLeast;
  text.replace(text.size() - 1, 1, R"(,"seed":1,"seed":2,"name":"m"})");
  EXPECT_EQ(thing(text).seed, 2U);
  EXPECT_EQ(thing(text).name, "m");
}

TEST(ReadRecord, ReadsANumberOfTenThousandDigitsOrRefusesItInOneLine) {
  const std::string digits(10'000, '1');
  std::string text = kLeast;
  text.replace(text.size() - 1, 1, ",\"known\":0." + digits + "}");
  EXPECT_DOUBLE_EQ(thing(text).known, 1.0 / 9);
  for (const char* key : {"known", "seed", "steps", "balls"}) {
    const std::string line = complaint_of('"' + std::string(key) + "\":" + digits);
    EXPECT_NE(line, "") << key;
    EXPECT_LT(line.size(), 1000U) << key;
    EXPECT_EQ(line.find('\n'), line.npos) << key;
  }
  const std::string long_seed = complaint_of("\"seed\":1" + std::string(20, '0'));
  EXPECT_HAS(long_seed, "expected a whole number");
}

struct Quiet {
  double upper = std::numeric_limits<double>::infinity();
  std::string note;
  std::vector<int> list;
};

}  // namespace

template <>
struct Description<Quiet> {
  static constexpr bool has_others = true;
  static constexpr auto fields() {
    return FieldList{field("upper", "", if_there(&Quiet::upper), "", Numbers{}),
                     field("note", "", if_there(&Quiet::note), ""),
                     field("list", "", if_there(&Quiet::list), "")};
  }
};

namespace {

TEST(JsonOf, LeavesOutWhatSaysNothing) {
  EXPECT_EQ(json_line(Quiet{}), "{}");
  EXPECT_EQ(json_line(Quiet{1, "n", {2}}), R"({"upper":1.0,"note":"n","list":[2]})");
  EXPECT_EQ(schema_of<Quiet>()["required"].size(), 0U);
}

TEST(ReadRecord, PassesOverOtherKeysWhereADescriptionSaysSo) {
  const std::string file = "file";
  const JsonDocument document(file, R"({"others":[{}],"note":"n"})");
  Quiet q;
  read_record(document.root(), q);
  EXPECT_EQ(q.note, "n");
  EXPECT_TRUE(std::isinf(q.upper));
  EXPECT_EQ(schema_of<Quiet>()["additionalProperties"], true);
}

}  // namespace
}  // namespace gonio
