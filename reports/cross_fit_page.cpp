// The cross fit report as JSON and as a page.
#include "reports/assets.h"
#include "reports/cross_fit.h"
#include "reports/page.h"
#include "reports/page_json.h"

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
          {"metric", metric_names[static_cast<std::size_t>(c.metric)]},
          {"layout", c.layout}};
}

}  // namespace

std::string to_json(const CrossFitReport& r) {
  PageJson out{{"schema", "gonio.report.cross_fit/1"}, {"full", r.full}, {"findings", r.findings}};
  PageJson rows = PageJson::array();
  for (const auto& c : r.cases)
    for (const auto& v : c.values) rows.push_back(row(c, v));
  out["rows"] = rows;
  out["roughness"] = page_json(r.roughness);
  out["materials"] = r.materials;
  out["walk_error"] = page_json(r.walk_error);
  return page_text(out);
}

std::string cross_fit_page_html(std::string_view data) {
  return make_report_page("Cross fits: what the other parameters absorb", data,
                          assets::cross_fit_js);
}

}  // namespace gonio
