// The schemas that the program prints, and that what it writes keeps them.
#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.h"
#include "refusal.h"
#include "scene/description/scene.h"
#include "scene/description/scene_example.h"
#include "stack/stack.h"

#if __has_include(<valijson/validator.hpp>)
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#define GONIO_HAS_VALIDATOR
#endif

namespace gonio::test {
namespace {

using nlohmann::json;

/// Schema as the program prints it.
const json& schema_of(const std::string& name) {
  static std::map<std::string, json> known;
  const auto [at, is_new] = known.try_emplace(name);
  if (is_new) {
    const Folder f;
    const auto o = gonio(f, "schema " + name);
    EXPECT_EQ(o.code, 0) << o.err;
    at->second = o.json();
  }
  return at->second;
}

TEST(Schemas, OfEachNameThatIsListedArePrinted) {
  const Folder f;
  std::istringstream names(gonio(f, "schema").out);
  std::size_t count = 0;
  for (std::string name; std::getline(names, name); ++count) {
    EXPECT_EQ(schema_of(name)["$schema"], "http://json-schema.org/draft-07/schema#") << name;
    EXPECT_TRUE(schema_of(name).contains("properties") || schema_of(name).contains("anyOf"))
        << name;
  }
  EXPECT_GT(count, 30U);
  EXPECT_EQ(gonio(f, "schema fits").code, 2);
}

#ifdef GONIO_HAS_VALIDATOR

/// Mistakes of a document by a schema, one a line; "" of none.
std::string mistakes(const json& document, const std::string& schema) {
  valijson::Schema rules;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_of(schema)), rules);
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(rules, valijson::adapters::NlohmannJsonAdapter(document), &results))
    return "";
  std::string lines;
  for (valijson::ValidationResults::Error e; results.popError(e);) {
    for (const auto& place : e.context) lines += place;
    lines += ": " + e.description + "\n";
  }
  return lines;
}
json file(const std::string& path) {
  return json::parse(read_bytes(path));
}

/// Tables with and without a highlight, of three channels and of one, of one sample, and a broken one.
void make_tables(const Folder& f) {
  EXPECT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane --seed 1 -o a.csv").code,
            0);
  EXPECT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout mbsdf --noise 0.02 -o b.mbsdf").code, 0);
  EXPECT_EQ(gonio(f, "synth lambert --set kd=0.2 --layout random -o c.csv").code, 0);
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o,f\n0,0,0,0,1\n");
  f.write("e.csv", "theta_i");
}

TEST(Schemas, HoldForTheDocumentsOfTables) {
  const Folder f;
  make_tables(f);
  for (const std::string table : {"a.csv", "b.mbsdf", "c.csv", "d.csv"}) {
    const auto o = gonio(f, "inspect " + table + " --json --html page.html");
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(mistakes(o.json(), "inspect"), "") << table;
    EXPECT_EQ(mistakes(file(f / "page.page.json"), "inspect.page"), "") << table;
  }
  const auto planned = gonio(f, "inspect a.csv --plan-next 3 --json");
  ASSERT_EQ(planned.code, 0) << planned.err;
  EXPECT_EQ(mistakes(planned.json(), "inspect"), "");
}

TEST(Schemas, HoldForTheDocumentsOfFits) {
  const Folder f;
  make_tables(f);
  for (const std::string words :
       {"a.csv", "b.mbsdf --robust huber", "c.csv --model lambert --fix kd=0.2",
        "a.csv --model gltf", "d.csv --metric relative"}) {
    const auto o = gonio(f, "fit " + words + " --json -o fit.json --html page.html");
    ASSERT_TRUE(o.code == 0 || o.code == 4) << words << o.err;
    EXPECT_EQ(mistakes(o.json(), "fit"), "") << words;
    EXPECT_EQ(mistakes(file(f / "page.page.json"), "fit.page"), "") << words;
    const std::string table = words.substr(0, words.find(' '));
    const auto compared = gonio(f, "compare " + table + " fit.json --json");
    if (table == "d.csv") {
      EXPECT_EQ(compared.code, 3) << "of one sample nothing is known to compare with";
    } else {
      ASSERT_EQ(compared.code, 0) << words << compared.err;
      EXPECT_EQ(mistakes(compared.json(), "compare"), "") << words;
    }
  }
}

