#include "reports/report.h"

#include <array>

#include "reports/energy.h"

namespace gonio {
namespace {

ReportFiles energy(const ReportOptions& o, const ReportProgress& done) {
  auto options = energy_options(o.full);
  options.environments = o.environments;
  const auto report = energy_report(options, done);
  std::string json = to_json(report);
  std::string html = energy_page_html(json);
  return {std::move(json), std::move(html), report.findings};
}

constexpr std::array kinds{
    ReportKind{"energy", "what single scattering loses, and what gives it back", energy}};

}  // namespace

std::span<const ReportKind> report_kinds() {
  return kinds;
}

}  // namespace gonio
