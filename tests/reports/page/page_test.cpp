#include "reports/page/page.h"

#include <regex>

#include "reports/page/assets.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::string data_of(const std::string& html) {
  const std::string open = R"(<script type="application/json" id="page-data">)";
  const auto from = html.find(open) + open.size();
  return html.substr(from, html.find("</script>", from) - from);
}

std::size_t occurrences(const std::string& in, const std::string& what) {
  std::size_t n = 0;
  for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) ++n;
  return n;
}

TEST(Page, FetchesNothing) {
  const std::string html = make_page("t", "{}", assets::fit_js);
  const std::string head = html.substr(0, html.find("<style>"));
  EXPECT_EQ(occurrences(html, " src="), 0U);
  EXPECT_EQ(occurrences(head, "href="), 1U);
  EXPECT_NE(head.find("href=\"data:,\""), std::string::npos);
  EXPECT_NE(head.find("default-src 'none'"), std::string::npos);
  for (const auto css : {assets::page_css, assets::uplot_css})
    for (const char* load : {"@import", "url("}) EXPECT_EQ(css.find(load), css.npos) << load;
  for (const auto js :
       {assets::page_js, assets::plots_js, assets::fit_js, assets::batch_js, assets::report_js,
        assets::figures_js, assets::pictures_js, assets::models_js, assets::spheres_js})
    for (const char* load :
         {"fetch(", "XMLHttpRequest", "import(", "WebSocket", "sendBeacon", "new Image"})
      EXPECT_EQ(js.find(load), js.npos) << load;
}

TEST(Page, LeadsBackToAnIndexThatLiesBesideIt) {
  const std::string html = make_page("t", R"({"a": "<html lang=\"en\""})", "");
  EXPECT_EQ(html.find("data-index"), html.npos);
  const std::string beside = beside_index(html);
  EXPECT_NE(beside.find("<html lang=\"en\" data-index>"), beside.npos);
  EXPECT_EQ(data_of(beside), data_of(html));
}

TEST(Page, HostileStringsStayText) {
  const std::string hostile = "</script><img src=x onerror=alert(1)><!--<script>\"'&\xe2\x80\xa8";
  const nlohmann::json data{{"path", hostile}, {hostile, 1}};
  const std::string html = make_page(hostile, data.dump(), "");
  EXPECT_EQ(occurrences(html, "<img"), 0U);
  EXPECT_EQ(occurrences(html, "<!--"), 0U);
  EXPECT_EQ(occurrences(html, "</script"), occurrences(make_page("t", "{}", ""), "</script"));
  EXPECT_EQ(nlohmann::json::parse(data_of(html)), data);
}

TEST(Page, EmbeddedFilesEndNoElement) {
  for (const auto js : {assets::uplot_js, assets::page_js, assets::plots_js, assets::fit_js,
                        assets::batch_js, assets::report_js, assets::figures_js,
                        assets::pictures_js, assets::models_js, assets::spheres_js}) {
    EXPECT_FALSE(js.empty());
    EXPECT_EQ(js.find("</script"), js.npos);
    EXPECT_EQ(js.find("<!--"), js.npos);
  }
  for (const auto css : {assets::uplot_css, assets::page_css}) {
    EXPECT_FALSE(css.empty());
    EXPECT_EQ(css.find("</style"), css.npos);
  }
  EXPECT_EQ(assets::uplot_license.find("*/"), assets::uplot_license.npos);
}

TEST(Page, CarriesTheLicenceOfWhatItHolds) {
  const std::string html = make_page("t", "{}", "");
  EXPECT_NE(html.find("The MIT License"), std::string::npos);
  EXPECT_NE(html.find("uPlot (v1.6.32)"), std::string::npos);
}

}  // namespace
}  // namespace gonio
