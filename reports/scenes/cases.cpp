#include "reports/scenes/cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "image/lit_sphere.h"

#include <fmt/format.h>

namespace gonio::scenes {
namespace {

using namespace scene;

struct Case {
  const char *name, *model;
  std::vector<Setting> settings;
};
const std::vector<Case>& cases() {
  static constexpr const char* plastic = "disney.coupled+ggx/smith_ggx.correlated/dielectric";
  static const std::vector<Case> all{
      {"satin gold",
       "ggx/smith_ggx.correlated/conductor",
       {{"roughness", {0.45}}, {"metal", {}, "Au"}}},
      {"chalk", plastic, {{"kd", {0.8, 0.8, 0.78}}, {"roughness", {0.9}}, {"eta", {1.5}}}},
      {"red plastic", plastic, {{"kd", {0.5, 0.03, 0.02}}, {"roughness", {0.25}}, {"eta", {1.49}}}},
      {"car paint",
       "disney.coupled+ggx/smith_ggx.correlated/dielectric"
       "+coat:ggx/smith_ggx.correlated/schlick.weighted",
       {{"kd", {0.02, 0.05, 0.25}},
        {"roughness", {0.5}},
        {"eta", {1.5}},
        {"roughness_2", {0.08}},
        {"f0_2", {0.04}},
        {"weight_2", {1}}}},
      {"brushed aluminium",
       "ggx_aniso/smith_ggx_aniso.correlated/conductor",
       {{"alpha_x", {0.23}}, {"alpha_y", {0.065}}, {"metal", {}, "Al"}}},
      {"everything needed",
       "disney.coupled+ggx_aniso/smith_ggx_aniso.correlated/conductor"
       "+coat:ggx/smith_ggx.correlated/schlick.weighted",
       {{"kd", {0.25, 0.15, 0.1}},
        {"alpha_x", {0.6}},
        {"alpha_y", {0.2}},
        {"eta", {1.7, 1.9, 2.2}},
        {"k", {1.5, 1.2, 1}},
        {"roughness_2", {0.15}},
        {"f0_2", {0.04}},
        {"weight_2", {0.7}}}}};
  return all;
}

Material made(const Case& c) {
  Material m;
  m.name = c.name;
  const auto spec = parse_model(c.model);
  m.coated = spec.coat.has_value();
  FromSpec from{c.model, {}};
  for (const auto& s : c.settings) from.parameters.push_back({s.name, {s.values, s.text}});
  m.is = bind_model(coat_as_lobe(spec), c.settings, 3);
  m.from = std::move(from);
  return m;
}

/// Even sky over an even ground, and a sun in front.
Environment sky_and_sun() {
  constexpr float sky = 0.3F, ground = 0.12F, sun = 150;
  Environment map{128, 64, {}, 0};
  const Direction at = EnvironmentLight::into_map(direction(Vector{0.5, 0.6, 0.62}));
  const auto [si, sj] = map.texel_at(at);
  for (std::size_t j = 0; j < map.height; ++j)
    for (std::size_t i = 0; i < map.width; ++i) {
      const bool is_sun = (i == si || i == si + 1) && (j == sj || j == sj + 1);
      const float l = is_sun ? sun : j < map.height / 2 ? sky : ground;
      map.radiance.push_back({l, l, l});
    }
  return map;
}

std::vector<Light> directional(const SphereLight& light) {
  constexpr double irradiance = 0.6 * std::numbers::pi;
  std::vector<Light> all;
  for (const auto& d : light.towards)
    all.emplace_back(
        DirectionalLight{DirectionalLight::Fixed{d}, {irradiance, irradiance, irradiance}});
  return all;
}

struct NamedLight {
  std::string_view name;
  std::vector<Light> (*make)();
};
const std::array named_lights{
    NamedLight{sphere_lights()[0].name, [] { return directional(sphere_lights()[0]); }},
    NamedLight{sphere_lights()[1].name, [] { return directional(sphere_lights()[1]); }},
    NamedLight{"sky and sun", [] {
                 return std::vector<Light>{EnvironmentLight{"sky and sun", 1, sky_and_sun()}};
               }}};

template <class List>
std::vector<std::string> names_in(const List& list) {
  std::vector<std::string> names;
  for (const auto& entry : list) names.emplace_back(entry.name);
  return names;
}

}  // namespace

std::vector<std::string> material_names() {
  return names_in(cases());
}
std::vector<std::string> light_names() {
  return names_in(named_lights);
}

Material material_of(std::string_view name) {
  return made(*std::ranges::find(cases(), name, &Case::name));
}

Scene scene_of(Material material, std::string_view light) {
  Scene s;
  s.path = s.sha256 = fmt::format("{}, {}", material.name, light);
  s.materials = {std::move(material)};
  s.objects = {{Sphere{}, 0}};
  s.lights = std::ranges::find(named_lights, light, &NamedLight::name)->make();
  s.view = Camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 12};
  return s;
}

double roughness_of(std::string_view material) {
  const auto model = std::get<BoundModel>(material_of(material).is);
  const auto width = [&](const char* name) {
    const auto* p = model.model.find(name);
    return p ? model.values[p->first] : 0;
  };
  const double alpha = width("alpha");
  return std::sqrt(alpha > 0 ? alpha : std::sqrt(width("alpha_x") * width("alpha_y")));
}

}  // namespace gonio::scenes
