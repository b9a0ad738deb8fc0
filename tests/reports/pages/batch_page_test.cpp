#include "reports/pages/batch_page.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

BatchRow row_of(const std::string& path, double alpha) {
  BatchRow r;
  r.path = path, r.document = "a b.json", r.outcome = Exit::done;
  auto& fit = r.fit.emplace();
  fit.model = "lambert", fit.channels = {"f"};
  fit.parameters = {{"alpha", {alpha}, {0.1}, {ParameterStatus::free}}};
  r.preview = Preview{{}, {0.5}, ""};
  return r;
}

TEST(BatchPage, AHostileNameStaysText) {
  BatchSummary s;
  s.rows.push_back(row_of("</script><img src=x onerror=alert(1)>.csv", 0.2));
  s.rows.push_back({"<img>.csv", "", Exit::bad_input, "<img>", {}, {}});
  EXPECT_EQ(batch_page_html(s, "<img>").find("<img"), std::string::npos);
}

TEST(BatchPage, GivesEachTableItsKeysAndLink) {
  BatchSummary s;
  for (const double alpha : {0.25, 0.5}) s.rows.push_back(row_of("t/x.csv", alpha));
  const auto html = batch_page_html(s, "t");
  EXPECT_NE(html.find("data-keys=\"x.csv|0|0.25|"), html.npos);
  EXPECT_NE(html.find("data-keys=\"x.csv|0|0.5|"), html.npos);
  EXPECT_NE(html.find("<a href=\"./a%20b.json\">x.csv</a>"), html.npos);
}

TEST(BatchPage, ShowsTheBeginningOfManyWarnings) {
  BatchSummary s;
  s.rows.push_back(row_of("a.csv", 0.25));
  const auto size = batch_page_html(s, "t").size();
  s.rows[0].fit->warnings.assign(1000, std::string(1000, 'w'));
  EXPECT_LT(batch_page_html(s, "t").size(), size + 20'000);
}

TEST(BatchPage, ShowsAFewOfManyParameters) {
  BatchSummary s;
  s.rows.push_back(row_of("a.csv", 0.25));
  for (int k = 0; k < 1000; ++k) {
    auto& all = s.rows[0].fit->parameters;
    all.push_back(all[0]);
    all.back().name = "of_a_stranger_" + std::to_string(k);
  }
  const auto html = batch_page_html(s, "t");
  EXPECT_NE(html.find("of_a_stranger_30"), html.npos);
  EXPECT_EQ(html.find("of_a_stranger_31"), html.npos);
}

}  // namespace
}  // namespace gonio
