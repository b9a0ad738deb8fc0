// The cross fit report as JSON and as a page.
#include "reports/page/page.h"

#include "reports/cross_fit/cross_fit.h"
#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"

namespace gonio {
namespace {

PageJson row(const CrossCase& c, const CrossValue& v) {
  return {{"truth", c.truth},
          {"fitted", c.fitted},
          {"kind", c.kind},
          {"material", c.material},
          {"channel", v.channel},
          {"roughness", page_json(c.roughness)},
          {"parameter", v.parameter},
          {"true_value", page_json(v.truth)},
          {"fitted_value", page_json(v.fitted)},
          {"bias", page_json(v.fitted - v.truth)},
          {"std_error", page_json(v.error)},
          {"status", status_names[static_cast<std::size_t>(v.status)]},
          {"converged", c.converged},
          {"residual_log_rms", page_json(c.log_rms)},
          {"truth_log_rms", page_json(c.log_rms_truth)},
          {"metric", metric_names[static_cast<std::size_t>(c.metric)]},
          {"layout", c.layout}};
}

PageJson document(const CrossFitReport& r) {
  PageJson out{{"schema", "gonio.report.cross_fit/1"}, {"full", r.full}, {"findings", r.findings.sentences}};
  PageJson sentences = PageJson::array();
  for (const auto& s : sentences_of_forms(r.rows))
    sentences.push_back(
        {{"truth", s.truth}, {"fitted", s.fitted}, {"kind", s.kind}, {"sentence", s.sentence}});
  out["roughness"] = page_json(r.rows.roughness);
  out["materials"] = r.rows.materials;
  out["walk_error"] = page_json(r.rows.walk_error);
  out["sentences"] = sentences;
  put_pictures(out, r.pictures);
  return out;
}

}  // namespace

std::string to_json(const CrossFitReport& r) {
  auto out = document(r);
  PageJson rows = PageJson::array();
  for (const auto& c : r.rows.cases)
    for (const auto& v : c.values) rows.push_back(row(c, v));
  out["rows"] = rows;
  return page_text(out);
}

std::string cross_fit_page_html(const CrossFitReport& r) {
  return make_report_page("Cross fits: what the other parameters absorb", page_text(document(r)),
                          assets::cross_fit_js);
}

}  // namespace gonio
