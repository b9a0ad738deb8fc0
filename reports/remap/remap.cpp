#include "reports/remap/remap.h"

#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "reports/remap/pairs.h"

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

std::array<std::string, 2> references_of(std::string_view ndf) {
  const std::string smith = "masking.smith_" + std::string(short_id(ndf));
  return {smith + ".separable", smith + ".correlated"};
}

const RemapForm* find_form(const std::vector<RemapForm>& forms, std::string_view id) {
  const auto it = std::ranges::find(forms, id, &RemapForm::form);
  return it == forms.end() ? nullptr : &*it;
}

std::optional<double> overall_rms(const RemapRows& r,
                                  std::string_view form,
                                  std::string_view reference) {
  double squares = 0;
  std::size_t n = 0;
  for (const auto& row : r.rows)
    if (row.form == form && row.reference == reference) squares += row.rms * row.rms, ++n;
  if (n == 0) return {};
  return std::sqrt(squares / static_cast<double>(n));
}

RemapRows remap_rows(const RemapOptions& o, const ReportProgress& done) {
  using namespace remapping;
  RemapRows r{parts(10), parts(20), {}, {}, {}, {}, {}};
  auto measured = measured_forms(o, r.mu, r.cosines, part_of(done, "every masking form", 0, 0.95));
  r.forms = std::move(measured.forms);
  r.rows = std::move(measured.rows);
  r.uses = uses_of_k(r.forms, r.mu);
  r.g1 = claimed_g1();
  r.vf = in_place_of_vf(r.forms, o, r.cosines);
  return r;
}
RemapReport remap_report(const RemapOptions& o, const ReportProgress& done) {
  return report_of(o.full, remap_rows(o, done));
}

}  // namespace gonio
