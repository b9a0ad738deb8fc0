#include "reports/pages/fit_page.h"

#include <limits>

#include "table/sample_mask.h"
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

std::string html_of(const FitDocument& d,
                    const Table& t = test::filled(test::in_out_grid(), test::glossy())) {
  return fit_page_html(d, t, inspect(t), make_fit_page(t, test::glossy()));
}

TEST(FitPage, SaysWhereItsModelRisesAboveAPicture) {
  const Table t = test::filled(test::in_out_grid(), test::glossy());
  FitDocument d;
  d.model = "ggx/smith_ggx.correlated/schlick";
  const auto rises = [&](double times) {
    auto page = make_fit_page(t, test::glossy());
    for (auto& cut : page.curves)
      for (auto& channel : cut.model)
        for (double& f : channel) f *= times;
    return fit_page_html(d, t, inspect(t), page).find("the model rises above the picture") !=
           std::string::npos;
  };
  EXPECT_FALSE(rises(1));
  EXPECT_FALSE(rises(2)) << "the picture reaches to it";
  EXPECT_TRUE(rises(10));
}

TEST(FitPage, ShowsAParameterWithItsIntervalLimitOrReason) {
  FitDocument d;
  d.model = "ggx/smith_ggx.correlated/schlick";
  const double none = std::numeric_limits<double>::quiet_NaN();
  using enum ParameterStatus;
  d.parameters = {{"alpha", {0.3123}, {0.012}, {0.288}, {0.336}, {free}},
                  {"f0", {none}, {none}, {none}, {none}, {upper_limit}, {0.04}, {"too dark"}},
                  {"kd", {none}, {none}, {none}, {none}, {not_identifiable}, {none}, {"no base"}}};
  const auto html = html_of(d);
  EXPECT_NE(html.find("0.288 … 0.336"), html.npos);
  EXPECT_NE(html.find("≤\u202f0.0400"), html.npos);
  EXPECT_NE(html.find("no base"), html.npos);
  EXPECT_NE(html.find("<b>Not known:</b> kd."), html.npos);
  for (const char* id : {"parameters", "data-and-model", "where-the-model-is-off", "input"})
    EXPECT_NE(html.find(std::string("<section id=\"") + id), html.npos) << id;
}

TEST(FitPage, ShowsALimitInPlaceOfTheValueAndWhereAnIntervalIsCut) {
  FitDocument d;
  d.model = "ggx/smith_ggx.correlated/schlick";
  const double none = std::numeric_limits<double>::quiet_NaN();
  using enum ParameterStatus;
  d.parameters = {{"alpha", {0.0028456}, {none}, {none}, {none}, {upper_limit}, {0.0137}},
                  {"f0", {0.56}, {0.89}, {0}, {1}, {unbounded}, {none}, {"too wrong"}}};
  d.values_used = 684;
  d.masked = {{"below_horizon", 8}, {"left_out_by_mask", 32}};
  const auto html = html_of(d);
  EXPECT_EQ(html.find("0.0028456"), html.npos);
  EXPECT_NE(html.find("its whole range"), html.npos);
  EXPECT_NE(html.find("of 724"), html.npos);
  EXPECT_NE(html.find("A blue arrow"), html.npos);
  EXPECT_EQ(html.find("An orange arrow"), html.npos) << "the truth is not known";
  d.parameters[1].ci95_high = {0.9};
  EXPECT_EQ(html_of(d).find("end of its range"), html.npos) << "0 says that by itself";
}

TEST(FitPage, SaysWhenItsModelIsTheOneWithoutTheLobe) {
  FitDocument d;
  const Table t = test::filled(test::in_out_grid(), test::glossy());
  const auto words = std::string("are of the fit without the lobe");
  auto page = make_fit_page(t, test::glossy());
  const auto html = [&](const char* model) {
    d.model = model;
    return fit_page_html(d, t, inspect(t), page);
  };
  EXPECT_EQ(html("lambert+ggx/smith_ggx.correlated/schlick").find(words), std::string::npos);
  page = make_fit_page(t, bind_model(parse_model("lambert"), {}, 3));
  EXPECT_NE(html("lambert+ggx/smith_ggx.correlated/schlick").find(words), std::string::npos);
  EXPECT_EQ(html("lambert").find(words), std::string::npos);
}

