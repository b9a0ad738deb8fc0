#include "reports/cost/cost.h"

#include <algorithm>
#include <iterator>

#include "reports/cost/claims.h"
#include "reports/cost/studies.h"

#include <fmt/format.h>

namespace gonio {

CostOptions cost_options(bool full) {
  CostOptions o;
  o.full = full;
  // Each way in which columns lie, once in each process.
  o.timing = {3, full ? 1e-3 : 4e-4, true};
  o.processes = full ? 15 : 7;
  return o;
}

std::string long_columns(const CostOptions& o) {
  return fmt::format("columns of {:.3g} MiB",
                     static_cast<double>(o.stream_samples * sizeof(float)) / 0x1p20);
}

CostRows cost_rows(const CostOptions& o, const ReportProgress& done) {
  CostRows r{this_machine(), o, {}, {}, {}, {}, 1, {}, {}};
  auto measured = measure_costs(o, [&](std::string_view what, double x) {
    if (done) done(what, 0.5 * x);
  });
  r.rows = std::move(measured.rows);
  r.processes = measured.processes, r.others = measured.others;
  r.switches = cost_switches(r.rows);
  r.points = cost_points(o, part_of(done, "compensation, split sum, quadrature, fits", 0.5, 1));
  std::ranges::move(power_points(o.timing), std::back_inserter(r.points));
  r.metals = errors_on_metals();
  r.studies =
      costing::with_times(costing::study_errors(), r.rows, r.machine.instruction_sets.back());
  r.studies.shaders = costing::shader_rows();
  return r;
}
CostReport cost_report(const CostOptions& o, const ReportProgress& done) {
  return report_of(o.full, cost_rows(o, done));
}

}  // namespace gonio
