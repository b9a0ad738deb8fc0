#include "brdf/model/reflectances.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "optics/f0.h"

namespace gonio {
namespace {

std::string plain_name(std::string_view name) {
  if (name == "lambert.metallic") return "lambert";
  if (name == "lambert.metallic.coupled") return "lambert.coupled";
  if (name == "schlick.metallic" || name == "schlick.reflectance") return "schlick";
  return std::string(name);
}

/// Workflow's parameters of a term.
struct Workflow {
  const ModelParameter *base_color = nullptr, *metallic = nullptr, *reflectance = nullptr;

  Workflow(const BoundModel& b, const TermUse& t) {
    for (const std::size_t i : t.parameters) {
      const auto& p = b.model.parameters[i];
      const auto name = p.about->name;
      (name == "base_color"    ? base_color
       : name == "metallic"    ? metallic
       : name == "reflectance" ? reflectance
                               : unused) = &p;
    }
  }
  explicit operator bool() const { return base_color != nullptr; }

  /// f0 and kd of each channel.
  std::pair<std::vector<double>, std::vector<double>> resolved(const BoundModel& b) const {
    std::pair<std::vector<double>, std::vector<double>> channels;
    for (std::size_t c = 0; c < b.model.channels; ++c) {
      const double m = b.values[metallic->slot(c)];
      const double r = reflectance ? b.values[reflectance->slot(c)] : 0.5;
      const auto [f0, kd] = F0Metallic<double>::of(0.16 * r * r, b.values[base_color->slot(c)], m);
      channels.first.push_back(f0);
      channels.second.push_back(kd);
    }
    return channels;
  }

 private:
  const ModelParameter* unused = nullptr;
};

}  // namespace

BoundModel in_reflectances(const BoundModel& b) {
  std::vector<Setting> settings;
  for (const auto& d : b.model.diffuse)
    if (const Workflow w(b, d); w) settings.push_back({"kd", w.resolved(b).second});
  for (std::size_t l = 0; l < b.model.lobes.size(); ++l)
    if (const Workflow w(b, b.model.lobes[l].fresnel); w)
      settings.push_back({to_text({"f0", l}), w.resolved(b).first});
  if (settings.empty()) return b;
  ModelSpec spec = b.model.spec;
  each_name(spec, [](std::string& name) { name = plain_name(name); });
  const Model plain = compose(spec, b.model.channels);
  for (const auto& [name, values] : named_values(b))
    if (plain.find(name)) settings.push_back({name, values});
  return bind_model(spec, std::move(settings), b.model.channels);
}

}  // namespace gonio
