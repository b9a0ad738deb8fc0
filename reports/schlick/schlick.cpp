#include "reports/schlick/schlick.h"

#include "reports/schlick/parts.h"

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

SchlickReport schlick_report(const SchlickOptions& o, const ReportProgress& done) {
  SchlickReport r;
  r.full = o.full;
  // What each part takes of the whole, about.
  const auto part = [&](std::string_view what, double from, double to) {
    return part_of(done, what, from, to);
  };
  add_rows(r, o, part("every form by angle", 0, 0.3));
  add_maps(r);
  add_curves(r);
  add_albedos(r, o, part("rough surfaces", 0.3, 1));
  add_findings(r);
  return r;
}

}  // namespace gonio
