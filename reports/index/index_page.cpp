#include "reports/index/index_page.h"

#include <algorithm>
#include <iterator>

#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/picture/json_numbers.h"

namespace gonio {

constexpr std::size_t most_findings = 5;  ///< of a report, here; its page has all

std::string first_sentence(std::string_view text) {
  for (std::size_t i = text.find(". "); i != text.npos; i = text.find(". ", i + 1)) {
    const auto next = static_cast<unsigned char>(text[i + 2]);
    const bool begins = (next >= 'A' && next <= 'Z') || next == '\'' || next >= 0x80;  // “, Δ
    if (begins) return std::string(text.substr(0, i + 1));
  }
  return std::string(text);
}

std::string to_json(const ReportIndex& index) {
  PageJson reports = PageJson::array(), claims = PageJson::array(), questions = PageJson::array();
  for (const auto& r : index.reports) {
    std::vector<std::string> others;  // what is judged stands below, with the claims
    std::ranges::copy_if(r.findings.sentences, std::back_inserter(others), [&](const std::string& f) {
      return std::ranges::none_of(r.findings.claims, [&](const Claim& c) { return sentence(c) == f; });
    });
    PageJson findings = PageJson::array();
    for (std::size_t i = 0; i < std::min(most_findings, others.size()); ++i)
      findings.push_back(first_sentence(others[i]));
    reports.push_back({{"name", r.name},
                       {"what", r.what},
                       {"findings", findings},
                       {"more", others.size() > most_findings},
                       {"pictures", r.pictures},
                       {"time_ms", page_json(r.ms)}});
    for (const auto& c : r.findings.claims)
      claims.push_back({{"report", r.name},
                        {"claim", c.claim},
                        {"source", c.source},
                        {"judged", word(c.judged)},
                        {"verdict", c.verdict},
                        {"anchor", c.anchor}});
    for (const auto& q : r.findings.questions)
      questions.push_back({{"report", r.name},
                           {"question", q.question},
                           {"answer", q.answer},
                           {"anchor", q.anchor}});
  }
  return page_text({{"schema", "gonio.report.index/1"},
                    {"version", index.version},
                    {"full", index.full},
                    {"at_ms", index.at_ms},
                    {"questions", questions},
                    {"reports", reports},
                    {"claims", claims}});
}

std::string index_page_html(std::string_view data) {
  return make_report_page("What approximations lose, and what they cost", data, assets::index_js);
}

}  // namespace gonio
