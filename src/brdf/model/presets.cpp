#include "brdf/model/presets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/maps.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/widths.h"
#include "brdf/model/roughness.h"
#include "brdf/term/term.h"

#include <fmt/format.h>

namespace gonio {
namespace {

// ---- What several of them take ------------------------------------------------------------------

constexpr Parameter base_color = F0Metallic<double>::parameters[0];
constexpr Parameter metallic = F0Metallic<double>::parameters[1];
constexpr Parameter roughness = roughness_parameter;
constexpr Parameter specular_color{
    "specular_color", {0, 1}, {0, 1}, 0.04, true, "reflectance at normal incidence"};

/// Width of a roughness; none is 0 (every distribution divides by it).
double width_of(double r) {
  return std::max(alpha_of(r), alpha_parameter.legal.low);
}

std::vector<Setting> metallic_workflow(const PresetValues& v, double dielectric) {
  std::vector<Setting> s{{"kd", {}}, {"f0", {}}};
  for (const double color : v.colour("base_color")) {
    const auto [f0, kd] = F0Metallic<double>::of(dielectric, color, v.number("metallic"));
    s[0].values.push_back(kd);
    s[1].values.push_back(f0);
  }
  return s;
}

void add(std::vector<Setting>& settings, const char* name, double value) {
  settings.push_back({name, {value}});
}

// ---- The models ---------------------------------------------------------------------------------

constexpr std::array metallic_roughness{base_color, metallic, roughness};

std::vector<Setting> cook_torrance(const PresetValues& v) {
  auto s = metallic_workflow(v, 0.04);
  add(s, "alpha", width_of(v.number("roughness")));
  return s;
}

constexpr std::array filament_parameters{
    base_color, metallic, roughness,
    Parameter{
        "reflectance", {0, 1}, {0, 1}, 0.5, false, "of a dielectric: F0 = 0.16 reflectance²"}};

/// f90 = saturate(50 · 0.33 Σ f0): below 2 % no real dielectric reflects.
std::vector<Setting> filament(const PresetValues& v) {
  const double reflectance = v.number("reflectance");
  auto s = metallic_workflow(v, 0.16 * reflectance * reflectance);
  const auto& f0 = s[1].values;
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += f0[f0.size() == 1 ? 0 : c];
  add(s, "f90", std::clamp(50 * 0.33 * sum, 0.0, 1.0));
  add(s, "alpha", width_of(std::max(v.number("roughness"), 0.045)));
  return s;
}

constexpr std::array<std::string_view, 2> disney_held{"f0_2", "alpha_2"};
constexpr std::array<std::string_view, 1> ue_mobile_held{"f0_green"};
constexpr std::array disney_parameters{
    base_color,
    metallic,
    roughness,
    Parameter{"anisotropy", {0, 1}, {0, 1}, 0, false, "0 isotropic, 1 most anisotropic"},
    Parameter{"specular", {0, 1}, {0, 1}, 0.5, false, "of a dielectric: F0 = 0.08 specular"},
    Parameter{"clearcoat", {0, 1}, {0, 1}, 0, false, "the coat's strength"},
    Parameter{"clearcoat_gloss", {0, 1}, {0, 1}, 1, false, "0 satin, 1 gloss"}};

std::vector<Setting> disney(const PresetValues& v) {
  const double r = v.number("roughness"), gloss = v.number("clearcoat_gloss");
  auto s = metallic_workflow(v, 0.08 * v.number("specular"));
  const auto [x, y] = mapped<AnisoDisney, double>(r, v.number("anisotropy"));
  add(s, "alpha_x", std::max(x, 0.001));
  add(s, "alpha_y", std::max(y, 0.001));
  add(s, "alpha", std::max(alpha_of(r), any_alpha_parameter.legal.low));
  add(s, "alpha_2", 0.1 + (0.001 - 0.1) * gloss);
  add(s, "f0_2", 0.04);
  add(s, "weight_2", 0.25 * v.number("clearcoat"));
  return s;
}

constexpr std::array specular_roughness{specular_color, roughness};

std::vector<Setting> specular_alone(const PresetValues& v) {
  std::vector<Setting> s{{"f0", v.colour("specular_color")}};
  add(s, "alpha", width_of(v.number("roughness")));
  return s;
}
std::vector<Setting> ue_mobile(const PresetValues& v) {
  auto s = specular_alone(v);
  const auto& f0 = s[0].values;
  add(s, "f0_green", f0[f0.size() == 3 ? 1 : 0]);
  return s;
}

constexpr std::array all{
    Preset{
        {"model.cook_torrance", "Cook–Torrance with a metallic workflow",
         "f = (1 − F) kd/π + D F G/(4 NoL NoV), kd = base_color (1 − metallic), "
         "F0 = lerp(0.04, base_color, metallic)",
         "Cook, Torrance 1982, Eq. 3; Walter et al. 2007, Eq. 20",
         "most renderers, with their own D, F and G: compose those as DIFFUSE+NDF/MASKING/FRESNEL"},
        "lambert.coupled+ggx/smith_ggx.correlated/schlick",
        metallic_roughness,
        cook_torrance,
        {},
        "lambert.metallic.coupled+ggx/smith_ggx.correlated/schlick.metallic"},
    Preset{{"model.disney", "Disney's principled BRDF: base, coat and diffuse",
            "f = f_disney + GTR2aniso F G((0.5 + r/2)²) + 0.25 clearcoat GTR1 F G(0.25)",
            "Burley 2012, Appendix B; disney.brdf of 2012 to 2016",
            "Disney's Hyperion, as published in 2012 without sheen, tint and subsurface"},
           "disney+ggx_aniso/disney_remap/schlick+gtr1/disney_coat/schlick.weighted",
           disney_parameters,
           disney,
           disney_held},
    Preset{{"model.disney2017", "Disney's principled BRDF, masked by its own widths",
            "f = f_disney + GTR2aniso F G(alpha_x, alpha_y) + 0.25 clearcoat GTR1 F G(0.25)",
            "disney.brdf since February 2017 (wdas/brdf); Heitz 2014, section 5.4",
            "Disney's BRDF Explorer, without sheen, tint and subsurface"},
           "disney+ggx_aniso/smith_ggx_aniso.separable/schlick+gtr1/disney_coat/schlick.weighted",
           disney_parameters,
           disney,
           disney_held},
    Preset{{"model.ue_mobile", "Unreal Engine's mobile specular, as shipped",
            "f = min(α²/d², 2048) · 0.5/max(…, 0.001) · F_Schlick; π times a BRDF, without 1/π",
            "SpecularGGX, as shipped", "a mobile variant of Unreal Engine 4", "",
            "model.cook_torrance"},
           "ggx.ue_mobile/ue_joint.clamped/schlick.ue",
           specular_roughness,
           ue_mobile,
           ue_mobile_held},
    Preset{{"model.ue_mobile_simple", "Unreal Engine's cheapest mobile specular, as shipped",
            "f = (0.25 r + 0.25) · GGX_Mobile · specular_color; π times a BRDF, without 1/π",
            "SpecularGGXSimple, as shipped", "Unreal Engine 4's mobile renderer", "",
            "model.cook_torrance"},
           "ggx.mobile/ue_mobile_simple/constant",
           specular_roughness,
           specular_alone},
    Preset{{"model.unity_mobile", "Unity's mobile specular",
            "f = D / (LoH² (r + 0.5)) / 4 · specular_color",
            "Optimizing PBR for Mobile, SIGGRAPH 2015 course", "", "model.cook_torrance"},
           "ggx/unity_mobile/constant",
           specular_roughness,
           specular_alone},
    Preset{{"model.gltf", "glTF 2.0's metallic-roughness material",
            "f = (1 − F) kd/π + D F V, F0 = lerp(0.04, base_color, metallic)",
            "glTF 2.0 specification, Appendix B", "glTF 2.0"},
           "lambert.coupled+ggx/smith_ggx.separable/schlick",
           metallic_roughness,
           cook_torrance,
           {},
           "lambert.metallic.coupled+ggx/smith_ggx.separable/schlick.metallic"},
    Preset{{"model.filament", "Filament's standard model, without its energy compensation",
            "f = kd/π + D V F, F0 = lerp(0.16 reflectance², base_color, metallic), "
            "F90 = saturate(16.5 Σ F0)",
            "Guy, Agopian, Physically Based Rendering in Filament, section 4", "Filament"},
           "lambert+ggx/smith_ggx.correlated/schlick.f90",
           filament_parameters,
           filament,
           {},
           "lambert.metallic+ggx/smith_ggx.correlated/schlick.reflectance"}};

}  // namespace

PresetValues::PresetValues(std::span<const Parameter> parameters, std::span<const Setting> given)
    : parameters_(parameters) {
  for (const auto& p : parameters) {
    const auto it = std::ranges::find(given, p.name, &Setting::name);
    const auto values = it == given.end() ? std::vector<double>{p.start} : it->values;
    if (values.size() != 1) {
      if (!p.per_channel) throw wrong_usage(fmt::format("{} is one number", p.name));
      if (values.size() != 3)
        throw wrong_usage(
            fmt::format("{}: {} values where one or r,g,b fit", p.name, values.size()));
      channels_ = values.size();
    }
    for (const double v : values) check_range(p, p.name, v);
    values_.push_back(values);
  }
}

std::vector<double> PresetValues::colour(std::string_view name) const {
  const auto i = std::ranges::find(parameters_, name, &Parameter::name) - parameters_.begin();
  auto v = values_.at(static_cast<std::size_t>(i));
  if (v.size() == 1) v.resize(channels_, v[0]);
  return v;
}
double PresetValues::number(std::string_view name) const {
  return colour(name)[0];
}

std::span<const Preset> presets() {
  return all;
}

const Preset* find_preset(std::string_view name) {
  const auto it = std::ranges::find_if(
      all, [&](const Preset& p) { return p.about.id == name || short_id(p.about.id) == name; });
  return it == all.end() ? nullptr : &*it;
}

ModelSpec resolve_preset(const ModelSpec& spec, std::vector<Setting>& settings) {
  const Preset* preset = find_preset(to_text(spec));
  if (!preset) return spec;
  const auto own = [&](const Setting& s) {
    return std::ranges::find(preset->parameters, s.name, &Parameter::name) !=
           preset->parameters.end();
  };
  auto resolved = preset->resolve(PresetValues(preset->parameters, settings));
  const auto set = std::ranges::find_if(settings, own);
  const bool any = set != settings.end();
  const std::string name = any ? set->name : "";
  std::erase_if(settings, own);
  for (auto& s : resolved) {
    const bool again = std::ranges::find(settings, s.name, &Setting::name) != settings.end();
    if (again && any)
      throw wrong_usage(fmt::format("{}: '{}' sets {} itself", preset->about.id, name, s.name));
    s.implied = !any && std::ranges::find(preset->held, s.name) == preset->held.end();
    if (!again) settings.push_back(s);
  }
  return parse_model(preset->spec);
}

}  // namespace gonio
