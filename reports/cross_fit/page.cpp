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
inline constexpr auto description<CrossRow> = FieldList{
    Field{"truth", [](const CrossRow& r) { return r.c->truth; }, "surface that is synthesized"},
    Field{"fitted", [](const CrossRow& r) { return r.c->fitted; },
          "form that is fitted to it, by id"},
    Field{"kind", [](const CrossRow& r) { return r.c->kind; }, "what differs from the truth"},
    Field{"material", [](const CrossRow& r) { return r.c->material; },
          "metal, or IOR of a dielectric"},
    Field{"channel", [](const CrossRow& r) { return r.v->channel; },
          "red, green or blue; empty of a grey surface"},
    Field{"roughness", [](const CrossRow& r) { return r.c->roughness; }, "roughness of the truth"},
    Field{"parameter", [](const CrossRow& r) { return r.v->parameter; },
          "roughness, f0, gamma or kd"},
    Field{"true_value", [](const CrossRow& r) { return r.v->truth; }, "its value in the truth"},
    Field{"fitted_value", [](const CrossRow& r) { return r.v->fitted; },
          "value that the fit finds"},
    Field{"bias", [](const CrossRow& r) { return r.v->fitted - r.v->truth; }, "fitted − true"},
    Field{"std_error", [](const CrossRow& r) { return r.v->error; },
          "standard error that noise of the truth gives the fitted value; 0: the truth is exact"},
    Field{"status", [](const CrossRow& r) { return name_of(r.v->status); },
          "free, fixed, at_bound, not_identifiable"},
    Field{"converged", [](const CrossRow& r) { return r.c->converged; },
          "false: the fit stopped early"},
    Field{"residual_log_rms", [](const CrossRow& r) { return r.c->log_rms; },
          "RMS of ln f − ln truth"},
    Field{"truth_log_rms", [](const CrossRow& r) { return r.c->log_rms_truth; },
          "part of that residual that is noise of the truth"},
    Field{"metric", [](const CrossRow& r) { return name_of(r.c->metric); }, "metric of the fit"},
    Field{"layout", [](const CrossRow& r) { return r.c->layout; }, "set of directions"}};

template <>
inline constexpr auto description<CrossSentence> = FieldList{
    Field{"truth", &CrossSentence::truth, ""}, Field{"fitted", &CrossSentence::fitted, ""},
    Field{"kind", &CrossSentence::kind, ""}, Field{"sentence", &CrossSentence::sentence, ""}};
static_assert(describes_every_member<CrossSentence>());

template <>
inline constexpr auto description<PublishedFit> = FieldList{
    Field{"material", &PublishedFit::material, "of the MERL database"},
    Field{"width", &PublishedFit::width, "roughness of the highlight's core, as published"},
    Field{"tail", &PublishedFit::tail, "exponent of its tail, as published; of GGX it is 2"},
    Field{"beckmann", &PublishedFit::beckmann, "roughness of Beckmann's, as published"},
    Field{"ggx_roughness", &PublishedFit::ggx_roughness, "of GGX fitted to it"},
    Field{"ggx_log_rms", &PublishedFit::ggx_log_rms,
          "residual of ln f that GGX leaves, with height-correlated Smith"},
    Field{"gtr_roughness", &PublishedFit::gtr_roughness, "of GTR fitted to it"},
    Field{"gamma", &PublishedFit::gamma,
          "of GTR fitted to it; of GGX it is 2; null: it could be any"},
    Field{"gamma_determined", &PublishedFit::gamma_determined, "else it has no interval"},
    Field{"gtr_log_rms", &PublishedFit::gtr_log_rms,
          "residual of ln f that GTR leaves, with its own height-correlated Smith"}};
static_assert(describes_every_member<PublishedFit>());

template <>
inline constexpr auto description<CrossRange> = FieldList{
    Field{"fitted", &CrossRange::fitted, "form, to GGX met once"},
    Field{"name", [](const CrossRange& r) { return name_of_form(r.fitted); }, "its name"},
    Field{"material", &CrossRange::material, ""},
    Field{"parameter", &CrossRange::parameter, "roughness, f0"},
    Field{"metric", [](const CrossRange& r) { return name_of(r.metric); }, "of the fits"},
    Field{"layout", &CrossRange::layout, "set of directions"},
    Field{"directions", [](const CrossRange& r) { return words_of_layout(r.layout); }, "in words"},
    Field{"least", &CrossRange::least,
          "shift over the roughnesses, of F0 as a part of the truth; null: no fit shows it"},
    Field{"most", &CrossRange::most, "the same"},
    Field{"fits", &CrossRange::fits, "values that were fitted, one a channel"},
    Field{"at_bound", &CrossRange::at_bound,
          "of them without an interval: at a bound, not determined, or not bounded"}};

template <>
inline constexpr auto description<WithoutRows> = FieldList{
    constant_text("schema", "gonio.report.cross_fit/1"),
    Field{"full", [](const WithoutRows& r) { return r.report->full; }, setting_meaning},
    Field{"findings", [](const WithoutRows& r) { return r.report->findings.sentences; },
          findings_meaning},
    Field{"roughness", [](const WithoutRows& r) { return r.report->rows.roughness; },
          "roughnesses of the truths"},
    Field{"materials", [](const WithoutRows& r) { return r.report->rows.materials; }, ""},
    Field{"walk_error", [](const WithoutRows& r) { return r.report->rows.walk_error; },
          "noise of the random walks: RMS of the standard error of ln f"},
    Field{"ranges", [](const WithoutRows& r) { return ranges(r.report->rows); },
          "shifts by form, metric and directions"},
    Field{"published", [](const WithoutRows& r) { return r.report->rows.published; },
          "published fits of measured materials, fitted anew"},
    Field{"sentences", [](const WithoutRows& r) { return sentences_of_forms(r.report->rows); },
          "what each form does to each truth"},
    inlined([](const WithoutRows& r) -> const Pictures& { return r.report->pictures; })};

template <>
inline constexpr auto description<CrossFitReport> =
    FieldList{inlined([](const CrossFitReport& r) { return WithoutRows{&r}; }),
              Field{"rows", rows_of, "one for each parameter of each fit"}};

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