TEST(Schemas, HoldForTheDocumentsOfModels) {
  const Folder f;
  make_tables(f);
  for (const std::string words : {"b.mbsdf", "a.csv --fix alpha=0.2", "c.csv"}) {
    const auto o = gonio(f, "fit " + words +
                                " --models lambert,ggx/smith_ggx.correlated/schlick --json --html "
                                "page.html");
    ASSERT_EQ(o.code, 0) << words << o.err;
    EXPECT_EQ(mistakes(o.json(), "models"), "") << words;
    EXPECT_EQ(mistakes(file(f / "page.page.json"), "models.page"), "") << words;
  }
}

TEST(Schemas, HoldForTheDocumentsOfABatch) {
  const Folder f;
  make_tables(f);
  const auto o = gonio(f, "fit a.csv b.mbsdf c.csv e.csv nothing.csv -o out --json");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(mistakes(o.json(), "batch"), "");
  EXPECT_EQ(mistakes(file(f / "out/summary.page.json"), "batch"), "");
  EXPECT_EQ(mistakes(file(f / "out/b.json"), "fit"), "");
  EXPECT_EQ(mistakes(file(f / "out/e.json"), "failure"), "");
  EXPECT_EQ(mistakes(file(f / "out/summary.list.json"), "list"), "");
  EXPECT_EQ(gonio(f, "fit a.csv c.csv --metric relative -o out --part 1/2").code, 0);
  const auto gathered = gonio(f, "gather out --json");
  EXPECT_EQ(gathered.code, 1);
  EXPECT_EQ(mistakes(gathered.json(), "batch"), "");
  EXPECT_FALSE(gathered.json()["missing"].empty());
  EXPECT_FALSE(gathered.json()["left_out"].empty());
}

TEST(Schemas, HoldForStacksAndMaps) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint +
                         " --layout map --size 6 --images 9 --noise 0.01 -o s")
                .code,
            0);
  EXPECT_EQ(mistakes(file(f / "s/stack.json"), "stack"), "");
  const auto o = gonio(f, "fit_map s/stack.json --fix f0=0.05 -o maps.exr --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(mistakes(o.json(), "map"), "");
  const auto tiles = gonio(f, "fit_map s/stack.json --fix f0=0.05 --tile 0,0 -o t --json");
  ASSERT_EQ(tiles.code, 0) << tiles.err;
  EXPECT_EQ(mistakes(tiles.json(), "map_tiles"), "");
}

/// Places of all values of a document.
void places(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& all) {
  if (!at.empty()) all.push_back(at);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) places(member, at / key, all);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) places(value[i], at / i, all);
}

/// Judges documents that differ from a whole one in one place: nothing is there, another value, or a further name.
/// \param too_much  a number beyond all bounds
/// \param open  objects that take any name
template <class Judge>
void judge_slips(const json& whole,
                 double too_much,
                 const std::vector<std::string>& open,
                 const Judge& judge) {
  std::vector<json::json_pointer> all;
  places(whole, json::json_pointer(), all);
  for (const auto& at : all) {
    json without = whole;
    json& above = without[at.parent_pointer()];
    if (above.is_array())
      above.erase(std::stoul(at.back()));
    else
      above.erase(at.back());
    judge(without);
    for (const json& other :
         {json(nullptr), json(true), json("words"), json(""), json(-1), json(0), json(0.5),
          json(too_much), json::array(), json::array({1, 2, 3}), json::object()}) {
      json with = whole;
      with[at] = other;
      judge(with);
    }
    if (whole[at].is_object() && std::ranges::find(open, at.back()) == open.end()) {
      json with = whole;
      with[at]["further"] = 1;
      judge(with);
    }
  }
}

