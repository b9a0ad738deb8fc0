// What a white surface gives back under each diffuse term alone.
#include <algorithm>

#include "brdf/catalogue/registry.h"
#include "brdf/model/model.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/energy/energy.h"

namespace gonio {
namespace {

/// Value of a parameter on a white surface of some roughness; what is no alpha goes through its range.
double value_of(const ModelParameter& p, double roughness) {
  if (p.name == "kd") return 1;
  if (p.name == "alpha") return roughness * roughness;
  return p.about->legal.low + roughness * (p.about->legal.high - p.about->legal.low);
}

}  // namespace

std::vector<DiffuseForm> diffuse_forms(const EnergyOptions& o) {
  std::vector<DiffuseForm> out;
  for (const auto& term : catalogue()) {
    // what depends on a lobe's Fresnel, or on a metalness, is no term alone
    if (term.role() != Role::diffuse || term.coupled ||
        std::ranges::find(term.parameters, "metallic", &Parameter::name) != term.parameters.end())
      continue;
    BoundModel b{compose(short_id(term.about->id), 1), {}, {}};
    b.values.resize(b.model.value_count);
    DiffuseForm form{std::string(term.about->id), 0, 0, 0};
    for (const double roughness : o.roughness) {
      for (const auto& p : b.model.parameters) b.values[p.first] = value_of(p, roughness);
      const auto albedo = directional_albedo(b, o.mu, 0, {1e-5, 100'000});
      for (std::size_t i = 0; i < albedo.size(); ++i)
        if (albedo[i].value[0] > form.most_albedo)
          form = {form.id, albedo[i].value[0], roughness, o.mu[i]};
    }
    out.push_back(std::move(form));
  }
  return out;
}

}  // namespace gonio
