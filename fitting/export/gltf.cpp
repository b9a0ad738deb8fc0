// glTF 2.0's metallic-roughness material, Appendix B of its specification, and the extensions that
// say more: KHR_materials_ior, _specular, _anisotropy and _clearcoat.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/base64.h"
#include "base/json/reader.h"
#include "brdf/formula/coat.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/model/evaluate.h"
#include "brdf/term/map.h"
#include "brdf/term/product.h"
#include "fitting/export/placement.h"
#include "fitting/export/target.h"
#include "geometry/direction.h"
#include "optics/f0.h"
#include "optics/fresnel_approximate.h"

#include <nlohmann/json.hpp>

namespace gonio {
namespace {

// ---- Core ---------------------------------------------------------------------------------------

std::vector<std::vector<double>> core_values(const TargetParameters& p,
                                             std::span<const FrameAngles<double>> angles) {
  std::vector<Setting> settings;
  for (const auto& x : p) settings.push_back({x.name, x.values});
  return evaluate(bind_model("gltf", settings, p.front().values.size()), angles);
}

TargetForm core_form(const Surface& s) {
  std::vector<double> reflected(s.channels, 0.0);
  double roughness = 1;
  if (!s.lobes.empty()) {
    const auto& l = s.lobes.front();
    for (std::size_t c = 0; c < s.channels; ++c) reflected[c] = l.weight * l.f0[c];
    roughness = one_roughness(l);
  }
  double diffuse = 0, specular = 0;
  for (std::size_t c = 0; c < s.channels; ++c) diffuse += s.kd[c], specular += reflected[c];
  const bool metal = !s.lobes.empty() && s.lobes.front().is_metal() && specular > diffuse;
  return {{{"base_color", metal ? reflected : s.kd},
           {"metallic", {metal ? 1.0 : 0.0}},
           {"roughness", {roughness}}},
          core_values};
}

// ---- With extensions ----------------------------------------------------------------------------

/// D V of widths that KHR_materials_anisotropy makes of a roughness r and a strength s:  α_x = lerp(r², 1, s²),  α_y = r²;
/// its V is Smith's, correlated, that of the core separable.
class Highlight {
 public:
  Highlight(double roughness, double strength, double rotation)
      : stretched_(strength > 0),
        cos_(std::cos(rotation)),
        sin_(std::sin(rotation)),
        alpha_(std::max(roughness * roughness, 1e-4)),
        wide_(alpha_ + (1 - alpha_) * strength * strength),
        d_(std::array{wide_, alpha_}),
        correlated_(std::array{wide_, alpha_}),
        separable_(std::array{alpha_}) {}

  double operator()(const FrameAngles<double>& at) const {
    const auto a = turned(at, cos_, sin_);
    return as_value<double>(stretched_ ? d_(a) * correlated_(a) : d_(a) * separable_(a));
  }