/// A stack with each value left out, replaced by others, and with a key too many: schema and reader refuse the same, but for what a
/// schema cannot say.
TEST(Schemas, OfStacksRefuseWhatTheReaderRefuses) {
  const Folder f;
  std::size_t both = 0, neither = 0;
  const auto judge = [&](const json& document) {
    const std::string path = f.write("s.json", document.dump());
    const std::string line = refusal([&] { read_stack(path); });
    const bool refused = !mistakes(document, "stack").empty();
    both += refused && !line.empty();
    neither += !refused && line.empty();
    if (refused == !line.empty()) return;
    EXPECT_NE(line.find("z above 0"), line.npos) << document << line;
  };
  const json whole = json::parse(
      R"({"schema": "gonio.stack/1", "values": "f_r", "normals": "n.exr", "channels": ["R"],
          "truth": {"model": "lambert", "parameters": "p.exr", "noise": 0.1, "seed": 3},
          "images": [{"path": "a", "theta_i": 3, "phi_i": 4, "view": [0, 0, 1], "scale": 2},
                     {"path": "b", "light_map": "l.exr", "theta_o": 4}]})");
  judge(whole);
  EXPECT_EQ(neither, 1U);
  judge_slips(whole, 1e31, {}, judge);
  EXPECT_GT(both, 150U);
  EXPECT_GT(neither, 20U);
}

TEST(Schemas, HoldForTheAnswersOfStability) {
  const Folder f;
  for (const auto& [words, code] :
       {std::pair("ndf.ggx --domain alpha=0.1,0.11 --require relative=0.02", 0),  // every half
        std::pair("ndf.ggx --number float --domain alpha=1e-3,1", 0),             // proved, a range
        std::pair("ndf.ggx --domain alpha=0.001,0.0012", 1),          // infinite where it fails
        std::pair("ndf.ggx --number mixed --domain alpha=0.1,1", 1),  // open, of no proof
        std::pair("fresnel.dielectric --number float --boxes 2 --require nonnegative", 1),
        std::pair("fresnel.constant --number double", 0),  // nothing that decides
        std::pair("ndf.ggx --any-gpu --domain alpha=0.1,0.2", 0),
        std::pair("ndf.ggx --any-gpu --domain alpha=0.1,0.2 --require relative=1e-3", 1)}) {
    const auto o = gonio(f, std::string("stability ") + words + " --json");
    EXPECT_EQ(o.code, code) << words << o.err;
    EXPECT_EQ(mistakes(o.json(), "stability"), "") << words;
  }
}

TEST(Schemas, HoldForTheSideFilesOfTables) {
  const Folder f;
  make_tables(f);
  const auto expect_side = [&](const std::string& words, const std::string& table) {
    ASSERT_EQ(gonio(f, words).code, 0) << words;
    EXPECT_EQ(mistakes(file(f / (table + ".gonio.json")), "table"), "") << words;
  };
  expect_side("convert a.csv b.csv --channels g", "b.csv");
  expect_side("convert b.mbsdf c.mbsdf --to-bins edge", "c.mbsdf");
  f.write("map.csv", "a line\nnm;in;out;a;b\n500;0,1;0,2;1;3\n600;0,1;0,2;2;4\n");
  expect_side(
      "columns map.csv --skip 1 --map theta_i=in theta_o=#3 f=b channel=nm --radians "
      "--cosine --forward 0 --scale 0.5",
      "map.csv");
  expect_side("columns map.csv --skip 1 --map theta_i=in theta_o=out f_a=a 'f_b c=b' weight=1",
              "map.csv");
}

