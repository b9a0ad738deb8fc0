#include "scene/plan/effect_map.h"

#include <algorithm>
#include <cmath>

#include "brdf/model/roughness.h"
#include "scene/plan/reference.h"

namespace gonio::scene {
namespace {

/// Material whose first lobe has the widths of a roughness.
Material widened(Material m, double roughness) {
  if (auto* gltf = std::get_if<GltfMaterial>(&m.is)) {
    gltf->roughness = roughness;
    return m;
  }
  auto& b = std::get<BoundModel>(m.is);
  const double alpha = alpha_of(roughness);
  const auto value = [&](const char* name) -> double* {
    const auto* p = b.model.find(name);
    return p ? &b.values[p->first] : nullptr;
  };
  if (double* x = value("alpha_x")) {
    double* y = value("alpha_y");
    const double scale = alpha / std::sqrt(*x * *y);
    for (double* width : {x, y}) *width = std::clamp(scale * *width, 1e-4, 1.0);
  }
  if (double* a = value("alpha")) *a = alpha;
  return m;
}

/// A sphere of the material, seen from far along +z, under one light.
Scene sphere_of(const Scene& s, const Material& m, double light_deg) {
  Scene one;
  one.path = s.path;
  one.materials = {m};
  one.objects = {{Sphere{}, 0}};
  const double white = 3 / s.exposure;
  one.lights = {DirectionalLight{DirectionalLight::Fixed{direction(light_deg * degree, 0)},
                                 {white, white, white}}};
  one.view = Camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 12};
  one.exposure = s.exposure;
  one.tolerance = s.tolerance;
  one.seed = s.seed;
  return one;
}

}  // namespace

EffectMap effect_map(const Scene& s,
                     std::size_t material,
                     std::vector<double> light_deg,
                     std::vector<double> roughness,
                     std::size_t samples) {
  EffectMap map{std::move(light_deg), std::move(roughness), {}};
  constexpr std::uint64_t stream = 3;  // after those of plan.cpp
  for (auto& e : map.error) e.assign(map.light_deg.size() * map.roughness.size(), 0);
  for (std::size_t i = 0; i < map.light_deg.size(); ++i)
    for (std::size_t j = 0; j < map.roughness.size(); ++j) {
      const Scene one =
          sphere_of(s, widened(s.materials[material], map.roughness[j]), map.light_deg[i]);
      const Lit lit(one);
      const Look& look = lit.looks[0];
      const auto drawer = lit.drawer(0, 1);
      const Reference reference(one, drawer.draw(stream, 0, samples), look.surface(look.exact()));
      for (std::size_t e = 0; e < effect_count; ++e) {
        const auto effect = static_cast<Effect>(e);
        const auto& offer = look.offer(effect);
        if (offer.same_as_exact == offer.forms.front()) continue;
        Forms forms = look.exact();
        forms[effect] = offer.forms.front();
        auto d = reference.differences_of(one, look.surface(forms));
        map.error[e][i * map.roughness.size() + j] = judge(d, s.tolerance).quantile;
      }
    }
  return map;
}

}  // namespace gonio::scene
