#include "reports/cost/cost.h"

#include <algorithm>
#include <iterator>

#include "reports/cost/claims.h"

namespace gonio {

CostOptions cost_options(bool full) {
  CostOptions o;
  o.full = full;
  o.timing.repetitions = full ? 15 : 9;
  return o;
}

CostRows cost_rows(const CostOptions& o, const ReportProgress& done) {
  CostRows r{this_machine(), o, {}, {}, {}, {}};
  r.rows = measure_costs(o, [&](std::string_view what, double x) {
    if (done) done(what, 0.5 * x);
  });
  r.switches = cost_switches(r.rows);
  r.points = cost_points(o, part_of(done, "compensation, split sum, quadrature, fits", 0.5, 1));
  std::ranges::move(power_points(o.timing), std::back_inserter(r.points));
  r.metals = errors_on_metals();
  return r;
}
CostReport cost_report(const CostOptions& o, const ReportProgress& done) {
  return report_of(o.full, cost_rows(o, done));
}

}  // namespace gonio