TEST(Schemas, OfSideFilesRefuseWhatTheReaderRefuses) {
  const Folder f;
  f.write("t.csv", "theta_i,theta_o,f\n0,10,1\n");
  const auto judged = [&](const std::string& keys) {
    const std::string text = R"({"schema": "gonio.table/1")" + keys + "}";
    f.write("t.csv.gonio.json", text);
    const bool read = gonio(f, "inspect t.csv").code == 0;
    EXPECT_EQ(mistakes(json::parse(text), "table").empty(), read) << keys;
    return read;
  };
  for (const char* keys :
       {"", R"(, "notes": {"by": "hand"})", R"(, "columns": {})",
        R"(, "columns": {"theta_i": "#1", "f": "#3", "unit": "degrees", "forward": -90})",
        R"(, "columns": {"f_\n": "f", "weight": "0.5", "cosine": true, "skip": 0})",
        R"(, "truth": {"model": "lambert", "parameters": {"kd": [1, 0.5]}, "noise": 0, "floor": 0,)"
        R"( "outliers": 0, "seed": 1})"})
    EXPECT_TRUE(judged(keys)) << keys;
  for (const char* keys :
       {R"(, "note": {})", R"(, "notes": {"by": 1})", R"(, "bins": "middle")",
        R"(, "columns": {"thetai": "f"})", R"(, "columns": {"f_": "f"})",
        R"(, "columns": {"f": 4})", R"(, "columns": {"unit": "grad"})",
        R"(, "columns": {"skip": -1})", R"(, "columns": {"cosine": 1})", R"(, "truth": {})"})
    EXPECT_FALSE(judged(keys)) << keys;
}

/// A scene with each value left out, replaced by others, and with a key too many: schema and reader refuse the same, but for what a
/// schema cannot say.
TEST(Schemas, OfScenesRefuseWhatTheReaderRefuses) {
  const Folder f;
  std::size_t both = 0, neither = 0;
  const auto judge = [&](const json& document) {
    const std::string path = f.write("s.json", document.dump());
    const std::string line = refusal([&] { scene::read_scene(path); });
    const bool refused = !mistakes(document, "scene").empty();
    both += refused && !line.empty();
    neither += !refused && line.empty();
    if (refused == !line.empty()) return;
    EXPECT_FALSE(line.empty()) << "read: " << document;
    bool beyond_a_schema = false;
    for (const char* words :
         {"expected a model", "expected parameters of the model", "expected one of the materials",
          "a metal's symbol", "a number, or one per channel", "not 0", "[low, high]",
          "from limit on", "black lights", "opening:"})
      beyond_a_schema |= line.find(words) != line.npos;
    EXPECT_TRUE(beyond_a_schema) << line;
  };
  const json whole = json::parse(scene::test::example().dump());
  judge(whole);
  EXPECT_EQ(neither, 1U);
  judge_slips(whole, 1e13, {"materials", "parameters"}, judge);
  EXPECT_GT(both, 500U);
  EXPECT_GT(neither, 100U);
}

TEST(Schemas, RefuseADocumentThatHasLessOrMoreOrOtherValues) {
  const Folder f;
  make_tables(f);
  const json fit = gonio(f, "fit a.csv --json").json();
  const auto changed = [&](const char* at, const json& value) {
    json d = fit;
    d[json::json_pointer(at)] = value;
    return mistakes(d, "fit");
  };
  EXPECT_EQ(changed("/cost", nullptr), "") << "not known";
  EXPECT_NE(changed("/cost", "much"), "");
  EXPECT_NE(changed("/schema", "gonio.fit/2"), "");
  EXPECT_NE(changed("/solver/another", 1), "");
  EXPECT_NE(changed("/parameters/alpha/status", "perhaps"), "");
  EXPECT_NE(changed("/parameters/alpha/ci95", {0.1}), "");
  EXPECT_NE(changed("/input/values_used", -1), "");
  json less = fit;
  less.erase("warnings");
  EXPECT_NE(mistakes(less, "fit"), "");
}

#endif

}  // namespace
}  // namespace gonio::test
