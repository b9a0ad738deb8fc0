// The report on Schlick's approximation as JSON and as a page.
#include "reports/page/page.h"

#include <algorithm>

#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"
#include "reports/schlick/schlick.h"

namespace gonio {

std::string to_json(const SchlickReport& r) {
  PageJson out{{"schema", "gonio.report.schlick/1"}, {"full", r.full}, {"findings", r.findings.sentences}};
  PageJson rows = PageJson::array();
  for (const auto& x : r.rows.smooth)
    rows.push_back({{"form", x.form},
                    {"kind", x.kind},
                    {"name", x.name},
                    {"material", x.material},
                    {"channel", x.channel},
                    {"eta", page_json(x.eta)},
                    {"k", page_json(x.k)},
                    {"max_abs", page_json(x.max_abs)},
                    {"max_abs_theta_deg", page_json(x.max_abs_theta_deg)},
                    {"max_rel", page_json(x.max_rel)},
                    {"max_rel_theta_deg", page_json(x.max_rel_theta_deg)},
                    {"rms", page_json(x.rms)},
                    {"bias", page_json(x.bias)},
                    {"within_1_percent_to_deg", page_json(x.within_deg)}});
  double bound = 0;
  for (const auto& a : r.rows.rough.albedos) bound = std::max(bound, a.bound);
  out["albedo_error_bound"] = page_json(bound);
  out["rows"] = rows;
  put_pictures(out, r.pictures);
  return page_text(out);
}

std::string schlick_page_html(std::string_view data) {
  return make_report_page("Schlick's approximation and its kin", data, assets::schlick_js);
}

}  // namespace gonio