 private:
  bool stretched_;
  double cos_, sin_, alpha_, wide_;
  GgxAniso<double> d_;
  SmithGgxAnisoCorrelated<double> correlated_;
  SmithGgxSeparable<double> separable_;
};

/// f = (1 − w F_c(NoV)) base + w F_c(NoV) D V of the coat, F_c Schlick's of F0 = 0.04; base is that of a metal,
/// F(base_color) D V, or of a dielectric,
///
///   (1 − s max F) base_color/π + s F D V,   F0 = min(((n − 1)/(n + 1))² specular_color, 1)
std::vector<std::vector<double>> gltf_values(const TargetParameters& p,
                                             std::span<const FrameAngles<double>> angles) {
  const std::size_t n = p.front().values.size();  // base_color
  const bool metal = parameter_in(p, "metallic") > 0;
  const double strength = parameter_in(p, "specular");
  const Highlight highlight(parameter_in(p, "roughness"), parameter_in(p, "anisotropy"),
                            parameter_in(p, "anisotropy_rotation"));
  const double weight = parameter_in(p, "clearcoat"), r = parameter_in(p, "clearcoat_roughness");
  const Highlight coat(r, 0, 0);
  const auto color = per_channel(p, "base_color", n);
  auto f0 = color;
  if (!metal)
    for (std::size_t c = 0; c < n; ++c)
      f0[c] = std::min(mapped<F0FromIor, double>(parameter_in(p, "ior"), 1.0)[0] *
                           parameter_in(p, "specular_color", c),
                       1.0);
  const double most = *std::ranges::max_element(f0);
  std::vector<std::vector<double>> f(n, std::vector<double>(angles.size()));
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto& a = angles[i];
    const double rest = schlick_weight(a.voh), dv = highlight(a);
    const double taken = weight * schlick<double>(0.04, schlick_weight(a.nov));
    const double on_top = weight > 0 ? taken * coat(a) : 0;
    const double below = 1 - strength * schlick<double>(most, rest);
    for (std::size_t c = 0; c < n; ++c) {
      const double reflected = schlick<double>(f0[c], rest) * dv;
      const double base =
          metal ? reflected : below * color[c] / std::numbers::pi + strength * reflected;
      f[c][i] = left_by_view(taken) * base + on_top;
    }
  }
  return f;
}

std::vector<TargetForm> gltf_forms(const Surface& s) {
  std::vector<TargetForm> all{core_form(s)};
  for (const auto& [base, coat, metal] : placements(s)) {
    if (!base) continue;
    auto f0 = base->f0;
    for (double& x : f0) x *= base->weight;
    TargetParameters p{{"base_color", metal ? f0 : s.kd},
                       {"metallic", {metal ? 1.0 : 0.0}, {0, 1}, false}};
    const auto [wide, narrow, tangent] = stretch_of(*base, s.tangent_deg);
    p.push_back({"roughness", {std::sqrt(narrow)}, roughness_range});
    if (!metal) {
      const auto like = grey_dielectric(*base);
      p.push_back({"ior", {like.eta}, index_range});
      p.push_back({"specular", {base->weight}});
      p.push_back({"specular_color", like.tint, {0, 1}, !like.is_grey()});
    }
    if (wide != narrow && narrow < 1) {
      p.push_back({"anisotropy", {std::sqrt((wide - narrow) / (1 - narrow))}});
      p.push_back({"anisotropy_rotation",
                   {half_turn_of(tangent) * degree},
                   {-std::numbers::pi, std::numbers::pi}});
    }
    if (coat) {
      // Its index is fixed: what reflects more or less at normal incidence is more or less of it.
      p.push_back({"clearcoat", {coat->weight * coat->largest_f0() / 0.04}});
      p.push_back({"clearcoat_roughness", {one_roughness(*coat)}, roughness_range});
    }
    all.push_back({std::move(p), gltf_values});
  }
  return all;
}

std::vector<std::string> gltf_lost(const BoundModel& fit,
                                   const Surface& s,
                                   const TargetParameters& p) {
  const auto has = [&](std::string_view name) {
    return std::ranges::find(p, name, &TargetParameter::name) != p.end();
  };
  auto all = lost_by_all(fit, "glTF's", has("anisotropy") ? "correlated" : "separable");
  const std::size_t lobes = has("clearcoat") ? 2 : 1;
  if (s.lobes.size() > lobes)
    all.emplace_back(lobes == 1 ? "A second lobe: glTF has one, and a coat by an extension."
                                : "A third lobe: glTF has a highlight and a coat.");
  if (has("clearcoat"))
    all.emplace_back("The sum of two lobes: glTF's coat takes light from what is below it.");
  if (keeps_diffuse_whole(fit, s))
    all.emplace_back(
        parameter_in(p, "metallic") < 1
            ? "The plain sum of diffuse light and highlight: glTF multiplies the diffuse by 1 − F."
            : "Diffuse light: a metal of glTF has none.");
  if (s.lobes.empty()) all.emplace_back("A surface without a highlight: glTF reflects 4 %.");
  if (fit.model.anisotropic && !has("anisotropy"))
    all.emplace_back("Anisotropy: glTF's material without extensions has one roughness.");
  if (fit.model.find("eta") || fit.model.find("f82_tint") || fit.model.find("f90"))
    all.emplace_back("The Fresnel curve: glTF has Schlick's, which ends at 1.");
  return all;
}

/// Names in a file for the parameters of an extension.
struct ExtensionKey {
  const char *extension, *key, *parameter;
};
constexpr ExtensionKey extension_keys[] = {
    {"KHR_materials_ior", "ior", "ior"},
    {"KHR_materials_specular", "specularFactor", "specular"},
    {"KHR_materials_specular", "specularColorFactor", "specular_color"},
    {"KHR_materials_anisotropy", "anisotropyStrength", "anisotropy"},
    {"KHR_materials_anisotropy", "anisotropyRotation", "anisotropy_rotation"},
    {"KHR_materials_clearcoat", "clearcoatFactor", "clearcoat"},
    {"KHR_materials_clearcoat", "clearcoatRoughnessFactor", "clearcoat_roughness"}};

/// Whether a parameter of KHR_materials_specular says no more than the extension's absence.
bool is_default(std::string_view parameter, const std::vector<double>& values) {
  return parameter.starts_with("specular") &&
         std::ranges::all_of(values, [](double v) { return v == 1; });
}

/// Adds a sphere of radius 1 with the material: positions, which are its normals, too, tangents along its circles of latitude, and
/// triangles.
void add_sphere(Json& all) {
  constexpr std::uint32_t around = 64, down = 32;
  std::string bytes;
  const auto put = [&](auto x) {
    static_assert(std::endian::native == std::endian::little);  // as glTF has it
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  };
  const auto each_vertex = [&](auto&& at) {
    for (std::uint32_t j = 0; j <= down; ++j)
      for (std::uint32_t i = 0; i <= around; ++i)
        at(std::numbers::pi * j / down, 2 * std::numbers::pi * i / around);
  };
  each_vertex([&](double theta, double phi) {
    put(static_cast<float>(std::sin(theta) * std::sin(phi)));
    put(static_cast<float>(std::cos(theta)));
    put(static_cast<float>(std::sin(theta) * std::cos(phi)));
  });
  const std::size_t tangents = bytes.size();
  each_vertex([&](double, double phi) {
    put(static_cast<float>(std::cos(phi)));
    put(0.0F);
    put(static_cast<float>(-std::sin(phi)));
    put(1.0F);
  });
  const std::size_t triangles = bytes.size();
  for (std::uint32_t j = 0; j < down; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * (around + 1) + i, b = a + around + 1;
      if (j > 0)  // one triangle at each pole
        for (const std::uint32_t k : {a, b, a + 1}) put(k);
      if (j + 1 < down)
        for (const std::uint32_t k : {a + 1, b, b + 1}) put(k);
    }
  constexpr int float32 = 5126, uint32 = 5125, vertex_data = 34962, index_data = 34963;
  const std::size_t vertices = (around + 1) * (down + 1);
  const auto view = [](std::size_t from, std::size_t to, int target) {
    return Json{{"buffer", 0}, {"byteOffset", from}, {"byteLength", to - from}, {"target", target}};
  };
  all["scene"] = 0;
  all["scenes"] = Json::array({{{"nodes", {0}}}});
  all["nodes"] = Json::array({{{"name", "preview"}, {"mesh", 0}}});
  all["meshes"] =
      Json::array({{{"primitives",
                     Json::array({{{"attributes", {{"POSITION", 0}, {"NORMAL", 0}, {"TANGENT", 1}}},
                                   {"indices", 2},
                                   {"material", 0}}})}}});
  all["accessors"] = Json::array(
      {{{"bufferView", 0},
        {"componentType", float32},
        {"count", vertices},
        {"type", "VEC3"},
        {"min", {-1, -1, -1}},
        {"max", {1, 1, 1}}},
       {{"bufferView", 1}, {"componentType", float32}, {"count", vertices}, {"type", "VEC4"}},
       {{"bufferView", 2},
        {"componentType", uint32},
        {"count", (bytes.size() - triangles) / sizeof(std::uint32_t)},
        {"type", "SCALAR"}}});
  all["bufferViews"] =
      Json::array({view(0, tangents, vertex_data), view(tangents, triangles, vertex_data),
                   view(triangles, bytes.size(), index_data)});
  all["buffers"] =
      Json::array({{{"byteLength", bytes.size()},
                    {"uri", "data:application/octet-stream;base64," + base64(bytes)}}});
}

std::string gltf_file(const Export& e, const std::string& fit) {
  const auto find = [&](std::string_view name) -> const std::vector<double>* {
    const auto at = std::ranges::find(e.parameters, name, [](const auto& p) { return p.first; });
    return at == e.parameters.end() ? nullptr : &at->second;
  };
  const auto color = [](const std::vector<double>& v) {
    Json rgb = Json::array();
    for (std::size_t c = 0; c < 3; ++c) rgb.push_back(v[v.size() == 3 ? c : 0]);
    return rgb;
  };
  Json factor = color(*find("base_color")), extensions = Json::object(), used = Json::array();
  factor.push_back(1.0);
  for (const auto& [extension, key, parameter] : extension_keys)
    if (const auto* v = find(parameter); v && !is_default(parameter, *v)) {
      if (!extensions.contains(extension)) used.push_back(extension);
      const bool is_color = std::string_view(key).ends_with("ColorFactor");
      extensions[extension][key] = is_color ? color(*v) : Json((*v)[0]);
    }
  Json material{{"name", "fit"},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", factor},
                  {"metallicFactor", (*find("metallic"))[0]},
                  {"roughnessFactor", (*find("roughness"))[0]}}}};
  Json all{{"asset", {{"version", "2.0"}, {"generator", "gonio"}}}};
  if (!used.empty()) all["extensionsUsed"] = used, material["extensions"] = extensions;
  material["extras"] = {{"gonio", parse_json(e.fit, fit)}};
  all["materials"] = Json::array({material});
  if (e.preview) add_sphere(all);
  return text_of(all);
}

}  // namespace

const Target gltf_target{"glTF", gltf_forms, gltf_lost, gltf_file};

}  // namespace gonio
