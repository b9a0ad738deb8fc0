#include "reports/tables/batch_page.h"

#include <cmath>
#include <limits>

#include "base/file.h"
#include "reports/tables.h"
#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BatchRow a_row() {
  using enum ParameterStatus;
  BatchRow r{"in/a, \"b\".csv", "a.json", Exit::done, "fine", {}, {}};
  r.fit.model = "lambert";
  r.fit.channels = {"r", "g", "b"};
  r.fit.parameters = {{"alpha", {0.1}, {nan}, {nan}, {nan}, {fixed}},
                      {"kd",
                       {0.3, nan, 0.1},
                       {0.01, nan, 0.02},
                       {0, 0, 0},
                       {1, 1, 1},
                       {free, not_identifiable, at_bound}}};
  r.fit.residuals = {0.5, 0.25, {}};
  r.fit.cost = 1.0 / 3;
  r.fit.values_used = 12;
  r.fit.masked = {{"negative", 3}, {"zero", 4}};
  r.fit.warnings = {"one", "two"};
  r.fit.solver.termination = "converged";
  r.fit.solver.message = "fine";
  r.fit.solver.phase_ms = {{"load_ms", 1}, {"solve_ms", 2.5}};
  r.fit.input_sha256 = "abc";
  r.preview.curve = {"theta_i",
                     30,
                     "theta_o",
                     {0, 1, 2},
                     {-10, 10},
                     {-20, 20},
                     {{1, nan}, {1, 2}, {1, 2}},
                     {{3, 4}, {3, 4}, {3, 4}}};
  r.preview.albedo = {0.3, 0.2, 0.1};
  r.preview.sphere = std::string("\0\xff\x10 bytes", 9);
  return r;
}

BatchRow a_failure() {
  return {"broken", "", Exit::bad_input, "broken: byte 0: found an empty file, expected data",
          {},       {}};
}

TEST(BatchPage, CsvHasALinePerTableAndAColumnPerChannel) {
  EXPECT_EQ(
      batch_csv({a_failure(), a_row()}),
      "path,document,status,exit_code,model,alpha,alpha.std_error,alpha.status,kd.r,kd.r.std_error,"
      "kd.r.status,kd.g,kd.g.std_error,kd.g.status,kd.b,kd.b.std_error,kd.b.status,log_rms,rms,"
      "cost,"
      "values_used,masked,warnings,message\n"
      "broken,,bad_input,3,,,,,,,,,,,,,,,,,,,,\"broken: byte 0: found an empty file, expected "
      "data\"\n"
      "\"in/a, \"\"b\"\".csv\",a.json,ok,0,lambert,0.1,,fixed,0.3,0.01,free,,,not_identifiable,0.1,"
      "0.02,at_bound,0.25,0.5,0.3333333333333333,12,7,2,fine\n");
}

TEST(BatchPage, ADocumentReadBackGivesTheSameRow) {
  const test::Folder f;
  for (std::size_t bytes = 0; bytes < 9; ++bytes) {
    BatchRow row = a_row();
    row.preview.sphere.resize(bytes);
    write_file(f / "a.json", batch_document(row.fit, row.preview, "so"));
    auto back = read_batch_document(f / "a.json", "abc", "so");
    ASSERT_TRUE(back);
    back->path = row.path;
    back->document = row.document;
    EXPECT_EQ(batch_csv({*back}), batch_csv({row}));
    EXPECT_EQ(batch_json({*back}, "so", true), batch_json({row}, "so", true));
    EXPECT_EQ(back->preview.sphere, row.preview.sphere);
  }
}

TEST(BatchPage, ADocumentOfOtherBytesOptionsOrHandsIsNotTaken) {
  const test::Folder f;
  const BatchRow row = a_row();
  const std::string text = batch_document(row.fit, row.preview, "so");
  write_file(f / "a.json", text);
  EXPECT_TRUE(read_batch_document(f / "a.json", "abc", "so"));
  EXPECT_TRUE(is_batch_document(f / "a.json"));
  EXPECT_FALSE(read_batch_document(f / "a.json", "abd", "so"));
  EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "otherwise"));
  EXPECT_FALSE(read_batch_document(f / "b.json", "abc", "so"));
  write_file(f / "alone.json", to_json(row.fit));
  EXPECT_FALSE(is_batch_document(f / "alone.json"));
  for (std::size_t cut = 0; cut < text.size(); cut += 7) {
    write_file(f / "a.json", text.substr(0, cut));
    EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "so")) << cut;
  }
  for (const char* at : {"/channels", "/parameters/kd/status", "/solver/time_ms", "/input/masked",
                         "/batch/preview/curve/data", "/batch/preview/sphere", "/cost"}) {
    json changed = json::parse(text);
    changed[json::json_pointer(at)] = json{{"not", {1, "this"}}};
    write_file(f / "a.json", changed.dump());
    EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "so")) << at;
  }
}

