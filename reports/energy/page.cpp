// The energy report as JSON and as a page.
#include "reports/page/page.h"

#include "reports/energy/energy.h"
#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"

namespace gonio {
namespace {

/// 0 stands for the average.
PageJson mu_json(double mu) {
  return mu > 0 ? page_json(mu) : PageJson("average");
}

PageJson json(const Crossing& c) {
  PageJson ranges = PageJson::array();
  for (const auto& r : c.ranges) ranges.push_back({page_json(r.from), page_json(r.to)});
  return {{"share", page_json(c.share)},
          {"mu", mu_json(c.mu)},
          {"ranges", ranges},
          {"error", c.ranges.empty() ? PageJson(nullptr) : page_json(c.error)}};
}

/// One object a roughness and angle; `average` is that of its roughness.
void put_rows(PageJson& rows, const EnergyForm& f) {
  auto average = f.averages.begin();
  for (const auto& at : f.rows) {
    if (at.roughness != average->roughness) ++average;
    rows.push_back({{"form", f.name},
                    {"ndf", f.ndf},
                    {"masking", f.masking},
                    {"roughness", page_json(at.roughness)},
                    {"mu", page_json(at.mu)},
                    {"albedo", page_json(at.albedo)},
                    {"loss", page_json(1 - at.albedo)},
                    {"error", page_json(at.error)},
                    {"average", page_json(average->albedo)},
                    {"average_error", page_json(average->error)}});
  }
}

void put_material(PageJson& truth, const EnergyMaterial& m) {
  for (const auto& at : m.rows) {
    truth.push_back({{"material", m.name},
                     {"roughness", page_json(at.roughness)},
                     {"mu", mu_json(at.mu)},
                     {"albedo", page_json(at.truth)},
                     {"error", page_json(at.error)},
                     {"orders", page_json(at.orders)}});
  }
}

}  // namespace

std::string to_json(const EnergyReport& r) {
  PageJson out{{"schema", "gonio.report.energy/1"}, {"full", r.full}, {"findings", r.findings.sentences}};
  PageJson rows = PageJson::array(), forms = PageJson::array(), materials = PageJson::array(),
           truth = PageJson::array(), costs = PageJson::array(), estimators = PageJson::array(),
           crossings = PageJson::array(), albedo_forms = PageJson::array();
  const auto put_crossings = [&](const char* kind, const std::string& name,
                                 const std::vector<Crossing>& list) {
    for (const auto& c : list) {
      PageJson one{{kind, name}};
      one.update(json(c));
      crossings.push_back(one);
    }
  };
  for (const auto& f : r.rows.forms) {
    put_rows(rows, f);
    put_crossings("form", f.name, f.crossings);
    forms.push_back({{"form", f.name},
                     {"ndf", f.ndf},
                     {"masking", f.masking},
                     {"model", f.model},
                     {"gamma", f.gamma > 0 ? page_json(f.gamma) : PageJson(nullptr)},
                     {"divisor", page_json(f.divisor)}});
  }
  for (const auto& m : r.rows.materials) {
    put_material(truth, m);
    put_crossings("material", m.name, m.crossings);
    materials.push_back({{"material", m.name}, {"fresnel", m.fresnel}});
  }
  for (const auto& c : r.rows.compensations)
    costs.push_back({{"scattering", c.id},
                     {"operations", c.operations},
                     {"lookups", c.lookups},
                     {"bytes", c.bytes},
                     {"without_ns", page_json(c.without_ns)},
                     {"cost_ns", page_json(c.ns)},
                     {"spread_ns", page_json(c.spread_ns)},
                     {"worst", page_json(c.worst)},
                     {"rms", page_json(c.rms)},
                     {"worst_at", c.worst_at},
                     {"gold_rms", page_json(c.gold_rms)}});
  for (const auto& a : r.rows.albedo_forms)
    albedo_forms.push_back({{"form", a.id},
                            {"worst", page_json(a.worst)},
                            {"rms", page_json(a.rms)},
                            {"worst_at", a.worst_at},
                            {"operations", a.operations},
                            {"bytes", a.bytes}});
  for (const auto& e : r.rows.estimators)
    estimators.push_back({{"estimator", e.estimator},
                          {"roughness", page_json(e.roughness)},
                          {"mu", page_json(e.mu)},
                          {"goal", page_json(e.goal)},
                          {"error", page_json(e.error)},
                          {"bound", e.bound > 0 ? page_json(e.bound) : PageJson(nullptr)},
                          {"evaluations", page_json(e.evaluations)},
                          {"cost_ns", page_json(e.ns)},
                          {"spread_ns", page_json(e.ns_spread)}});
  PageJson tables = PageJson::array(), samples = PageJson::array(), lit = PageJson::array(),
           irradiance = PageJson::array();
  for (const auto& t : r.rows.light.tables)
    tables.push_back({{"size", t.size},
                      {"stored", t.stored},
                      {"bound", page_json(t.bound)},
                      {"storage_max", page_json(t.storage)},
                      {"lookup_max", page_json(t.lookup)},
                      {"lookup_rms", page_json(t.lookup_rms)},
                      {"between_centres_max", page_json(t.between)}});
  for (const auto& t : r.rows.light.table_samples)
    samples.push_back({{"samples", t.samples},
                       {"a_max", page_json(t.a)},
                       {"a_rms", page_json(t.a_rms)},
                       {"b_max", page_json(t.b)},
                       {"b_rms", page_json(t.b_rms)}});
  for (const auto& l : r.rows.light.lit)
    lit.push_back({{"environment", l.environment},
                   {"roughness", page_json(l.roughness)},
                   {"nov", page_json(l.nov)},
                   {"f0", page_json(l.f0)},
                   {"rms", page_json(l.rms)},
                   {"max", page_json(l.max)},
                   {"bias", page_json(l.bias)},
                   {"of_mean", page_json(l.of_mean)},
                   {"of_mean_spread", page_json(l.of_mean_spread)},
                   {"truth_error", page_json(l.truth)}});
  for (const auto& i : r.rows.light.irradiance)
    irradiance.push_back({{"light", i.light},
                          {"rule", i.rule},
                          {"samples", i.samples},
                          {"rms", page_json(i.rms)},
                          {"max", page_json(i.max)},
                          {"bias", page_json(i.bias)},
                          {"cost_ns", page_json(i.ns)},
                          {"spread_ns", page_json(i.spread_ns)}});
  out["rows"] = rows;
  out["forms"] = forms;
  out["crossings"] = crossings;
  out["materials"] = materials;
  out["truth"] = truth;
  out["costs"] = costs;
  out["albedo_forms"] = albedo_forms;
  out["estimators"] = estimators;
  out["split_sum_tables"] = tables;
  out["split_sum_samples"] = samples;
  out["views"] = r.rows.light.views;
  out["split_sum_light"] = lit;
  out["irradiance"] = irradiance;
  put_pictures(out, r.pictures);
  return page_text(out);
}

std::string energy_page_html(std::string_view data) {
  return make_report_page("Energy: what single scattering loses", data, assets::energy_js);
}

}  // namespace gonio
