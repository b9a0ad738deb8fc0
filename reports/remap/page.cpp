// The remap report as JSON and as a page.
#include "reports/page/page.h"

#include <algorithm>

#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"
#include "reports/remap/remap.h"

namespace gonio {
namespace {

PageJson row(const RemapRow& r) {
  return {{"form", r.form},
          {"reference", r.reference},
          {"roughness", page_json(r.roughness)},
          {"rms", page_json(r.rms)},
          {"max_rel", page_json(r.max_rel)},
          {"albedo_mu_0_5", page_json(r.albedo)},
          {"rms_error", page_json(r.rms_error)},
          {"bias", page_json(r.bias)},
          {"max_rel_nol", page_json(r.max_rel_nol)},
          {"max_rel_nov", page_json(r.max_rel_nov)},
          {"albedo_reference", page_json(r.albedo_reference)},
          {"albedo_error", page_json(r.albedo_error)},
          {"like_by_g2", page_json(r.by_g2.roughness)},
          {"like_by_g2_left", page_json(r.by_g2.left)},
          {"like_by_g2_at_end", r.by_g2.at_end},
          {"like_by_albedo", page_json(r.by_albedo.roughness)},
          {"like_by_albedo_left", page_json(r.by_albedo.left)},
          {"like_by_albedo_at_end", r.by_albedo.at_end}};
}

}  // namespace

std::string to_json(const RemapReport& r) {
  PageJson out{{"schema", "gonio.report.remap/1"}, {"full", r.full}, {"findings", r.findings.sentences}};
  PageJson rows = PageJson::array(), forms = PageJson::array(), g1 = PageJson::array(),
           vf = PageJson::array();
  double albedo_error = 0;
  for (const auto& one : r.rows.rows) rows.push_back(row(one));
  for (const auto& f : r.rows.forms) {
    forms.push_back({{"form", f.form},
                     {"ndf", f.ndf},
                     {"formula", f.formula},
                     {"ships", f.ships},
                     {"operations", f.operations},
                     {"roots", f.roots},
                     {"reads_half", f.reads_half}});
    for (const auto& at : f.at) albedo_error = std::max(albedo_error, at.error);
  }
  for (const auto& g : r.rows.g1)
    g1.push_back({{"k", page_json(g.k)},
                  {"nov", page_json(g.nov)},
                  {"claimed", page_json(g.claimed)},
                  {"value", page_json(g.value)},
                  {"roughness", page_json(g.roughness)},
                  {"smith", page_json(g.smith)}});
  for (const auto& v : r.rows.vf)
    vf.push_back({{"form", v.form},
                  {"fresnel", v.fresnel},
                  {"over", v.over},
                  {"roughness", page_json(v.roughness)},
                  {"bias", page_json(v.bias)},
                  {"factor", page_json(v.factor)},
                  {"least", page_json(v.least)},
                  {"most", page_json(v.most)}});
  out["rows"] = rows;
  out["forms"] = forms;
  out["albedo_error"] = page_json(albedo_error);
  out["g1"] = g1;
  out["vf"] = vf;
  put_pictures(out, r.pictures);
  return page_text(out);
}

std::string remap_page_html(std::string_view data) {
  return make_report_page("Masking: what the remaps do", data, assets::remap_js);
}

}  // namespace gonio
