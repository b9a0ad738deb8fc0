#include "reports/pages/fit_page.h"

#include <limits>

#include "tables.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

TEST(FitPage, DataHoldBothDocumentsAndTheFigures) {
  const FitPage page =
      make_fit_page(test::filled(test::in_out_grid(), test::glossy()), test::glossy());
  const json data =
      json::parse(to_json(page, R"({"model": "lambert", "n": 0.1})", R"({"valid": 3})"));
  EXPECT_EQ(data.at("fit"), (json{{"model", "lambert"}, {"n", 0.1}}));
  EXPECT_EQ(data.at("health"), (json{{"valid", 3}}));
  EXPECT_EQ(data.at("channels"), (json{"r", "g", "b"}));
  ASSERT_EQ(data.at("curves").size(), page.curves.size());
  const json& curve = data.at("curves")[0];
  EXPECT_EQ(curve.at("data").size(), 3U);
  EXPECT_EQ(curve.at("data")[0].size(), curve.at("deg").size());
  EXPECT_EQ(curve.at("model")[2].size(), curve.at("deg").size());
  EXPECT_EQ(data.at("residual_map").at("mean").size(), page.residual_map.mean.size());
  const json& light = data.at("spheres").at("lights")[0];
  EXPECT_EQ(light.at("table"), page.spheres.lights[0].table);
  EXPECT_EQ(light.at("models")[0].at("difference"), page.spheres.lights[0].models[0].difference);
}

TEST(FitPage, WhatIsNotKnownIsNull) {
  FitPage page;
  page.channels = {"f"};
  page.curves = {{"theta_i",
                  30,
                  0,
                  "theta_o",
                  {1, 2},
                  {{std::numeric_limits<double>::quiet_NaN(), 0.25}},
                  {{1, std::numeric_limits<double>::infinity()}}}};
  const json curve = json::parse(to_json(page, "{}", "null")).at("curves")[0];
  EXPECT_EQ(curve.at("data"), json::parse("[[null, 0.25]]"));
  EXPECT_EQ(curve.at("model"), json::parse("[[1, null]]"));
}

TEST(FitPage, WhatTheScriptReadsIsInTheDocuments) {
  const Table t = test::filled(test::in_out_grid(), test::glossy());
  const json fit = json::parse(to_json(FitDocument{})),
             health = json::parse(to_json(t, inspect(t)));
  for (const char* at : {"/model",
                         "/parameters",
                         "/metric",
                         "/log_offset",
                         "/robust",
                         "/cost",
                         "/intervals",
                         "/clusters",
                         "/residuals/rms",
                         "/residuals/log_rms",
                         "/residuals/bands",
                         "/identifiability/names",
                         "/identifiability/correlations",
                         "/identifiability/condition",
                         "/solver/termination",
                         "/solver/message",
                         "/solver/iterations",
                         "/solver/cost_per_iteration",
                         "/solver/instruction_set",
                         "/solver/time_ms",
                         "/input/path",
                         "/input/sha256",
                         "/input/format",
                         "/input/bins",
                         "/input/values_used",
                         "/input/masked",
                         "/bin_sensitivity",
                         "/warnings",
                         "/next",
                         "/misfit/tested",
                         "/misfit/told",
                         "/physics/theta_i_deg",
                         "/physics/model_albedo",
                         "/physics/data_albedo",
                         "/physics/peak_ratio"})
    EXPECT_TRUE(fit.contains(json::json_pointer(at))) << at;
  for (const char* at :
       {"/samples", "/values", "/valid", "/masked/below_horizon", "/masked/negative",
        "/masked/not_finite", "/bins", "/bin_sensitivity", "/noise_floor", "/largest",
        "/smallest_positive", "/albedo/0/theta_i_deg", "/albedo/0/albedo", "/albedo/0/coverage",
        "/reciprocity_error", "/reciprocity_note", "/peak", "/truth"})
    EXPECT_TRUE(health.contains(json::json_pointer(at))) << at;
}

TEST(FitPage, AFitDocumentOfANastyFileMakesAPage) {
  FitDocument d;
  d.model = "lambert";
  d.input_path = "</script><img src=x onerror=alert(1)>\xff.csv";
  const FitPage page =
      make_fit_page(test::filled(test::in_out_grid(), test::glossy()), test::glossy());
  const std::string html = fit_page_html(d.input_path, to_json(page, to_json(d), "{}"));
  EXPECT_EQ(html.find("<img"), html.npos);
  EXPECT_NE(html.find("\\u003c/script>\\u003cimg"), html.npos);
}

}  // namespace
}  // namespace gonio
