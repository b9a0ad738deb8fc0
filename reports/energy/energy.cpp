#include "reports/energy/energy.h"

#include <algorithm>
#include <cmath>

#include "reports/energy/parts.h"

#include <fmt/format.h>

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
  return o;
}

EnergyReport energy_report(const EnergyOptions& o, const ReportProgress& done) {
  EnergyReport r;
  r.full = o.full;
  // What each part takes of the whole, about.
  const auto part = [&](std::string_view what, double from, double to) {
    return part_of(done, what, from, to);
  };
  add_forms(r, o, part("every masking form", 0, 0.4));
  add_materials(r, o, part("all bounces", 0.4, 0.7));
  add_costs(r);
  add_albedo_forms(r);
  add_estimators(r, o, part("error against time", 0.7, 0.8));
  add_light(r, o, part("image-based light", 0.8, 1));
  add_findings(r);
  judge_claims(r);
  return r;
}

}  // namespace gonio
