#include "reports/scenes/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

#include "reports/scenes/asset.h"
#include "reports/scenes/cases.h"
#include "reports/scenes/measure.h"
#include "scene/plan/cost.h"
#include "scene/plan/effect_map.h"
#include "scene/plan/verify.h"

#include <fmt/format.h>

namespace gonio {

ScenesOptions scenes_options(bool full) {
  ScenesOptions o;
  o.full = full;
  o.materials = scenes::material_names();
  o.lights = scenes::light_names();
  if (!full) o.plan.directions = 32;
  for (int deg = 0; deg <= 150; deg += full ? 5 : 15) o.map_angle_deg.push_back(deg);
  if (full)
    for (int r = 1; r <= 20; ++r) o.map_roughness.push_back(0.05 * r);
  else  // those of the materials among them
    o.map_roughness = {0.05, 0.15, 0.25, 0.35, 0.45, 0.6, 0.75, 0.9, 1};
  if (!full) o.map_samples = 512;
  return o;
}

namespace {

using namespace scene;

std::string joined(const std::string& list, std::string_view next) {
  return fmt::format("{}{}{}", list, list.empty() ? "" : ", ", next);
}

/// Names of the forms that are kept.
std::string kept(const Forms& forms) {
  std::string list;
  for (std::size_t e = 0; e < effect_count; ++e) {
    const auto effect = static_cast<Effect>(e);
    if (forms.keeps(effect)) list = joined(list, scenes::name_of_form(forms[effect]));
  }
  return list;
}

/// Times of a direction of light: medians over several rounds.  Surfaces that come to the same have the same time.
template <std::size_t N>
std::array<double, N> median_times(const std::array<Surface, N>& surfaces,
                                   const LitPoints& points) {
  constexpr int rounds = 5;
  const auto same = [](const Surface& a, const Surface& b) {
    return a.spec() == b.spec() && a.parameters() == b.parameters() &&
           a.multiple.form == b.multiple.form && a.spectrum.has_value() == b.spectrum.has_value() &&
           a.single == b.single;
  };
  std::array<std::vector<double>, N> all;
  for (int round = 0; round < rounds; ++round) {
    const auto times = times_of(surfaces, points);
    for (std::size_t i = 0; i < N; ++i) {
      const auto first =
          std::ranges::find_if(surfaces, [&](const Surface& s) { return same(s, surfaces[i]); });
      all[i].push_back(times[static_cast<std::size_t>(first - surfaces.begin())].ns);
    }
  }
  std::array<double, N> ns;
  std::ranges::transform(all, ns.begin(), [](const auto& list) { return spread_of(list).ns; });
  return ns;
}

class SceneMeasurement {
 public:
  SceneMeasurement(ScenesRows& to,
                   const ScenesOptions& o,
                   const Material& material,
                   std::string light)
      : to_(to),
        options_(o),
        material_(material.name),
        light_(std::move(light)),
        scene_(scenes::scene_of(material, light_)),
        lit_(scene_),
        look_(lit_.looks[0]),
        plan_(plan_scene(scene_, o.plan).materials.at(0)) {}

  void add() {
    add_row();
    add_effects();
    add_front();
    auto picture =
        scenes::picture_of(lit_, {&plan_.forms, 1}, options_.pixels, options_.picture_samples);
    picture.material = material_;
    picture.light = light_;
    to_.pictures.push_back(std::move(picture));
  }

