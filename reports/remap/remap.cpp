#include "reports/remap/remap.h"

#include "reports/remap/parts.h"

namespace gonio {
namespace {

/// step, 2 step, … 1, each the nearest number to its decimal.
std::vector<double> parts(int n, int from = 1, int by = 1) {
  std::vector<double> out;
  for (int i = from; i <= n; i += by) out.push_back(static_cast<double>(i) / n);
  return out;
}

}  // namespace

RemapOptions remap_options(bool full) {
  const int n = full ? 40 : 20;
  return {full, parts(n), parts(n, n / 10, n / 10), full ? 128U : 32U};
}

RemapReport remap_report(const RemapOptions& o, const ReportProgress& done) {
  RemapReport r;
  r.full = o.full;
  r.mu = parts(10);
  r.cosines = parts(20);
  add_forms(r, o, part_of(done, "every masking form", 0, 0.95));
  add_claims(r, o);
  add_findings(r);
  return r;
}

}  // namespace gonio
