#include "reports/index/kinds.h"

#include <array>

#include "reports/cost/cost.h"
#include "reports/cross_fit/cross_fit.h"
#include "reports/diffuse/diffuse.h"
#include "reports/energy/energy.h"
#include "reports/page/render.h"
#include "reports/remap/remap.h"
#include "reports/scenes/scenes.h"
#include "reports/schlick/schlick.h"
#include "reports/stability/stability.h"

namespace gonio {
namespace {

template <class Rows>
ReportFiles files(Report<Rows> report) {
  Facts known;
  if constexpr (requires { facts(report.rows); }) known = facts(report.rows);
  std::string json = to_json(report);
  std::string html = page::page_html(report_page(report), report.pictures);
  return {std::move(json),
          std::move(html),
          rows_csv(report),
          std::move(report.findings),
          std::move(report.pictures),
          std::move(known)};
}

/// Of a report that is told nothing but how fine it is.
template <auto options, auto report>
ReportFiles made(const ReportOptions& o, const ReportProgress& done) {
  return files(report(options(o.full), done));
}
ReportFiles energy_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = energy_options(o.full);
  options.environments = o.environments;
  return files(energy_report(options, done));
}
ReportFiles cost_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = cost_options(o.full);
  options.program = o.program;
  return files(cost_report(options, done));
}

ReportFiles stability_files(const ReportOptions& o, const ReportProgress& done) {
  using Setting = StabilityOptions::Setting;
  const auto setting = o.full ? Setting::full : o.one_of_all ? Setting::brief : Setting::quick;
  return files(stability_report({setting}, done));
}

ReportFiles scenes_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = scenes_options(o.full);
  options.asset = o.asset;
  return files(scenes_report(options, done));
}

constexpr std::array kinds{
    ReportKind{"energy", "what single scattering loses, and what gives it back", energy_files,
               energy_schema, 50},
    ReportKind{"diffuse", "what diffuse forms give back, how they look, and what they cost",
               made<diffuse_options, diffuse_report>, diffuse_schema, 2},
    ReportKind{"remap", "masking forms against exact Smith, and which roughness each behaves like",
               made<remap_options, remap_report>, remap_schema, 2},
    ReportKind{"schlick", "Schlick's approximation and its kin against exact Fresnel",
               made<schlick_options, schlick_report>, schlick_schema, 3},
    ReportKind{"cross_fit", "what fits with shipped approximations make of roughness, F0 and gamma",
               made<cross_fit_options, cross_fit_report>, cross_fit_schema, 90},
    ReportKind{"cost", "what accuracy costs in time: every form and whole models", cost_files,
               cost_schema, 160},
    ReportKind{"stability", "which formulas stay stable in few bits, and from which inputs on",
               stability_files, stability_schema, 50},
    ReportKind{"scenes",
               "which effects a material needs in a scene, and what leaving out the others saves",
               scenes_files, scenes_schema, 40}};

}  // namespace

std::span<const ReportKind> report_kinds() {
  return kinds;
}

}  // namespace gonio