 private:
  Surface single(const Forms& forms) const {
    Surface s = look_.surface(forms);
    s.single = true;
    return s;
  }
  void add_row() {
    constexpr std::uint64_t timing = 2'001;  // a stream of its own
    SceneRow r;
    r.material = material_;
    r.light = light_;
    for (const auto& e : plan_.effects) {
      const auto exact = scenes::name_of_form(look_.offer(e.effect).forms.back());
      if (e.keep)
        r.kept = joined(r.kept, scenes::name_of_form(plan_.forms[e.effect]));
      else if (e.why == Why::structural)
        r.absent = joined(r.absent, scenes::name_of_effect(e.effect));
      else
        r.dropped = joined(r.dropped, exact);
    }
    r.spec = plan_.spec;
    // Shaders ship a compensation, not the reference's table.
    const Forms everything = look_.everything();
    const std::array surfaces{look_.surface(plan_.forms), look_.surface(everything),
                              single(everything), single(look_.shipped()), single(plan_.forms)};
    const auto times = median_times(
        surfaces, lit_.drawer(0, options_.plan.directions).draw(timing, 0, options_.plan.samples));
    r.ns = times[0];
    r.ns_exact = times[1];
    r.ns_exact_float = times[2];
    r.ns_present_float = times[3];
    r.ns_float = times[4];
    r.speedup = r.ns_exact / r.ns;
    r.speedup_float = r.ns_present_float / r.ns_float;
    r.needs_table = plan_.needs_table();
    r.ops_saved = plan_.ops_saved;
    r.error_quantile = plan_.checked.quantile;
    r.error_upper = plan_.checked.upper;
    r.worst = plan_.checked.worst;
    r.reference_error = plan_.reference_error;
    PlannedForms planned;
    planned.by_material = {plan_.forms};
    const auto verified = verify(scene_, planned, 1, options_.verified).materials.at(0);
    r.exceeding = verified.found.exceeding;
    r.samples = verified.found.samples;
    r.upper_bound = verified.found.bound;
    r.holds = verified.holds;
    to_.rows.push_back(std::move(r));
  }
  void add_effects() {
    for (const auto& e : plan_.effects) {
      to_.effects.push_back({material_, light_, std::string(name_of(e.effect)), e.form,
                             scenes::name_of_form(look_.offer(e.effect).forms.back()),
                             e.keep ? scenes::name_of_form(plan_.forms[e.effect]) : "", e.keep,
                             std::string(name_of(e.why)), e.reason, e.error_if_dropped, e.ns_saved,
                             e.ops_saved});
    }
  }
  void add_front() {
    for (const auto& c : plan_.front)
      to_.front.push_back({material_, light_, kept(c.forms), c.ns, c.ns_spread, c.ops,
                           c.error.quantile, c.error.upper, c.error.worst, c.forms == plan_.forms});
  }

  ScenesRows& to_;
  const ScenesOptions& options_;
  std::string material_, light_;
  Scene scene_;
  Lit lit_;
  const Look& look_;
  MaterialPlan plan_;
};

}  // namespace

std::vector<SceneMap> scenes::switch_maps(const ScenesOptions& o,
                                          const std::function<void(double)>& done) {
  struct Asked {
    std::string_view material;
    std::array<Effect, 3> effects;
  };
  static constexpr std::array asked{
      Asked{"red plastic", {Effect::fresnel, Effect::masking, Effect::coupling}},
      Asked{"satin gold", {Effect::fresnel, Effect::masking, Effect::compensation}}};
  std::vector<SceneMap> maps;
  for (const auto& a : asked) {
    if (std::ranges::find(o.materials, a.material) == o.materials.end()) continue;
    const Scene s = scene_of(material_of(a.material), light_names()[0]);
    const Look look(s.materials[0]);
    const auto map = effect_map(s, 0, o.map_angle_deg, o.map_roughness, o.map_samples);
    for (const Effect e : a.effects)
      maps.push_back({std::string(a.material), std::string(name_of(e)),
                      name_of_form(look.offer(e).forms.back()), roughness_of(a.material),
                      map.light_deg, map.roughness, map.error[static_cast<std::size_t>(e)]});
    if (done) done(static_cast<double>(&a - asked.data() + 1) / asked.size());
  }
  return maps;
}

ScenesRows scenes_rows(const ScenesOptions& o, const ReportProgress& done) {
  ScenesRows r;
  r.tolerance = Tolerance{};
  std::vector<Material> materials;
  for (const auto& name : o.materials) materials.push_back(scenes::material_of(name));
  if (!o.asset.empty()) {
    auto asset = scenes::asset_materials(o.asset);
    std::ranges::move(asset.materials, std::back_inserter(materials));
    r.left_out = std::move(asset.left_out);
  }
  const double all = static_cast<double>(materials.size() * o.lights.size());
  for (const auto& material : materials)
    for (const auto& light : o.lights) {
      if (done) done("planning", 0.9 * static_cast<double>(r.rows.size()) / all);
      SceneMeasurement(r, o, material, light).add();
    }
  r.maps = scenes::switch_maps(o, part_of(done, "maps", 0.9, 1));
  return r;
}

ScenesReport scenes_report(const ScenesOptions& o, const ReportProgress& done) {
  return report_of(o.full, scenes_rows(o, done));
}

}  // namespace gonio
