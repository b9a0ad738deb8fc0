#include "fitting/batch/batch_document.h"

#include <cmath>
#include <limits>

#include "base/file.h"
#include "refusal.h"
#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FitDocument a_fit() {
  using enum ParameterStatus;
  FitDocument d;
  d.model = "lambert";
  d.channels = {"r", "g", "b"};
  d.parameters = {{"alpha", {0.1}, {nan}, {nan}, {nan}, {fixed}, {nan}, {""}},
                  {"kd",
                   {0.3, nan, 0.1},
                   {0.01, nan, 0.02},
                   {0, 0, 0},
                   {1, 1, 1},
                   {free, not_identifiable, at_bound},
                   {nan, nan, nan},
                   {"", "", ""}}};
  d.residuals = {0.5, 0.25, {}};
  d.misfit.size = 0.125;
  d.misfit.told = true;
  d.cost = 1.0 / 3;
  d.values_used = 12;
  d.masked = {{"negative", 3}, {"zero", 4}};
  d.warnings = {"one", "two"};
  d.solver.termination = "converged";
  d.solver.message = "fine";
  d.solver.phase_ms = {{"load_ms", 1}, {"solve_ms", 2.5}};
  d.input_sha256 = "abc";
  return d;
}

BatchRow a_row() {
  BatchRow r{"in/a, \"b\".csv",
             "a.json",
             Exit::done,
             "fine",
             parse_document("a.json", batch_document(a_fit(), Preview{}, "made"))->row.fit,
             Preview{}};
  r.preview->curve = Thumbnail{"theta_i",
                               30,
                               "theta_o",
                               {0, 1, 2},
                               {-10, 10},
                               {-20, 20},
                               {{1, nan}, {1, 2}, {1, 2}},
                               {{3, 4}, {3, 4}, {3, 4}}};
  r.preview->albedo = {0.3, 0.2, 0.1};
  r.preview->sphere = "AP8QIGJ5dGVz";
  return r;
}

BatchRow a_failure() {
  return {"broken", "", Exit::bad_input, "broken: byte 0: found an empty file, expected data",
          {},       {}};
}

TEST(BatchDocument, CsvHasALinePerTableAndAColumnPerChannel) {
  BatchRow row = a_row();
  row.fit->parameters[1].status[1] = ParameterStatus::upper_limit;
  row.fit->parameters[1].limit = {nan, 0.07, nan};
  EXPECT_EQ(
      batch_csv({a_failure(), row}),
      "path,document,status,exit_code,model,alpha,alpha.std_error,alpha.status,alpha.limit,kd.r,"
      "kd.r.std_error,kd.r.status,kd.r.limit,kd.g,kd.g.std_error,kd.g.status,kd.g.limit,kd.b,"
      "kd.b.std_error,kd.b.status,kd.b.limit,log_rms,rms,cost,"
      "values_used,masked,misfit,misfit_told,warnings,message\n"
      "broken,,bad_input,3,,,,,,,,,,,,,,,,,,,,,,,,,,\"broken: byte 0: found an empty file, "
      "expected "
      "data\"\n"
      "\"in/a, \"\"b\"\".csv\",a.json,ok,0,lambert,0.1,,fixed,,0.3,0.01,free,,,,upper_limit,0.07,"
      "0.1,0.02,at_bound,,0.25,0.5,0.3333333333333333,12,7,0.125,true,2,fine\n");
}

