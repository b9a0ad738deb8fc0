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
ReportFiles files(Report<Rows> report, const ReportOptions& o) {
  Facts known;
  if constexpr (requires { facts(report.rows); }) known = facts(report.rows);
  std::string json = to_json(report);
  auto page = report_page(report);
  page.all_files = o.all_files, page.quick = o.quick;
  std::set<std::string> linked;
  std::string html = page::page_html(page, report.pictures, &linked);
  const auto& shown = report.pictures;
  if (!shown.figures.empty()) linked.insert(shown.figures[0].id);  // which the index links to
  if (o.all_files) {
    for (const auto& f : shown.figures) linked.insert(f.id);
    for (const auto& m : shown.maps) linked.insert(m.id);
  }
  return {std::move(json),
          std::move(html),
          rows_csv(report),
          std::move(report.findings),
          std::move(report.pictures),
          std::move(known),
          std::move(linked)};
}

/// Of a report that is told nothing but how fine it is.
template <auto options, auto report>
ReportFiles made(const ReportOptions& o, const ReportProgress& done) {
  return files(report(options(o.full), done), o);
}
// A first look: what a report has most of is thinned, and every kind of row stays.
void look_first(EnergyOptions& o) {
  const auto thin = [](std::vector<double>& list) {
    std::vector<double> some;
    for (std::size_t k = list.size() % 4; k < list.size(); k += 4) some.push_back(list[k]);
    if (some.back() < list.back()) some.push_back(list.back());
    list = some;
  };
  thin(o.roughness), thin(o.mu);
  o.samples = 4096, o.views = 4, o.lit_points = 64;
}
void look_first(CostOptions& o) {
  o.processes = 1, o.timing = {1, 5e-5, true};
}
void look_first(CrossFitOptions& o) {
  o.roughness = {0.1, 0.3, 0.5, 0.8}, o.ior = {1.5}, o.metals = {"Au"}, o.gamma = {1.5};
  o.bins = 14, o.walks = 64, o.published = false;
}
void look_first(ScenesOptions& o) {
  o.materials.resize(std::min<std::size_t>(o.materials.size(), 2));
  o.plan.samples = 512, o.plan.fresh = 8192, o.plan.directions = 16, o.verified = 4096;
  o.pixels = 48, o.picture_samples = 16, o.map_samples = 64;
}

ReportFiles energy_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = energy_options(o.full);
  options.environments = o.environments;
  if (o.quick) look_first(options);
  return files(energy_report(options, done), o);
}
ReportFiles cost_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = cost_options(o.full);
  options.program = o.program;
  if (o.quick) look_first(options);
  return files(cost_report(options, done), o);
}
ReportFiles cross_fit_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = cross_fit_options(o.full);
  if (o.quick) look_first(options);
  return files(cross_fit_report(options, done), o);
}

ReportFiles stability_files(const ReportOptions& o, const ReportProgress& done) {
  using Setting = StabilityOptions::Setting;
  const auto setting = o.full                    ? Setting::full
                       : o.one_of_all || o.quick ? Setting::brief
                                                 : Setting::quick;
  StabilityOptions options{setting};
  if (o.quick) options.ids = {"ndf.ggx", "masking.smith_ggx.correlated", "fresnel.schlick"};
  return files(stability_report(options, done), o);
}

ReportFiles scenes_files(const ReportOptions& o, const ReportProgress& done) {
  auto options = scenes_options(o.full);
  options.asset = o.asset;
  if (o.quick) look_first(options);
  return files(scenes_report(options, done), o);
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
    ReportKind{"cross_fit",
               "how wrong roughness, F0 and gamma become when fitted with shipped approximations",
               cross_fit_files, cross_fit_schema, 90},
    ReportKind{"cost", "what accuracy costs in time: every form and whole models", cost_files,
               cost_schema, 160},
    ReportKind{"stability", "which formulas stay stable in few bits, and for which inputs",
               stability_files, stability_schema, 50},
    ReportKind{"scenes",
               "which effects a material needs in a scene, and what leaving out the others saves",
               scenes_files, scenes_schema, 40}};

}  // namespace

std::span<const ReportKind> report_kinds() {
  return kinds;
}

}  // namespace gonio
