#include "reports/cost/cost.h"

#include "reports/cost/parts.h"

namespace gonio {

CostOptions cost_options(bool full) {
  CostOptions o;
  o.full = full;
  o.timing.repetitions = full ? 15 : 9;
  return o;
}

CostReport cost_report(const CostOptions& o, const ReportProgress& done) {
  CostReport r;
  r.machine = this_machine();
  r.options = o;
  r.rows = measure_costs(o, [&](std::string_view what, double x) {
    if (done) done(what, 0.5 * x);
  });
  add_switches(r);
  add_points(r, o, part_of(done, "compensation, split sum, quadrature, fits", 0.5, 1));
  add_findings(r);
  return r;
}

}  // namespace gonio