TEST(FitPage, LeavesUnknownParametersOutOfTheCorrelations) {
  FitDocument d;
  d.model = "lambert+ggx/smith_ggx.correlated/schlick";
  d.channels = {"r", "g"};
  const double none = std::numeric_limits<double>::quiet_NaN();
  using enum ParameterStatus;
  d.parameters = {
      {"kd", {0.5, 0.4}, {0.1, 0.1}, {0.3, 0.2}, {0.7, 0.6}, {free, free}},
      {"f0", {0.04, none}, {0.01, none}, {0.03, none}, {0.05, none}, {free, not_identifiable}}};
  d.free_names = {"kd.r", "kd.g", "f0.r", "f0.g"};
  d.correlations = {{1, 0.1, 0.2, 0.3}, {0.1, 1, -0.4, 0.97}, {0.2, -0.4, 1, 0}, {0.3, 0.97, 0, 1}};
  const auto html = html_of(d);
  EXPECT_NE(html.find("kd.g and f0.r, correlation −0.400"), html.npos);
  EXPECT_EQ(html.find("Hardly separable"), html.npos);
  EXPECT_NE(html.find("data-nx=\"kd.r|kd.g|f0.r\""), html.npos);
}

TEST(FitPage, NamesItsOwnDocumentAndTheCommandThatOpensBothWithSliders) {
  FitDocument d;
  d.model = "lambert";
  d.input_path = "a b.csv";
  const Table t = test::filled(test::in_out_grid(), test::glossy());
  const auto page = make_fit_page(t, test::glossy());
  EXPECT_EQ(html_of(d).find("gonio explore"), std::string::npos) << "of a fit without a document";
  const auto html = fit_page_html(d, t, inspect(t), page, "out/paint.json");
  EXPECT_NE(html.find("gonio explore 'a b.csv' paint.json"), html.npos);
  EXPECT_EQ(html.find("fit.json"), html.npos);
  d.input_path = "out/--help";
  const auto dashed = fit_page_html(d, t, inspect(t), page, "-x.json");
  EXPECT_NE(dashed.find("gonio explore ./--help ./-x.json"), dashed.npos) << "names, no options";
}

TEST(FitPage, ShowsRatiosUncertaintiesAndWhatIsLeftOut) {
  FitDocument d;
  d.model = "lambert";
  EXPECT_EQ(html_of(d).find("95 % intervals by the stated"), std::string::npos);
  d.ratios = {{"kd.g", "kd.r", 0.5, 0.49, 0.51}};
  DirectionList l;
  for (double deg = 5; deg < 90; deg += 5) {
    l.theta_i_deg.push_back(20);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(deg);
    l.phi_o_deg.push_back(180);
  }
  Table t = test::filled(l, test::glossy());
  t.errors = t.values;
  for (auto& plane : t.errors)
    for (double& u : plane) u *= 0.1;
  leave_out(t, "theta_o > 60");
  const auto html = html_of(d, t);
  EXPECT_NE(html.find("<code>kd.g</code> / <code>kd.r</code>"), html.npos);
  EXPECT_NE(html.find("95 % intervals by the stated"), html.npos);
  EXPECT_NE(html.find("class=\"bar\""), html.npos);
  EXPECT_NE(html.find(">left out<"), html.npos);
}

TEST(FitPage, SaysInItsHeadingThatAModelDoesNotFit) {
  FitDocument d;
  d.model = "lambert";
  d.input_path = "a.csv";
  EXPECT_NE(html_of(d).find("<h1>Lambert fitted to a.csv</h1>"), std::string::npos);
  d.misfit.too_few = true;
  EXPECT_NE(html_of(d).find("<h1>Lambert may fit a.csv</h1>"), std::string::npos);
  d.misfit.told = true;
  const auto html = html_of(d);
  EXPECT_NE(html.find("<h1>Lambert does not fit a.csv</h1>"), html.npos);
  EXPECT_EQ(html.find("fitted to"), html.npos);
  EXPECT_EQ(html.find("reproduces"), html.npos);
}

TEST(FitPage, AFitDocumentOfANastyFileMakesAPage) {
  FitDocument d;
  d.model = "lambert";
  d.input_path = "</script><img src=x onerror=alert(1)>\xff.csv";
  EXPECT_EQ(html_of(d).find("<img src=x"), std::string::npos);
}

}  // namespace
}  // namespace gonio
