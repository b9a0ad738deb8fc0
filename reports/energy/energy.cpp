#include "reports/energy/energy.h"

#include <algorithm>
#include <cmath>

namespace gonio {
namespace {

std::vector<double> steps(double from, double step) {
  std::vector<double> out;
  for (int i = 0; from + i * step < 1 + 1e-9; ++i) out.push_back(std::min(from + i * step, 1.0));
  return out;
}

}  // namespace

EnergyOptions energy_options(bool full) {
  const double step = full ? 0.025 : 0.05;
  EnergyOptions o{full, steps(0.05, step), steps(step, step), full ? 262'144U : 65'536U};
  o.mu.insert(o.mu.begin(), 0.01);
  o.views = full ? 128 : 16;
  if (full) o.lit_points = 1024;
  return o;
}

EnergyOptions compensation_domain() {
  EnergyOptions o{false, steps(0.1, 0.1), steps(0.1, 0.1), 0};
  o.gold = false;
  return o;
}

EnergyRows energy_rows(const EnergyOptions& o, const ReportProgress& done) {
  // The parts of the whole that each takes, about.
  EnergyRows r;
  r.forms = energy_forms(o, part_of(done, "every masking form", 0, 0.4));
  r.materials = energy_materials(o, part_of(done, "all bounces", 0.4, 0.7));
  r.compensations = compensation_costs(r.materials);
  r.single_lights = single_lights(o, part_of(done, "balls under a light", 0.7, 0.72));
  r.albedo_forms = albedo_form_errors();
  r.estimators = estimator_points(o, part_of(done, "error against time", 0.72, 0.8));
  r.light = image_light(o, part_of(done, "image-based light", 0.8, 1));
  r.claims = claim_rows(r.forms);
  return r;
}
EnergyReport energy_report(const EnergyOptions& o, const ReportProgress& done) {
  return report_of(o.full, energy_rows(o, done));
}

const EnergyForm* find_form(const std::vector<EnergyForm>& forms, std::string_view name) {
  const auto it = std::ranges::find(forms, name, &EnergyForm::name);
  return it == forms.end() ? nullptr : &*it;
}

}  // namespace gonio
