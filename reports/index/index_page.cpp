#include "reports/index/index_page.h"

#include <algorithm>
#include <iterator>

#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/picture/document.h"

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

namespace {

struct ClaimOf {
  std::string_view report;
  const Claim* claim;
};
struct QuestionOf {
  std::string_view report;
  const Question* question;
};
std::vector<ClaimOf> claims_of(const ReportIndex& index) {
  std::vector<ClaimOf> out;
  for (const auto& r : index.reports)
    for (const auto& c : r.findings.claims) out.push_back({r.name, &c});
  return out;
}
std::vector<QuestionOf> questions_of(const ReportIndex& index) {
  std::vector<QuestionOf> out;
  for (const auto& r : index.reports)
    for (const auto& q : r.findings.questions) out.push_back({r.name, &q});
  return out;
}

/// Findings that are no claims: those stand apart.
std::vector<std::string> others(const ReportIndex::Entry& r) {
  std::vector<std::string> out;
  std::ranges::copy_if(r.findings.sentences, std::back_inserter(out), [&](const std::string& f) {
    return std::ranges::none_of(r.findings.claims,
                                [&](const Claim& c) { return sentence(c) == f; });
  });
  return out;
}
std::vector<std::string> first_findings(const ReportIndex::Entry& r) {
  auto all = others(r);
  all.resize(std::min(most_findings, all.size()));
  for (auto& f : all) f = first_sentence(f);
  return all;
}

}  // namespace

template <>
struct Description<ReportIndex::Entry> {
  static constexpr auto fields() {
    using E = ReportIndex::Entry;
    return std::tuple{
        field("name", "", &E::name, ""),
        field("what", "", &E::what, ""),
        field("findings", "", first_findings, "first sentences of some"),
        field(
            "more", "", [](const E& e) { return others(e).size() > most_findings; }, "there are"),
        field("pictures", "", &E::pictures, "how many"),
        field("time_ms", "ms", &E::ms, "that it took")};
  }
};
template <>
struct Description<ClaimOf> {
  static constexpr auto fields() {
    using C = ClaimOf;
    return std::tuple{
        field("report", "", &C::report, ""),
        field(
            "claim", "", [](const C& c) { return c.claim->claim; }, "sentence in circulation"),
        field(
            "source", "", [](const C& c) { return c.claim->source; }, "where it stands"),
        field(
            "judged", "", [](const C& c) { return name_of(c.claim->judged); },
            "holds, holds in part, does not hold"),
        field(
            "verdict", "", [](const C& c) { return c.claim->verdict; }, "sentence with figures"),
        field(
            "anchor", "", [](const C& c) { return c.claim->anchor; }, "of the report's page")};
  }
};
template <>
struct Description<QuestionOf> {
  static constexpr auto fields() {
    using Q = QuestionOf;
    return std::tuple{
        field("report", "", &Q::report, ""),
        field(
            "question", "", [](const Q& q) { return q.question->question; }, ""),
        field(
            "answer", "", [](const Q& q) { return q.question->answer; }, ""),
        field(
            "anchor", "", [](const Q& q) { return q.question->anchor; }, "of the report's page")};
  }
};
template <>
struct Description<ReportIndex> {
  static constexpr auto fields() {
    using I = ReportIndex;
    return std::tuple{constant_text("schema", "gonio.report.index/1"),
                      field("version", "", &I::version, "of gonio"),
                      field("full", "", &I::full, setting_meaning),
                      field("at_ms", "ms", &I::at_ms, "since 1970"),
                      field("questions", "", questions_of, ""),
                      field("reports", "", &I::reports, ""),
                      field("claims", "", claims_of, "")};
  }
};

std::string to_json(const ReportIndex& index) {
  return page_document(index);
}
std::string index_schema() {
  return schema_text<ReportIndex>("gonio report all: index.json");
}

std::string index_page_html(std::string_view data) {
  return make_report_page("What approximations lose, and what they cost", data, assets::index_js);
}

}  // namespace gonio
