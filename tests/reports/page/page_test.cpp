#include "reports/page/page.h"

#include "reports/page/assets.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::size_t occurrences(const std::string& in, const std::string& what) {
  std::size_t n = 0;
  for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) ++n;
  return n;
}

TEST(Page, FetchesNothing) {
  const std::string html = drawn_page("t", "", "");
  const std::string head = html.substr(0, html.find("<style>"));
  EXPECT_EQ(occurrences(html, " src="), 0U);
  EXPECT_EQ(occurrences(head, "href="), 1U);
  EXPECT_NE(head.find("href=\"data:,\""), std::string::npos);
  EXPECT_NE(head.find("default-src 'none'"), std::string::npos);
  for (const char* load : {"@import", "url("})
    EXPECT_EQ(assets::page_css.find(load), assets::page_css.npos) << load;
  for (const char* load :
       {"fetch(", "XMLHttpRequest", "import(", "WebSocket", "sendBeacon", "new Image"})
    EXPECT_EQ(assets::pictures_js.find(load), assets::pictures_js.npos) << load;
}

TEST(Page, LeadsBackToAnIndexThatLiesBesideIt) {
  const std::string html = drawn_page("t", "<p>as it was</p>", "");
  EXPECT_EQ(html.find("<html lang=\"en\" data-index>"), html.npos);
  const std::string beside = beside_index(html);
  EXPECT_NE(beside.find("<html lang=\"en\" data-index>"), beside.npos);
  EXPECT_NE(beside.find("<p>as it was</p>"), beside.npos);
}

TEST(Page, AHostileTitleStaysText) {
  const std::string html = drawn_page("</title><img src=x onerror=alert(1)>", "", "");
  EXPECT_EQ(occurrences(html, "<img"), 0U);
  EXPECT_EQ(occurrences(html, "</title"), 1U);
}

TEST(Page, EmbeddedFilesEndNoElement) {
  EXPECT_FALSE(assets::pictures_js.empty());
  EXPECT_EQ(assets::pictures_js.find("</script"), assets::pictures_js.npos);
  EXPECT_EQ(assets::pictures_js.find("<!--"), assets::pictures_js.npos);
  EXPECT_FALSE(assets::page_css.empty());
  EXPECT_EQ(assets::page_css.find("</style"), assets::page_css.npos);
}

}  // namespace
}  // namespace gonio
