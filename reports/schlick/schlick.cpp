#include "reports/schlick/schlick.h"

namespace gonio {

SchlickOptions schlick_options(bool full) {
  SchlickOptions o{full, {1.01}, full ? 9000U : 900U, {}};
  const int per_unit = full ? 100 : 50;
  for (int i = per_unit + 1; i <= 3 * per_unit; ++i) {
    const double ior = static_cast<double>(i) / per_unit;
    if (ior > o.ior.front()) o.ior.push_back(ior);
  }
  const int roughnesses = full ? 20 : 10;
  for (int i = 1; i <= roughnesses; ++i)
    o.roughness.push_back(static_cast<double>(i) / roughnesses);
  return o;
}

SchlickRows schlick_rows(const SchlickOptions& o, const ReportProgress& done) {
  // The parts of the whole that each takes, about.
  SchlickRows r;
  r.smooth = smooth_rows(o, part_of(done, "every form by angle", 0, 0.3));
  r.maps = fresnel_maps();
  r.curves = fresnel_curves();
  r.rough = rough_rows(o, part_of(done, "rough surfaces", 0.3, 0.9));
  r.masked = masked_rows(o, part_of(done, "other factors", 0.9, 1));
  return r;
}
SchlickReport schlick_report(const SchlickOptions& o, const ReportProgress& done) {
  return report_of(o.full, schlick_rows(o, done));
}

}  // namespace gonio
