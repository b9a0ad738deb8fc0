// glTF 2.0's metallic-roughness material, Appendix B of its specification.
#include <cmath>

#include "base/json_reader.h"
#include "brdf/model/evaluate.h"
#include "fitting/export/target.h"

namespace gonio {
namespace {

BoundModel core_model(const TargetParameters& p) {
  std::vector<Setting> settings;
  for (const auto& x : p) settings.push_back({x.name, x.values});
  return bind_model("gltf", settings, p.front().values.size());
}

std::vector<TargetForm> forms(const Surface& s) {
  std::vector<double> reflected(s.channels, 0.0);
  double alpha = 1;
  if (!s.lobes.empty()) {
    const auto& l = s.lobes.front();
    for (std::size_t c = 0; c < s.channels; ++c) reflected[c] = l.weight * l.f0[c];
    alpha = std::sqrt(l.alpha_x * l.alpha_y);
  }
  double diffuse = 0, specular = 0;
  for (std::size_t c = 0; c < s.channels; ++c) diffuse += s.kd[c], specular += reflected[c];
  const bool metal = specular > diffuse;
  return {{{{"base_color", metal ? reflected : s.kd},
            {"metallic", {metal ? 1.0 : 0.0}},
            {"roughness", {std::sqrt(alpha)}}},
           [](const TargetParameters& p, std::span<const FrameAngles<double>> angles) {
             return evaluate(core_model(p), angles);
           }}};
}

std::vector<std::string> lost(const BoundModel& fit, const Surface& s) {
  auto all = lost_by_all(fit, "glTF's", "separable");
  if (s.lobes.size() > 1) all.emplace_back("A second lobe: glTF has one.");
  if (s.lobes.empty()) all.emplace_back("A surface without a highlight: glTF reflects 4 %.");
  if (fit.model.anisotropic)
    all.emplace_back("Anisotropy: glTF's material without extensions has one roughness.");
  if (fit.model.find("eta") || fit.model.find("f82_tint") || fit.model.find("f90"))
    all.emplace_back("The Fresnel curve: glTF has Schlick's, which ends at 1.");
  return all;
}

std::string file(const Export& e, const std::string& fit) {
  const auto values = [&](std::string_view name) -> const std::vector<double>& {
    return std::ranges::find(e.parameters, name, [](const auto& p) { return p.first; })->second;
  };
  const auto& color = values("base_color");
  Json factor = Json::array();
  for (std::size_t c = 0; c < 3; ++c) factor.push_back(color[color.size() == 3 ? c : 0]);
  factor.push_back(1.0);
  const Json material{{"name", "fit"},
                      {"pbrMetallicRoughness",
                       {{"baseColorFactor", factor},
                        {"metallicFactor", values("metallic")[0]},
                        {"roughnessFactor", values("roughness")[0]}}},
                      {"extras", {{"gonio", parse_json(e.fit, fit)}}}};
  return text_of(Json{{"asset", {{"version", "2.0"}, {"generator", "gonio"}}},
                      {"materials", Json::array({material})}});
}

}  // namespace

const Target gltf_target{"glTF", forms, lost, file};

}  // namespace gonio
