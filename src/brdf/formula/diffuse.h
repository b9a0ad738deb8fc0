#pragma once
/// \file
/// Diffuse terms [1/sr].  A coupled one reflects only what the first lobe's interface lets through:
/// the model multiplies it by 1 − F(VoH).

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {

/// Lambert:  kd/π
template <Real T>
struct Lambert {
  static constexpr About about{"diffuse.lambert", "Lambert, uncoupled", "f = kd/π", "Lambert 1760"};
  static constexpr std::array parameters{
      Parameter{"kd", {0, 1}, {0, 1}, 0.2, true, "diffuse albedo"}};
  static constexpr bool coupled = false, uniform = true;

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

/// Disney's diffuse: darker at grazing angles where smooth, brighter where rough.
///
///   f = kd/π (1 + (F_D90 − 1)(1 − NoL)⁵)(1 + (F_D90 − 1)(1 − NoV)⁵),   F_D90 = 0.5 + 2 r VoH²
///                                                                         [Burley 2012, section 5.3]
///
/// with r = √alpha.  It reflects more than it receives: its albedo reaches 1.52 kd at r = 1 and
/// grazing angles.
template <Real T>
struct DisneyDiffuse {
  static constexpr About about{
      "diffuse.disney",
      "Disney's diffuse",
      "f = kd/π (1 + (F_D90−1)(1−NoL)⁵)(1 + (F_D90−1)(1−NoV)⁵), F_D90 = 0.5 + 2 r VoH², r = √alpha",
      "Burley 2012, section 5.3",
      "001",
      "Disney's principled BRDF; Unreal Engine and Frostbite offer it, Frostbite renormalised",
      "diffuse.lambert"};
  static constexpr std::array parameters{Lambert<T>::parameters[0], any_alpha_parameter};
  static constexpr bool coupled = false;

  T value, two_r;

  explicit DisneyDiffuse(std::span<const T, 2> p)
      : value(p[0] / pi<plain_t<T>>()), two_r(2 * sqrt(p[1])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const T f_less_1 = two_r * square(a.voh) - constant<plain_t<T>>(0.5L);
    return value *
           ((f_less_1 * schlick_weight(a.nol) + 1) * (f_less_1 * schlick_weight(a.nov) + 1));
  }
};

/// Disney's diffuse under an interface:  (1 − F(VoH)) f
template <Real T>
struct DisneyDiffuseCoupled : DisneyDiffuse<T> {
  static constexpr About about{
      "diffuse.disney.coupled",
      "Disney's diffuse under the first lobe's interface",
      "f = (1 − F(VoH)) f of diffuse.disney",
      "Burley 2012, section 5.3; the interface as of diffuse.lambert.coupled",
      "",
      "",
      "diffuse.lambert.coupled"};
  static constexpr bool coupled = true;
  using DisneyDiffuse<T>::DisneyDiffuse;
};

}  // namespace gonio::inline GONIO_ARCH
