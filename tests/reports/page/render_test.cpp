#include "reports/page/render.h"

#include <gtest/gtest.h>

namespace gonio::page {
namespace {

std::size_t occurrences(const std::string& in, const std::string& what) {
  std::size_t n = 0;
  for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) ++n;
  return n;
}
/// What is between the first of two marks and the second.
std::string between(const std::string& in, const std::string& from, const std::string& to) {
  const auto begin = in.find(from) + from.size();
  return in.substr(begin, in.find(to, begin) - begin);
}
std::string body(const std::string& html) {
  return between(html, "<main", "</main>");
}

Pictures two_pictures() {
  Pictures p;
  for (const char* material : {"gold", "iron"})
    for (const char* channel : {"red", "green"}) {
      if (std::string(material) == "iron" && std::string(channel) == "green") continue;
      auto f = make_figure("error", {{"material", material}, {"channel", channel}});
      f.title = material;
      f.x = {"x"}, f.y = {"y"};
      f.curves = {{"c", {0, 1}, {0, 1}}};
      p.figures.push_back(f);
    }
  return p;
}
Page page_of(std::vector<Part> parts) {
  Page p{"test", "report test", "Test", "A test", {"One.", "Two."}};
  p.sections = {{"First & foremost", "", std::move(parts)}};
  return p;
}

TEST(PageHtml, IsWholeWithoutItsScript) {
  const auto html =
      page_html(page_of({Table{columns("form|>error"), {{{"GGX"}, Cell("0.1", "at 5°")}}}}), {});
  EXPECT_EQ(between(html, "<nav", "</nav>").find("#first-foremost") != std::string::npos, true);
  EXPECT_NE(html.find("<section id=\"first-foremost\"><h2>First &amp; foremost</h2>"), html.npos);
  EXPECT_NE(html.find("<td class=n><span title=\"at 5°\">0.1</span></td>"), html.npos);
  EXPECT_NE(html.find("--2:&quot;error: &quot;"), html.npos) << "what a card says of the cell";
}

TEST(PageHtml, HostileTextStaysText) {
  const std::string hostile = "</script><img src=x onerror=alert(1)>\"'&";
  auto p = two_pictures();
  p.figures[0].title = p.figures[0].note = p.figures[0].curves[0].name = p.figures[0].x.label =
      hostile;
  auto page =
      page_of({Table{{{hostile}, {hostile}}, {{{hostile}, {hostile, hostile, hostile, hostile}}}},
               Prose{hostile}, Subtitle{hostile}, Points{{hostile}}, Pairs{{{hostile, hostile}}},
               Choice{{{"material", hostile, hostile}, {"channel", hostile}},
                      {slot_of(p, "error", {{"material", ""}, {"channel", ""}})}}});
  page.title = page.heading = page.setting = hostile;
  page.findings = {hostile, hostile};
  page.sections[0].title = page.sections[0].text = hostile;
  const auto html = page_html(page, p);
  EXPECT_EQ(occurrences(html, "<img"), 0U);
  EXPECT_EQ(occurrences(html, "</script"), 1U);
  EXPECT_EQ(occurrences(html, "\"'&"), 0U);
}

TEST(PageHtml, ShowsWhatIsChosenAndKeepsTheRest) {
  const auto p = two_pictures();
  Choice c;
  c.controls = {{"material", "Material", "iron", true}, {"channel", "Channel", "green"}};
  c.slots = {slot_of(p, "error", c.controls)};
  const auto html = body(page_html(page_of({c}), p));
  EXPECT_EQ(occurrences(html, "<template"), 2U);
  EXPECT_NE(html.find("<div data-of=\"iron|red\">"), html.npos) << "iron has no green";
  EXPECT_NE(html.find("value=\"iron\" selected"), html.npos);
  EXPECT_NE(html.find("value=\"red\" checked"), html.npos);
  EXPECT_EQ(occurrences(html, "id=\"error_gold_red\""), 1U);
}

TEST(PageHtml, SetsCodeAndBoldWordsAndEndsWhatIsOpen) {
  const auto html = body(page_html(page_of({Prose{"Take **GGX**: `a**b`. **open"}}), {}));
  EXPECT_NE(html.find("<p>Take <b>GGX</b>: <code>a**b</code>. <b>open</b></p>"), html.npos);
}

TEST(PageHtml, GivesEachThingToLookThroughItsWordsAndKeys) {
  Browse b;
  b.keys = {"name", "alpha"};
  b.kinds = {"failed"};
  b.items = {{"<h3>a</h3>", "a \"b\"", "failed", {"a", "0.5"}}, {"<h3>c</h3>", "c", "", {"c", ""}}};
  b.rows.head = columns("name|>alpha");
  b.rows.add("a", "0.5");
  b.rows.add("c", "–");
  const auto html = body(page_html(page_of({Fold{"more", {b}}}), {}));
  EXPECT_NE(html.find("data-words=\"a &quot;b&quot;\" data-kind=\"failed\" data-keys=\"a|0.5\">"),
            html.npos);
  EXPECT_NE(html.find("data-keys=\"c|\""), html.npos);
  EXPECT_EQ(occurrences(html, "<tr>"), 3U);
  EXPECT_NE(html.find("<details class=\"more\"><summary>more</summary>"), html.npos);
}

TEST(PageHtml, LeavesOutWhatThereIsNot) {
  auto page = page_of({Shown{"nothing"}});
  page.sections.push_back({});
  page.sections.push_back({"Empty", "", {}});
  const auto html = body(page_html(page, {}));
  EXPECT_EQ(occurrences(html, "<section"), 1U);
  EXPECT_EQ(occurrences(html, "<figure"), 0U);
  EXPECT_TRUE(opening({}, "error").empty());
}

TEST(PageHtml, APictureHasOneAnchor) {
  const auto p = two_pictures();
  auto page =
      page_of({Shown{"error", {{"material", "gold"}}}, Shown{"error", {{"material", "gold"}}}});
  page.first = opening(p, "error", {{"material", "gold"}});
  ASSERT_FALSE(page.first.empty());
  const auto html = page_html(page, p);
  EXPECT_EQ(occurrences(html, "<figure"), 3U);
  EXPECT_EQ(occurrences(html, " id=\"error_gold_red\""), 1U);
  EXPECT_EQ(occurrences(html, "test/error_gold_red.svg"), 3U);
}

TEST(PageHtml, HidesWhatCannotBeToldApartBehindTheMostShipped) {
  Pictures p;
  auto f = make_figure("many");
  for (int i = 0; i < 9; ++i)
    f.curves.push_back({i == 8 ? "a = shipped" : "c" + std::to_string(i), {0, 1}, {0, 1}});
  f.curves.push_back({"truth", {0, 1}, {0, 1}});
  f.curves.back().dashed = true;
  p.figures = {f};
  auto page = page_of({Shown{"many"}});
  page.most_shipped = {"shipped"};
  const auto html = body(page_html(page, p)), keys = between(html, "class=\"keys\"", "</div>");
  EXPECT_EQ(occurrences(keys, "class=\"more\""), 3U);
  EXPECT_EQ(keys.substr(keys.find("a = shipped") - 80, 80).find("more"), std::string::npos);
  EXPECT_EQ(keys.substr(keys.find(">truth") - 80, 80).find("more"), std::string::npos)
      << "a reference";
}

}  // namespace
}  // namespace gonio::page
