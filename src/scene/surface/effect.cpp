#include "scene/surface/effect.h"

namespace gonio::scene {

std::span<const std::string_view> forms_of(Effect effect) {
  static constexpr std::array<std::string_view, 3> fresnel{"schlick", "f82", "exact"},
      masking{"schlick_k", "separable", "correlated"}, diffuse{"none", "lambert", "disney"};
  static constexpr std::array<std::string_view, 5> compensation{"none", "turquin", "fdez_aguera",
                                                                "kulla_conty", "tabulated"};
  static constexpr std::array<std::string_view, 2> off_on{"off", "on"}, tail{"ggx", "gtr"},
      spectrum{"rgb", "spectral"}, environment{"split_sum", "quadrature"},
      precision{"float", "double"};
  switch (effect) {
    case Effect::fresnel:
      return fresnel;
    case Effect::compensation:
      return compensation;
    case Effect::masking:
      return masking;
    case Effect::tail:
      return tail;
    case Effect::diffuse:
      return diffuse;
    case Effect::spectrum:
      return spectrum;
    case Effect::environment:
      return environment;
    case Effect::precision:
      return precision;
    default:
      return off_on;
  }
}

}  // namespace gonio::scene
