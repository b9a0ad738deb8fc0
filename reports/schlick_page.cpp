// The report on Schlick's approximation as JSON and as a page.
#include "reports/assets.h"
#include "reports/page.h"
#include "reports/page_json.h"
#include "reports/schlick.h"

namespace gonio {

std::string to_json(const SchlickReport& r) {
  PageJson out{{"schema", "gonio.report.schlick/1"}, {"full", r.full}, {"findings", r.findings}};
  PageJson rows = PageJson::array(), maps = PageJson::array(), curves = PageJson::array(),
           albedos = PageJson::array(), colours = PageJson::array();
  for (const auto& x : r.rows)
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
  for (const auto& m : r.maps)
    maps.push_back({{"form", m.form}, {"kind", m.kind}, {"error", page_json(m.error)}});
  for (const auto& c : r.curves)
    curves.push_back({{"form", c.form},
                      {"kind", c.kind},
                      {"material", c.material},
                      {"channel", c.channel},
                      {"value", page_json(c.value)}});
  for (const auto& a : r.albedos)
    albedos.push_back({{"form", a.form},
                       {"material", a.material},
                       {"channel", a.channel},
                       {"mu", page_json(a.mu)},
                       {"albedo", page_json(a.albedo)},
                       {"exact", page_json(a.exact)},
                       {"error_bound", page_json(a.bound)}});
  for (const auto& c : r.colours)
    colours.push_back({{"form", c.form},
                       {"material", c.material},
                       {"mu", page_json(c.mu)},
                       {"delta_e", page_json(c.delta_e)}});
  out["rows"] = rows;
  out["map"] = {{"ior", page_json(r.map_ior)}, {"theta_deg", page_json(r.map_theta_deg)}};
  out["maps"] = maps;
  out["curve_theta_deg"] = page_json(r.curve_theta_deg);
  out["curves"] = curves;
  out["roughness"] = page_json(r.roughness);
  out["albedos"] = albedos;
  out["colours"] = colours;
  return page_text(out);
}

std::string schlick_page_html(std::string_view data) {
  return make_report_page("Schlick's approximation and its kin", data, assets::schlick_js);
}

}  // namespace gonio
