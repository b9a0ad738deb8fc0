// UsdPreviewSurface in its specular workflow, under the equations of the graph that
// MaterialX 1.39.5 has of it: the specification leaves them to the renderer.
#include <algorithm>
#include <string>

#include "base/json/reader.h"
#include "brdf/term/map.h"
#include "fitting/export/materialx_parts.h"
#include "fitting/export/xml.h"
#include "optics/f0.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::vector<std::vector<double>> usd_values(const TargetParameters& p,
                                            std::span<const FrameAngles<double>> angles) {
  const std::size_t n = p.front().values.size();  // diffuseColor
  MaterialxSurface s;
  const auto schlick_layer = [&](double roughness, double weight, const std::vector<double>& f0) {
    const double alpha = roughness * roughness;
    auto layer = layer_of(alpha, alpha, 0, weight);
    layer.grey_through = true;
    for (const double r : f0) layer.channels.push_back({f82_layer(r, 1), r, 1, 1});
    return layer;
  };
  if (const double w = parameter_in(p, "clearcoat"); w > 0) {
    const double f0 = mapped<F0FromIor, double>(parameter_in(p, "ior"), 1.0)[0];
    s.layers.push_back(
        schlick_layer(parameter_in(p, "clearcoatRoughness"), w, std::vector<double>(n, f0)));
  }
  s.layers.push_back(
      schlick_layer(parameter_in(p, "roughness"), 1, per_channel(p, "specularColor", n)));
  s.kd = per_channel(p, "diffuseColor", n);
  return evaluate(s, angles);
}

std::vector<TargetForm> usd_forms(const Surface& s) {
  std::vector<TargetForm> all;
  const SurfaceLobe* last = nullptr;
  for (const auto& [base, coat, metal] : placements(s)) {
    if (!all.empty() && base == last) continue;  // metal or not is the same here
    last = base;
    auto f0 = base ? base->f0 : std::vector<double>(s.channels, 0.0);
    for (double& r : f0) r *= base ? base->weight : 1;
    TargetParameters p{{"diffuseColor", s.kd},
                       {"specularColor", f0},
                       {"roughness", {base ? one_roughness(*base) : 1}, roughness_range}};
    if (coat) {
      p.push_back({"clearcoat", {coat->weight}});
      p.push_back({"clearcoatRoughness", {one_roughness(*coat)}, roughness_range});
      p.push_back({"ior", {grey_dielectric(*coat).eta}, index_range});
    }
    all.push_back({std::move(p), usd_values});
  }
  return all;
}

std::vector<std::string> usd_lost(const BoundModel& fit,
                                  const Surface& s,
                                  const TargetParameters&) {
  auto all = lost_in_layers(fit, s, "UsdPreviewSurface's");
  if (s.lobes.empty())
    all.emplace_back(
        "A surface without a highlight: UsdPreviewSurface's is white at grazing angles.");
  if (fit.model.anisotropic) all.emplace_back("Anisotropy: UsdPreviewSurface has one roughness.");
  if (fit.model.find("eta") || fit.model.find("f82_tint") || fit.model.find("f90"))
    all.emplace_back("The Fresnel curve: UsdPreviewSurface has Schlick's, which ends at 1.");
  return all;
}

std::string usd_file(const Export& e, const std::string& fit) {
  std::string inputs;
  for (auto [name, v] : e.parameters) {
    const bool color = name.ends_with("Color");
    if (color) v.resize(3, v[0]);
    inputs += fmt::format("            {} inputs:{} = {}{}{}\n", color ? "color3f" : "float", name,
                          color ? "(" : "", xml_numbers(v), color ? ")" : "");
  }
  return fmt::format(R"(#usda 1.0
(
    customLayerData = {{
        string gonio = {}
    }}
    defaultPrim = "fit"
    metersPerUnit = 1
    upAxis = "Y"
)

def Scope "fit"
{{
    def Material "fit_material"
    {{
        token outputs:surface.connect = </fit/fit_material/fit_shader.outputs:surface>

        def Shader "fit_shader"
        {{
            uniform token info:id = "UsdPreviewSurface"
            int inputs:useSpecularWorkflow = 1
{}            token outputs:surface
        }}
    }}
}}
)",
                     Json(fit).dump(), inputs);
}

}  // namespace

const Target usd_preview_target{"UsdPreviewSurface", usd_forms, usd_lost, usd_file};

}  // namespace gonio
