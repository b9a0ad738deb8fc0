// Names of effects, and speeds, as people say them.
#include <algorithm>

#include "reports/page/numbers.h"
#include "reports/scenes/measure.h"
#include "scene/plan/cost.h"

namespace gonio::scenes {

using scene::Effect;

std::string name_of_form(scene::Form form) {
  static constexpr std::array<const char*, names_of<scene::Form>.size()> names{
      "Schlick's Fresnel",
      "F82 Fresnel",
      "exact Fresnel",
      "no multiple scattering",
      "multiple scattering by Turquin",
      "multiple scattering by Fdez-Agüera",
      "multiple scattering by Kulla and Conty",
      "multiple scattering",
      "Schlick's masking",
      "separable masking",
      "correlated masking",
      "isotropy",
      "anisotropy",
      "no coat",
      "coat",
      "GGX's tail",
      "GTR's tail",
      "no diffuse",
      "Lambert diffuse",
      "retro-reflective diffuse",
      "the given diffuse term",
      "uncoupled diffuse",
      "coupled diffuse",
      "three wavelengths",
      "the metal's spectrum",
      "split sum",
      "the environment's integral",
      "float",
      "double"};
  static_assert(names.back() != nullptr, "a form without a name");
  return names[static_cast<std::size_t>(form)];
}

std::string_view name_of_effect(Effect effect) {
  switch (effect) {
    case Effect::fresnel:
      return "Fresnel";
    case Effect::compensation:
      return "multiple scattering";
    default:
      return name_of(effect);
  }
}

std::string speed(double ratio) {
  return scene::is_as_fast(ratio)
             ? "about as fast"
             : page::times(std::max(ratio, 1 / ratio)) + (ratio < 1 ? " as slow" : " as fast");
}

}  // namespace gonio::scenes