/// Each table has the columns of all, and each name stands four times.
TEST(BatchDocument, OfMoreColumnsThanTablesHaveRoomForThereIsNoCsv) {
  BatchRow wide = a_row();
  auto& kd = wide.fit->parameters[1];
  constexpr std::size_t channels = 20'000;
  kd.value.assign(channels, 0.1), kd.std_error.assign(channels, nan);
  kd.status.assign(channels, ParameterStatus::free), kd.limit.assign(channels, nan);
  wide.fit->channels.clear();
  for (std::size_t c = 0; c < channels; ++c) wide.fit->channels.push_back(std::to_string(c));
  std::vector<BatchRow> rows(1000, a_failure());
  rows[0] = wide;
  EXPECT_HAS(test::refusal([&] { batch_csv(rows); }), "summary.csv: writing: found 67112 or more");
  rows.resize(10);
  EXPECT_EQ(test::refusal([&] { batch_csv(rows); }), "");
  rows[0].fit->parameters[1].name = std::string(10'000, 'k');
  EXPECT_HAS(test::refusal([&] { batch_csv(rows); }), "at most 67108864 cells and bytes");
}

TEST(BatchDocument, NoCellOfTextIsAFormula) {
  BatchRow broken = a_failure();
  broken.path = "=HYPERLINK(A1).csv";
  broken.message = "@SUM(A1)";
  BatchRow fine = a_row();
  fine.path = "-2+3.csv";
  fine.document = "+a.json";
  fine.fit->parameters[0].name = "=alpha";
  fine.fit->parameters[0].value = {-0.5};
  const std::string csv = batch_csv({broken, fine});
  EXPECT_NE(csv.find("\n\"'=HYPERLINK(A1).csv\",,bad_input,3,"), csv.npos) << csv;
  EXPECT_NE(csv.find(",\"'@SUM(A1)\"\n"), csv.npos) << csv;
  EXPECT_NE(csv.find("\n\"'-2+3.csv\",\"'+a.json\",ok,0,lambert,-0.5,,fixed,"), csv.npos) << csv;
  EXPECT_NE(csv.find(",\"'=alpha\",\"'=alpha.std_error\","), csv.npos) << csv;
}

TEST(BatchDocument, ADocumentReadBackGivesTheSameRow) {
  const test::Folder f;
  for (std::size_t bytes = 0; bytes < 9; ++bytes) {
    BatchRow row = a_row();
    row.preview->sphere.resize(bytes);
    write_file(f / "a.json", batch_document(a_fit(), *row.preview, "so"));
    auto back = read_batch_document(f / "a.json", "abc", "so");
    ASSERT_TRUE(back);
    back->path = row.path;
    back->document = row.document;
    EXPECT_EQ(batch_csv({*back}), batch_csv({row}));
    EXPECT_EQ(batch_json({"so", {*back}}, true), batch_json({"so", {row}}, true));
    EXPECT_EQ(back->preview->sphere, row.preview->sphere);
  }
}

TEST(BatchDocument, ADocumentOfOtherBytesOptionsOrHandsIsNotTaken) {
  const test::Folder f;
  const BatchRow row = a_row();
  const std::string text = batch_document(a_fit(), *row.preview, "so");
  write_file(f / "a.json", text);
  EXPECT_TRUE(read_batch_document(f / "a.json", "abc", "so"));
  EXPECT_TRUE(is_batch_document(f / "a.json"));
  EXPECT_FALSE(read_batch_document(f / "a.json", "abd", "so"));
  EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "otherwise"));
  EXPECT_FALSE(read_batch_document(f / "b.json", "abc", "so"));
  write_file(f / "alone.json", to_json(a_fit()));
  EXPECT_FALSE(is_batch_document(f / "alone.json"));
  for (std::size_t cut = 0; cut + 1 < text.size(); cut += 7) {  // the last byte ends a line
    write_file(f / "a.json", text.substr(0, cut));
    EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "so")) << cut;
  }
  for (const char* at :
       {"/channels", "/parameters/kd/status", "/solver/time_ms", "/input/masked",
        "/batch/preview/curve/data", "/batch/preview/sphere", "/cost", "/misfit/told"}) {
    json changed = json::parse(text);
    changed[json::json_pointer(at)] = json{{"not", {1, "this"}}};
    write_file(f / "a.json", changed.dump());
    EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "so")) << at;
  }
}

TEST(BatchDocument, ADocumentWhoseListsDifferInLengthIsNotTaken) {
  const test::Folder f;
  const BatchRow row = a_row();
  for (const auto& [at, list] : {std::pair("/parameters/kd/value", "[0.3, 0.2]"),
                                 {"/parameters/kd/value", "[1, 2, 3, 4]"},
                                 {"/parameters/kd/value", "[]"},
                                 {"/parameters/kd/std_error", "[0.1]"},
                                 {"/parameters/kd/status", R"(["free", "free"])"},
                                 {"/parameters/alpha/std_error", "[]"},
                                 {"/parameters/kd/limit", "[0.1]"},
                                 {"/channels", R"(["r"])"}}) {
    json changed = json::parse(batch_document(a_fit(), *row.preview, "so"));
    changed[json::json_pointer(at)] = json::parse(list);
    write_file(f / "a.json", changed.dump());
    EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "so")) << at << " " << list;
  }
}