TEST(BatchPage, ADocumentWhoseListsDifferInLengthIsNotTaken) {
  const test::Folder f;
  const BatchRow row = a_row();
  for (const auto& [at, list] : {std::pair("/parameters/kd/value", "[0.3, 0.2]"),
                                 {"/parameters/kd/value", "[1, 2, 3, 4]"},
                                 {"/parameters/kd/value", "[]"},
                                 {"/parameters/kd/std_error", "[0.1]"},
                                 {"/parameters/kd/status", R"(["free", "free"])"},
                                 {"/parameters/alpha/std_error", "[]"},
                                 {"/channels", R"(["r"])"}}) {
    json changed = json::parse(batch_document(row.fit, row.preview, "so"));
    changed[json::json_pointer(at)] = json::parse(list);
    write_file(f / "a.json", changed.dump());
    EXPECT_FALSE(read_batch_document(f / "a.json", "abc", "so")) << at << " " << list;
  }
}

TEST(BatchPage, DataHoldEveryTableAndTheCounts) {
  const json all = json::parse(batch_json({a_failure(), a_row()}, "so", true));
  EXPECT_EQ(all["schema"], "gonio.batch/1");
  EXPECT_EQ(all["counts"],
            (json{{"ok", 1}, {"not_converged", 0}, {"bad_input", 1}, {"wrong_usage", 0}}));
  const json &broken = all["tables"][0], &fine = all["tables"][1];
  EXPECT_FALSE(broken.contains("parameters"));
  EXPECT_TRUE(broken["document"].is_null());
  EXPECT_EQ(fine["parameters"]["kd"]["value"], json::parse("[0.3, null, 0.1]"));
  EXPECT_EQ(fine["time_ms"], 3.5);
  EXPECT_EQ(fine["preview"]["sphere"], "AP8QIGJ5dGVz");
  EXPECT_FALSE(json::parse(batch_json({a_row()}, "so", false))["tables"][0].contains("preview"));
}

TEST(BatchPage, AHostileNameStaysText) {
  BatchRow row = a_failure();
  row.path = "</script><img src=x onerror=alert(1)>\xff.csv";
  const std::string html = batch_page_html(row.path, batch_json({row}, "so", true));
  EXPECT_EQ(html.find("<img"), html.npos);
}

TEST(Preview, AlbedoOfALambertianIsItsKd) {
  const BoundModel coloured = bind_model("lambert", {{"kd", {0.2, 0.5, 0.8}}});
  const Preview p = make_preview(test::filled(test::in_out_grid(), coloured), coloured);
  EXPECT_EQ(p.albedo, (std::vector<double>{0.2, 0.5, 0.8}));
}

TEST(Preview, ThumbnailKeepsThePeakAndFewPoints) {
  const BoundModel sharp = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                      {{"kd", {0.1, 0.1, 0.1}}, {"alpha", {0.01}}, {"f0", {0.04}}});
  const Table t = test::filled(test::half_difference_grid(), sharp);
  const Preview p = make_preview(t, sharp);
  const Thumbnail& c = p.curve;
  EXPECT_EQ(c.at, "theta_i");
  EXPECT_LE(c.data_deg.size(), 60U);
  EXPECT_LE(c.model_deg.size(), 60U);
  EXPECT_TRUE(std::ranges::is_sorted(c.data_deg));
  const auto cuts = make_cuts(t, sharp);
  double largest = 0;
  for (const auto& cut : cuts)
    if (std::abs(cut.at_deg - c.at_deg) < 1e-6)
      for (std::size_t i = 0; i < cut.deg.size(); ++i)
        if (std::abs(cut.deg[i]) < 80) largest = std::max(largest, cut.model[0][i]);
  EXPECT_NEAR(std::ranges::max(c.model[0]), largest, 0.01 * largest);
}

TEST(Preview, ShowsFourCurvesOfASpectrum) {
  const BoundModel grey = bind_model("lambert", {{"kd", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}}});
  Table t = test::filled(test::in_out_grid(), grey);
  t.channels = {"400", "450", "500", "550", "600", "650", "700"};
  const Preview p = make_preview(t, grey);
  EXPECT_EQ(p.curve.channels, (std::vector<std::size_t>{0, 2, 4, 6}));
  ASSERT_EQ(p.curve.model.size(), 4U);
  EXPECT_NEAR(p.curve.model[1][0], 0.3 / 3.14159, 1e-3);
  EXPECT_EQ(p.albedo.size(), 7U);
}

TEST(Preview, SphereOfAWhiteLambertianIsWhiteToTheLightAndNothingOutside) {
  const Table t = test::filled(test::in_out_grid(), test::glossy());
  const Preview p = make_preview(t, bind_model("lambert", {{"kd", {1, 1, 1}}}));
  constexpr std::size_t n = Preview::size;
  ASSERT_EQ(p.sphere.size(), n * n / 2 * 3);
  const auto red = [&](std::size_t row, std::size_t column) {
    return static_cast<unsigned char>(p.sphere[3 * (row * n / 2 + column)]);
  };
  EXPECT_EQ(red(0, n / 2 - 1), 0) << "a corner";
  EXPECT_GE(red(static_cast<std::size_t>(n / 2 * (1 - std::sin(40 * degree))), 0), 252);
  EXPECT_LT(red(n - 2, 0), 180) << "the side away from the light";
}

}  // namespace
}  // namespace gonio
