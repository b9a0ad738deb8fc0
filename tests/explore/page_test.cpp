#include "reports/explore/page.h"

#include <cmath>

#include "base/base64.h"
#include "base/base85.h"
#include "base/file.h"
#include "brdf/model/presets.h"
#include "explore/surface.h"
#include "fitting/result/document.h"
#include "refusal.h"
#include "reports/explore/assets.h"
#include "support.h"
#include "tables.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// What a page holds as data.
nlohmann::json explored_data(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"explored\">";
  const auto begin = html.find(open) + open.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

std::vector<float> floats(const nlohmann::json& base64_text) {
  const std::string bytes = from_base64(base64_text.get<std::string>());
  std::vector<float> v(bytes.size() / sizeof(float));
  std::memcpy(v.data(), bytes.data(), v.size() * sizeof(float));
  return v;
}

TEST(ExplorePage, HoldsTheModuleAndFetchesNothing) {
  const std::string html = explore_page_html({});
  EXPECT_NE(html.find(base85(assets::models_wasm_gz)), html.npos);
  EXPECT_EQ(assets::models_wasm_gz.substr(0, 2), "\x1f\x8b");
  EXPECT_NE(html.find("default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'"),
            html.npos);
  EXPECT_LT(html.size(), 750'000U);
  EXPECT_TRUE(explored_data(html)["items"].empty());
  EXPECT_EQ(html.find("id=\"fit-module\""), html.npos);
  const std::string app = explore_page_html({}, true);
  EXPECT_NE(app.find(base85(assets::fit_wasm_gz)), app.npos);
  EXPECT_LT(app.size(), 2'300'000U);
  for (const char* load :
       {"fetch(", "XMLHttpRequest", "import(", "importScripts", "WebSocket", "sendBeacon",
        "new Image(", "innerHTML", "outerHTML =", "insertAdjacentHTML", "document.write", "eval("})
    for (const auto script :
         {assets::explore_js, assets::views_js, assets::fitting_js, assets::worker_js})
      EXPECT_EQ(script.find(load), script.npos) << load;
  EXPECT_EQ(assets::explore_css.find("url("), assets::explore_css.npos);
}

TEST(ExplorePage, AHostileNameStaysText) {
  ExploredModel m{"</script><img src=x onerror=alert(1)>.json", {test::glossy(), {"r", "g", "b"}}};
  const std::string html = explore_page_html({m});
  EXPECT_EQ(html.find("<img"), html.npos);
  EXPECT_EQ(explored_data(html)["items"][0]["name"], m.name.substr(m.name.rfind('/') + 1));
}

TEST(ExplorePage, TableIsResampledWithItsLossStated) {
  const Table t = test::filled(test::half_difference_grid(90), test::glossy());
  const ExploredTable e = explore_table("folder/t.csv", t);
  EXPECT_LT(e.loss, 1.1);
  EXPECT_GT(e.loss, 1.0001);
  EXPECT_GT(e.covered, 0.95);
  const auto one = explored_data(explore_page_html({e}))["items"][0];
  EXPECT_EQ(one["kind"], "table");
  EXPECT_EQ(one["name"], "t.csv");
  EXPECT_HAS(one["said"].get<std::string>(), "typically off by ×/÷ 1.0");
  const auto grid = floats(one["values"]);
  const auto place = explore::page_grid(one["sizes"].get<std::array<std::size_t, 3>>());
  ASSERT_EQ(grid.size(), 3 * place.size());
  Table back;
  back.where = place;
  back.values.emplace_back(grid.begin(), grid.begin() + static_cast<std::ptrdiff_t>(place.size()));
  const std::size_t cell = (20 * 30 + 10) * 18 + 5;
  const auto at = SampleAngles(back).directions(cell);
  const auto f = evaluate(test::glossy(), std::array{frame_angles(at)});
  EXPECT_NEAR(grid[cell], f[0][0], 0.01 * f[0][0]);

  // Its own samples and cuts are not resampled.
  const auto samples = floats(one["samples"]);
  const std::size_t n = samples.size() / 7;
  EXPECT_GT(n, 4000U);
  EXPECT_LE(n, most_explored_samples);
  const auto own = [&](std::size_t k) { return static_cast<double>(samples[k * n + n / 2]); };
  const DirectionPair pair{direction(own(0) * degree, own(1) * degree),
                           direction(own(2) * degree, own(3) * degree)};
  EXPECT_NEAR(own(5), evaluate(test::glossy(), std::array{frame_angles(pair)})[1][0],
              1e-4 * own(5));
  ASSERT_FALSE(one["cuts"].empty());
  const auto cut = make_cuts(t).front();
  EXPECT_EQ(one["cuts"][0]["theta_i"], cut.at_deg);
  EXPECT_NEAR(one["cuts"][0]["f"][0][cut.deg.size() / 2], cut.data[0][cut.deg.size() / 2], 1e-12);
}

TEST(ExplorePage, TableWithFewSamplesFillsTheCellsThatItHas) {
  Table t = test::filled(test::in_out_grid(), test::glossy());
  t.channels = {"a", "b", "c"};
  t.channels.insert(t.channels.end(), {"d", "e"});
  t.values.push_back(t.values[0]), t.values.push_back(t.values[2]);
  const ExploredTable e = explore_table("t.csv", t);
  EXPECT_EQ(e.channels, (std::vector<std::string>{"a", "c", "e"}));
  EXPECT_HAS(explored_data(explore_page_html({e}))["items"][0]["said"].get<std::string>(),
             "Of 5 channels it shows a, c, e.");
  EXPECT_EQ(explored_data(explore_page_html({e}))["items"][0]["channels_in_file"], 5);
  EXPECT_GT(e.covered, 0.9);
  // The same by a function between samples, which knows the file's channels by their numbers.
  Table defined = t;
  defined.between = [](const DirectionPair&, std::size_t c) {
    return 0.1 + static_cast<double>(c);
  };
  const ExploredTable by_number = explore_table("t.csv", defined);
  EXPECT_EQ(by_number.grid.values[1][0], 2.1);
  EXPECT_EQ(by_number.grid.values[2][0], 4.1);
  for (auto& channel : t.values) std::fill(channel.begin(), channel.end(), -1);
  EXPECT_HAS(test::refusal([&] { explore_table("t.csv", t); }), "none that is valid");
}

TEST(ExplorePage, TableHasItsAlbedosWhereverTheLightCameFrom) {
  Table t = test::filled(test::in_out_grid(), test::glossy());
  ExploredTable e = explore_table("t.csv", t);
  ASSERT_FALSE(e.albedo.empty());
  const auto points = [&] { return explored_data(explore_page_html({e}))["items"][0]["albedo"]; };
  const auto at_0 = points();
  EXPECT_EQ(at_0.size(), e.albedo.size());
  // Each says how far it may be off, and how much of the hemisphere has samples.
  for (std::size_t k = 0; k < at_0.size(); ++k) {
    EXPECT_EQ(at_0[k]["error"], e.albedo[k].error);
    EXPECT_EQ(at_0[k]["coverage"], e.albedo[k].coverage);
    EXPECT_LT(at_0[k]["coverage"], 1);
  }
  for (auto& a : e.albedo) a.phi_i_deg = 180;
  EXPECT_EQ(points(), at_0);
  // Several azimuths of one zenith angle are one point.
  e.albedo.insert(e.albedo.begin() + 1, e.albedo[0]);
  EXPECT_EQ(points(), at_0);
}

TEST(ExplorePage, FitHasItsDocument) {
  const test::Folder f;
  const auto fit = f.write(
      "fit.json", R"({"schema": "gonio.fit/1", "model": "lambert+ggx/smith_ggx.correlated/schlick",
"channels": ["r", "g", "b"], "parameters": {"kd": {"value": [0.2, 0.3, 0.4], "ci95": [[0.1, 0.3], null, [0.35, 0.45]]},
"alpha": {"value": 0.3, "ci95": [0.25, 0.36]}, "roughness": {"value": 0.5477}, "f0": {"value": [0.04, 0.04, 0.04], "ci95": null}}})");
  const auto one = explored_data(explore_page_html({explore_model(fit, {})}))["items"][0];
  EXPECT_EQ(one["document"], InputFile(fit).read_rest());
  EXPECT_EQ(one["values"]["kd"], nlohmann::json::parse("[0.2, 0.3, 0.4]"));
  EXPECT_EQ(one["name"], "fit.json");
  // What the fit could not determine begins where the other channels are, or where a fit begins.
  const auto open = f.write(
      "open.json", R"({"schema": "gonio.fit/1", "model": "lambert+ggx/smith_ggx.correlated/schlick",
"channels": ["r", "g", "b"], "parameters": {"kd": {"value": [0.2, null, 0.4]}, "alpha": {"value": null}, "roughness": {"value": null},
"f0": {"value": [0.04, 0.04, 0.04]}}})");
  const auto filled = explored_data(explore_page_html({explore_model(open, {})}))["items"][0];
  EXPECT_NEAR(filled["values"]["kd"][1], 0.3, 1e-12);
  EXPECT_EQ(filled["values"]["alpha"][0], 0.3);
  // A model that nobody named is called by its terms, by the page itself.
  EXPECT_EQ(explored_data(explore_page_html({explore_model(
                "lambert+ggx/smith_ggx.correlated/schlick", {}, 1)}))["items"][0]["name"],
            "");
  // One that is shipped was named by whoever asked for it by that name.
  EXPECT_EQ(explored_data(explore_page_html({explore_model("disney", {})}))["items"][0]["name"],
            find_preset("disney")->about.title);
}

}  // namespace
}  // namespace gonio