TEST(BatchDocument, ADocumentWhoseRowWouldTakeMuchMemoryIsNotTaken) {
  const auto line = [](std::size_t warnings, std::size_t letters) {
    json d = json::parse(batch_document(a_fit(), *a_row().preview, "so"));
    d["warnings"] = json(std::vector<std::string>(warnings));
    d["batch"]["made_with"] = std::string(letters, 'm');
    return test::refusal([&] { parse_document("a.json", d.dump()); });
  };
  EXPECT_EQ(line(500'000, 1000), "");
  EXPECT_HAS(line(530'000, 1), "bytes that a summary shows of it, expected at most 16777216");
  EXPECT_HAS(line(500'000, 1'000'000), "the document: found");
}

TEST(BatchDocument, DataHoldEveryTableAndTheCounts) {
  const json all = json::parse(batch_json({"so", {a_failure(), a_row()}}, true));
  EXPECT_EQ(all["schema"], "gonio.batch/1");
  EXPECT_EQ(all["counts"],
            (json{{"ok", 1}, {"not_converged", 0}, {"bad_input", 1}, {"wrong_usage", 0}}));
  const json &broken = all["tables"][0], &fine = all["tables"][1];
  EXPECT_FALSE(broken.contains("parameters"));
  EXPECT_TRUE(broken["document"].is_null());
  EXPECT_EQ(fine["parameters"]["kd"]["value"], json::parse("[0.3, null, 0.1]"));
  EXPECT_EQ(fine["time_ms"], 3.5);
  EXPECT_EQ(fine["preview"]["sphere"], "AP8QIGJ5dGVz");
  EXPECT_FALSE(json::parse(batch_json({"so", {a_row()}}, false))["tables"][0].contains("preview"));
}

TEST(BatchDocument, OfATableWithoutAFitItSaysWhy) {
  const test::Folder f;
  write_file(f / "a.json", failure_document(a_failure(), "so"));
  EXPECT_TRUE(is_batch_document(f / "a.json"));
  EXPECT_FALSE(read_batch_document(f / "a.json", "", "so")) << "it is tried again";
  const auto back = read_document(f / "a.json");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->made_with, "so");
  EXPECT_EQ(batch_csv({back->row}), batch_csv({a_failure()}));
  write_file(f / "b.json", R"({"schema": "gonio.failure/1", "status": "ok"})");
  EXPECT_THROW(read_document(f / "b.json"), Error);
}

TEST(BatchDocument, OfAnythingElseNothingIsRead) {
  const test::Folder f;
  for (const char* text : {"[]", "3", "{}", R"({"schema": 1})", R"({"schema": "gonio.table/1"})"}) {
    write_file(f / "a.json", text);
    EXPECT_FALSE(read_document(f / "a.json")) << text;
  }
  write_file(f / "alone.json", to_json(a_fit()));
  EXPECT_FALSE(read_document(f / "alone.json")) << "no batch wrote it";
  write_file(f / "a.json", "{");
  EXPECT_THROW(read_document(f / "a.json"), Error);
}

TEST(BatchDocument, TellsWhatIsMissingAndWhatWasLeftOut) {
  const json all = json::parse(batch_json(
      {"so", {}, {"b.csv"}, {{"c.json", LeftOut::made_otherwise, "c.csv", "else", ""}}, "2/4"},
      false));
  EXPECT_EQ(all["part"], "2/4");
  EXPECT_EQ(all["missing"], json{"b.csv"});
  EXPECT_EQ(all["left_out"][0]["why"], "made_otherwise");
  EXPECT_TRUE(json::parse(batch_json({"so", {}}, false))["part"].is_null());
}

}  // namespace
}  // namespace gonio
