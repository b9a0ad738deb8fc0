#include "reports/report.h"

#include <array>

#include "reports/energy.h"
#include "reports/remap.h"
#include "reports/schlick.h"

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

ReportFiles remap(const ReportOptions& o, const ReportProgress& done) {
  const auto report = remap_report(remap_options(o.full), done);
  std::string json = to_json(report);
  std::string html = remap_page_html(json);
  return {std::move(json), std::move(html), report.findings};
}

ReportFiles schlick(const ReportOptions& o, const ReportProgress& done) {
  const auto report = schlick_report(schlick_options(o.full), done);
  std::string json = to_json(report);
  std::string html = schlick_page_html(json);
  return {std::move(json), std::move(html), report.findings};
}

constexpr std::array kinds{
    ReportKind{"energy", "what single scattering loses, and what gives it back", energy},
    ReportKind{"remap", "masking forms against exact Smith, and which roughness each behaves like",
               remap},
    ReportKind{"schlick", "Schlick's approximation and its kin against exact Fresnel", schlick}};

}  // namespace

std::span<const ReportKind> report_kinds() {
  return kinds;
}

}  // namespace gonio
