#pragma once
/// \file
/// Scenes of one sphere, made in memory, and their plans.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/model/model.h"
#include "scene/description/scene.h"
#include "scene/plan/plan.h"

namespace gonio::scene::test {

/// Material of a spec whose last lobe may be a coat.
inline Material material(const std::string& spec,
                         const std::vector<std::string>& settings,
                         bool coated = false) {
  const auto given = parse_settings(settings);
  FromSpec from{spec, {}};
  for (const auto& s : given)
    from.parameters.emplace_back(s.name, GivenParameter{s.values, s.text});
  return {"it", std::move(from), bind_model(spec, given, 3), coated};
}

inline DirectionalLight light(const Vector& towards, double irradiance = 1.9) {
  return {DirectionalLight::Fixed{direction(towards)}, {irradiance, irradiance, irradiance}};
}
/// Three lights from the viewer's side.
inline std::vector<Light> front() {
  return {light({.5, .6, .62}), light({-.7, .2, .69}), light({.1, -.5, .86})};
}
/// One of them, and two from behind.
inline std::vector<Light> rim() {
  return {light({.9, .3, -.3}), light({-.95, .1, -.2}), light({.5, .6, .62})};
}
/// Radiance 1 from everywhere.
inline std::vector<Light> furnace_light() {
  return {EnvironmentLight{"", 1, {2, 1, {{1, 1, 1}, {1, 1, 1}}, 0}}};
}

inline Scene sphere(Material m, std::vector<Light> lights) {
  Scene s;
  s.path = "scene.json";
  s.sha256 = "of the scene";
  s.materials = {std::move(m)};
  s.objects = {{Sphere{}, 0}};
  s.lights = std::move(lights);
  s.view = Camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 14};
  return s;
}

inline Material satin_gold() {
  return material("ggx/smith_ggx.correlated/conductor", {"roughness=0.45", "metal=Au"});
}
inline Material chalk() {
  return material("disney.coupled+ggx/smith_ggx.correlated/dielectric",
                  {"kd=0.8,0.8,0.78", "roughness=0.9", "eta=1.5"});
}
inline Material red_plastic() {
  return material("disney.coupled+ggx/smith_ggx.correlated/dielectric",
                  {"kd=0.5,0.03,0.02", "roughness=0.25", "eta=1.49"});
}
inline Material car_paint() {
  return material(
      "disney.coupled+ggx/smith_ggx.correlated/dielectric+"
      "ggx/smith_ggx.correlated/schlick.weighted",
      {"kd=0.02,0.05,0.25", "roughness=0.5", "eta=1.5", "roughness_2=0.08", "f0_2=0.04",
       "weight_2=1"},
      true);
}
inline Material brushed_aluminium() {
  return material("ggx_aniso/smith_ggx_aniso.correlated/conductor",
                  {"alpha_x=0.26", "alpha_y=0.06", "metal=Al"});
}
inline Material everything() {
  return material(
      "disney.coupled+ggx_aniso/smith_ggx_aniso.correlated/conductor+"
      "ggx/smith_ggx.correlated/schlick.weighted",
      {"kd=0.25,0.15,0.1", "alpha_x=0.6", "alpha_y=0.2", "eta=1.7,1.9,2.2", "k=1.5,1.2,1",
       "roughness_2=0.15", "f0_2=0.04", "weight_2=0.7"},
      true);
}
inline std::vector<Material> six() {
  return {satin_gold(), chalk(), red_plastic(), car_paint(), brushed_aluminium(), everything()};
}

/// Fewer points than by default: what these tests ask is not close.
inline PlanOptions quick() {
  return {.samples = 2048, .fresh = 16'384, .directions = 16, .cost = Cost::operations};
}

inline MaterialPlan planned(const Material& m, std::vector<Light> lights, Tolerance t = {}) {
  Scene s = sphere(m, std::move(lights));
  s.tolerance = t;
  return plan_scene(s, quick()).materials.at(0);
}
inline std::vector<std::string> kept(const MaterialPlan& p) {
  std::vector<std::string> names;
  for (const auto& e : p.effects)
    if (e.keep) names.emplace_back(name_of(e.effect));
  return names;
}
inline bool keeps(const MaterialPlan& p, std::string_view effect) {
  const auto names = kept(p);
  return std::ranges::find(names, effect) != names.end();
}
/// Two lights on the viewer's side.
inline std::vector<Light> two_lights() {
  return {light({0.5, 0.6, 0.62}, 2), light({-0.7, 0.2, 0.69}, 2)};
}

}  // namespace gonio::scene::test
