#pragma once
/// \file
/// Diffuse terms [1/sr].  A coupled one reflects only what the first lobe's interface lets through:
/// the model multiplies it by 1 − F(VoH).

#include "brdf/term.h"

namespace gonio::inline GONIO_ARCH {

/// Lambert:  kd/π
template <Real T>
struct Lambert {
  static constexpr About about{"diffuse.lambert", "Lambert, uncoupled", "f = kd/π", "Lambert 1760"};
  static constexpr std::array parameters{
      Parameter{"kd", {0, 1}, {0, 1}, 0.2, true, "diffuse albedo"}};
  static constexpr bool coupled = false;

  T value;

  explicit Lambert(std::span<const T, 1> p) : value(p[0] / pi<plain_t<T>>()) {}

  T operator()(const Angles<plain_t<T>>&) const { return value; }
};

/// Lambert under an interface:  (1 − F(VoH)) kd/π
template <Real T>
struct LambertCoupled : Lambert<T> {
  static constexpr About about{"diffuse.lambert.coupled",
                               "Lambert under the first lobe's interface", "f = (1 − F(VoH)) kd/π",
                               "Burley 2012; glTF 2.0, Appendix B"};
  static constexpr bool coupled = true;
  using Lambert<T>::Lambert;
};

}  // namespace gonio::inline GONIO_ARCH
