// The cross fit report as JSON and as a page.
#include "reports/page/page.h"

#include "reports/cross_fit/cross_fit.h"
#include "reports/page/assets.h"
#include "reports/picture/document.h"

namespace gonio {
namespace {

/// Row of the document: a value of a case.
struct CrossRow {
  const CrossCase* c;
  const CrossValue* v;
};
std::vector<CrossRow> rows_of(const CrossFitReport& r) {
  std::vector<CrossRow> out;
  for (const auto& c : r.rows.cases)
    for (const auto& v : c.values) out.push_back({&c, &v});
  return out;
}

/// Document of the page: the rows are many, and pictures and sentences show them.
struct WithoutRows {
  const CrossFitReport* report;
};

}  // namespace

template <>
struct Description<CrossRow> {
  static constexpr auto fields() {
    using R = CrossRow;
    return std::tuple{
        field(
            "truth", "", [](const R& r) { return r.c->truth; }, "surface that is synthesized"),
        field(
            "fitted", "", [](const R& r) { return r.c->fitted; }, "form"),
        field(
            "kind", "", [](const R& r) { return r.c->kind; }, "what differs from the truth"),
        field(
            "material", "", [](const R& r) { return r.c->material; }, ""),
        field(
            "channel", "", [](const R& r) { return r.v->channel; }, "empty: the one there is"),
        field(
            "roughness", "", [](const R& r) { return r.c->roughness; }, "of the truth"),
        field(
            "parameter", "", [](const R& r) { return r.v->parameter; }, ""),
        field(
            "true_value", "", [](const R& r) { return r.v->truth; }, ""),
        field(
            "fitted_value", "", [](const R& r) { return r.v->fitted; }, ""),
        field(
            "bias", "", [](const R& r) { return r.v->fitted - r.v->truth; }, "fitted − true"),
        field(
            "std_error", "", [](const R& r) { return r.v->error; },
            "of the fitted value by that of the truth; 0: the truth is exact"),
        field(
            "status", "", [](const R& r) { return name_of(r.v->status); },
            "free, fixed, at_bound, not_identifiable"),
        field(
            "converged", "", [](const R& r) { return r.c->converged; }, ""),
        field(
            "residual_log_rms", "", [](const R& r) { return r.c->log_rms; }, "of ln f − ln truth"),
        field(
            "truth_log_rms", "", [](const R& r) { return r.c->log_rms_truth; },
            "of it what is noise of the truth"),
        field(
            "metric", "", [](const R& r) { return name_of(r.c->metric); }, "of the fit"),
        field(
            "layout", "", [](const R& r) { return r.c->layout; }, "directions")};
  }
};

template <>
struct Description<CrossSentence> {
  static constexpr auto fields() {
    using S = CrossSentence;
    return std::tuple{field("truth", "", &S::truth, ""), field("fitted", "", &S::fitted, ""),
                      field("kind", "", &S::kind, ""), field("sentence", "", &S::sentence, "")};
  }
};
static_assert(describes_every_member<CrossSentence>());

template <>
struct Description<WithoutRows> {
  static constexpr auto fields() {
    using R = WithoutRows;
    return std::tuple{
        constant_text("schema", "gonio.report.cross_fit/1"),
        field(
            "full", "", [](const R& r) { return r.report->full; }, setting_meaning),
        field(
            "findings", "", [](const R& r) { return r.report->findings.sentences; },
            findings_meaning),
        field(
            "roughness", "", [](const R& r) { return r.report->rows.roughness; }, "of the truths"),
        field(
            "materials", "", [](const R& r) { return r.report->rows.materials; }, ""),
        field(
            "walk_error", "", [](const R& r) { return r.report->rows.walk_error; },
            "RMS over values of the standard error of ln f that the walks leave"),
        field(
            "sentences", "", [](const R& r) { return sentences_of_forms(r.report->rows); },
            "of each form and truth"),
        inlined([](const R& r) -> const Pictures& { return r.report->pictures; })};
  }
};

template <>
struct Description<CrossFitReport> {
  static constexpr auto fields() {
    return std::tuple{inlined([](const CrossFitReport& r) { return WithoutRows{&r}; }),
                      field("rows", "", rows_of, "a parameter of a fit, each")};
  }
};

std::string to_json(const CrossFitReport& r) {
  return page_document(r);
}
std::string rows_csv(const CrossFitReport& r) {
  return csv_of(rows_of(r), Digits::six);
}
std::string cross_fit_schema() {
  return schema_text<CrossFitReport>("gonio report cross_fit");
}
std::string cross_fit_page_html(const CrossFitReport& r) {
  return make_report_page("Cross fits: what the other parameters absorb",
                          page_document(WithoutRows{&r}), assets::cross_fit_js);
}

}  // namespace gonio
