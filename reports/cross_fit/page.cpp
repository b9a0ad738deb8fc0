// The cross fit report as JSON.
#include <algorithm>

#include "reports/cross_fit/cross_fit.h"
#include "reports/finding/names.h"
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

std::string_view words_of_layout(std::string_view name) {
  return std::ranges::find(cross_layouts, name, &CrossLayout::name)->what;
}

}  // namespace

template <>
struct Description<CrossRow> {
  static constexpr auto fields() {
    using R = CrossRow;
    return std::tuple{
        field(
            "truth", "", [](const R& r) { return r.c->truth; }, "surface that is synthesized"),
        field(
            "fitted", "", [](const R& r) { return r.c->fitted; },
            "form that is fitted to it, by id"),
        field(
            "kind", "", [](const R& r) { return r.c->kind; }, "what differs from the truth"),
        field(
            "material", "", [](const R& r) { return r.c->material; },
            "metal, or IOR of a dielectric"),
        field(
            "channel", "", [](const R& r) { return r.v->channel; },
            "red, green or blue; empty of a grey surface"),
        field(
            "roughness", "", [](const R& r) { return r.c->roughness; }, "roughness of the truth"),
        field(
            "parameter", "", [](const R& r) { return r.v->parameter; },
            "roughness, f0, gamma or kd"),
        field(
            "true_value", "", [](const R& r) { return r.v->truth; }, "its value in the truth"),
        field(
            "fitted_value", "", [](const R& r) { return r.v->fitted; }, "value that the fit finds"),
        field(
            "bias", "", [](const R& r) { return r.v->fitted - r.v->truth; }, "fitted − true"),
        field(
            "std_error", "", [](const R& r) { return r.v->error; },
            "standard error that noise of the truth gives the fitted value; 0: the truth is exact"),
        field(
            "status", "", [](const R& r) { return name_of(r.v->status); },
            "free, fixed, at_bound, not_identifiable"),
        field(
            "converged", "", [](const R& r) { return r.c->converged; },
            "false: the fit stopped early"),
        field(
            "residual_log_rms", "", [](const R& r) { return r.c->log_rms; },
            "RMS of ln f − ln truth"),
        field(
            "truth_log_rms", "", [](const R& r) { return r.c->log_rms_truth; },
            "part of that residual that is noise of the truth"),
        field(
            "metric", "", [](const R& r) { return name_of(r.c->metric); }, "metric of the fit"),
        field(
            "layout", "", [](const R& r) { return r.c->layout; }, "set of directions")};
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
struct Description<PublishedFit> {
  static constexpr auto fields() {
    using P = PublishedFit;
    return std::tuple{
        field("material", "", &P::material, "of the MERL database"),
        field("width", "", &P::width, "roughness of the highlight's core, as published"),
        field("tail", "", &P::tail, "exponent of its tail, as published; of GGX it is 2"),
        field("beckmann", "", &P::beckmann, "roughness of Beckmann's, as published"),
        field("ggx_roughness", "", &P::ggx_roughness, "of GGX fitted to it"),
        field("ggx_log_rms", "", &P::ggx_log_rms, "residual of ln f that GGX leaves"),
        field("gtr_roughness", "", &P::gtr_roughness, "of GTR fitted to it"),
        field("gamma", "", &P::gamma, "of GTR fitted to it; of GGX it is 2"),
        field("gamma_determined", "", &P::gamma_determined, "else it ended at its bound"),
        field("gtr_log_rms", "", &P::gtr_log_rms, "residual of ln f that GTR leaves")};
  }
};
static_assert(describes_every_member<PublishedFit>());

template <>
struct Description<CrossRange> {
  static constexpr auto fields() {
    using R = CrossRange;
    return std::tuple{
        field("fitted", "", &R::fitted, "form, to GGX met once"),
        field(
            "name", "", [](const R& r) { return name_of_form(r.fitted); }, "its name"),
        field("material", "", &R::material, ""),
        field("parameter", "", &R::parameter, "roughness, f0"),
        field(
            "metric", "", [](const R& r) { return name_of(r.metric); }, "of the fits"),
        field("layout", "", &R::layout, "set of directions"),
        field(
            "directions", "", [](const R& r) { return words_of_layout(r.layout); }, "in words"),
        field("least", "", &R::least,
              "shift over the roughnesses, of F0 as a part of the truth; null: no fit tells"),
        field("most", "", &R::most, "the same"),
        field("fits", "", &R::fits, "values that were fitted, one a channel"),
        field("at_bound", "", &R::at_bound, "of them at a bound, or not determined")};
  }
};

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
            "roughness", "", [](const R& r) { return r.report->rows.roughness; },
            "roughnesses of the truths"),
        field(
            "materials", "", [](const R& r) { return r.report->rows.materials; }, ""),
        field(
            "walk_error", "", [](const R& r) { return r.report->rows.walk_error; },
            "noise of the random walks: RMS of the standard error of ln f"),
        field(
            "ranges", "", [](const R& r) { return ranges(r.report->rows); },
            "shifts by form, metric and directions"),
        field(
            "published", "", [](const R& r) { return r.report->rows.published; },
            "published fits of measured materials, fitted anew"),
        field(
            "sentences", "", [](const R& r) { return sentences_of_forms(r.report->rows); },
            "what each form does to each truth"),
        inlined([](const R& r) -> const Pictures& { return r.report->pictures; })};
  }
};

template <>
struct Description<CrossFitReport> {
  static constexpr auto fields() {
    return std::tuple{inlined([](const CrossFitReport& r) { return WithoutRows{&r}; }),
                      field("rows", "", rows_of, "one for each parameter of each fit")};
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

}  // namespace gonio
