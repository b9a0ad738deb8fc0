// Names of effects as people say them.
#include "reports/scenes/measure.h"

namespace gonio::scenes {

using scene::Effect;

std::string name_of_form(Effect effect, std::size_t form) {
  const std::string_view id = scene::forms_of(effect)[form];
  const auto one_of =
      [&](std::initializer_list<std::pair<std::string_view, std::string_view>> all) {
        for (const auto& [of, name] : all)
          if (of == id) return std::string(name);
        return std::string(id);
      };
  switch (effect) {
    case Effect::fresnel:
      return one_of(
          {{"schlick", "Schlick's Fresnel"}, {"f82", "F82 Fresnel"}, {"exact", "exact Fresnel"}});
    case Effect::compensation:
      return one_of({{"none", "no multiple scattering"},
                     {"turquin", "multiple scattering by Turquin"},
                     {"fdez_aguera", "multiple scattering by Fdez-Agüera"},
                     {"kulla_conty", "multiple scattering by Kulla and Conty"},
                     {"tabulated", "multiple scattering"}});
    case Effect::masking:
      return one_of({{"schlick_k", "Schlick's masking"},
                     {"separable", "separable masking"},
                     {"correlated", "correlated masking"}});
    case Effect::anisotropy:
      return one_of({{"off", "isotropy"}, {"on", "anisotropy"}});
    case Effect::coat:
      return one_of({{"off", "no coat"}, {"on", "coat"}});
    case Effect::tail:
      return one_of({{"ggx", "GGX's tail"}, {"gtr", "GTR's tail"}});
    case Effect::diffuse:
      return one_of({{"none", "no diffuse"},
                     {"lambert", "Lambert diffuse"},
                     {"disney", "retro-reflective diffuse"}});
    case Effect::coupling:
      return one_of({{"off", "uncoupled diffuse"}, {"on", "coupled diffuse"}});
    case Effect::spectrum:
      return one_of({{"rgb", "three wavelengths"}, {"spectral", "the metal's spectrum"}});
    case Effect::environment:
      return one_of({{"split_sum", "split sum"}, {"quadrature", "the environment's integral"}});
    default:
      return std::string(id);
  }
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

}  // namespace gonio::scenes
