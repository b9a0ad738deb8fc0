#pragma once
/// \file
/// Maps to the parameters of lobes: clamps against division by zero, anisotropy from one number, the
/// artist's exponent, roughness widened against specular aliasing.

#include <array>
#include <span>
#include <string_view>

#include "brdf/term/map.h"

namespace gonio::inline GONIO_ARCH {

inline constexpr Parameter roughness_parameter{"roughness", {0, 1}, {0, 1},
                                               0.5,         false,  "perceptual roughness r"};
inline constexpr Parameter anisotropy_parameter{
    "anisotropy", {0, 1}, {0, 1}, 0.5, false, "0 isotropic, 1 the most that the map allows"};

/// alpha = max(r², 0.001): GGX divides by alpha² where r is 0.
template <Real T>
struct ClampAlpha {
  static constexpr About about{"clamp.alpha", "Width kept above 0", "alpha = max(r², 0.001)",
                               "common shader practice"};
  static constexpr std::array parameters{roughness_parameter};
  static constexpr std::array<std::string_view, 1> outputs{"alpha"};

  static std::array<T, 1> apply(std::span<const T, 1> p) {
    return {max<T>(square(p[0]), constant<T>(0.001L))};
  }
};

/// NoV = min(|n·v| + 10⁻⁵, 1): a normal that a texture bent away from the viewer reflects as if it
/// were turned back.
template <Real T>
struct ClampNov {
  static constexpr About about{"clamp.nov", "NoV kept above 0", "NoV = saturate(|n·v| + 1e-5)",
                               "Lagarde, de Rousiers 2014, course notes on Frostbite, section 3.2",
                               "Frostbite; Unreal Engine's mobile path"};
  static constexpr std::array parameters{
      Parameter{"nov", {-1, 1}, {-1, 1}, 0.5, false, "n·v, negative seen from behind"}};
  static constexpr std::array<std::string_view, 1> outputs{"nov"};

  static std::array<T, 1> apply(std::span<const T, 1> p) {
    return {min<T>(max<T>(p[0], -p[0]) + constant<T>(1e-5L), T(1))};
  }
};

/// A visibility's denominator kept off 0: max(d, 0.001).  With V = 0.5/d it caps V at 500.
template <Real T>
struct ClampVis {
  static constexpr About about{"clamp.vis", "Visibility's denominator kept above 0",
                               "d = max(d, 0.001)", "as shipped",
                               "a mobile variant of Unreal Engine's SmithJointApprox"};
  static constexpr std::array parameters{
      Parameter{"d", {0, 2}, {0, 2}, 0.5, false, "sum of the two masking terms"}};
  static constexpr std::array<std::string_view, 1> outputs{"d"};

  static std::array<T, 1> apply(std::span<const T, 1> p) {
    return {max<T>(p[0], constant<T>(0.001L))};
  }
};

/// Disney's widths:  aspect = √(1 − 0.9 k),  alpha_x = r²/aspect,  alpha_y = r² aspect.  Burley keeps
/// both above 0.001.  Where aspect² < r⁴, alpha_x is above 1.
template <Real T>
struct AnisoDisney {
  static constexpr About about{"aniso.disney", "Widths along tangent and bitangent, Disney",
                               "aspect = √(1 − 0.9 k), alpha_x = r²/aspect, alpha_y = r² aspect",
                               "Burley 2012, section 5.4, and Appendix B",
                               "Disney's principled BRDF"};
  static constexpr std::array parameters{roughness_parameter, anisotropy_parameter};
  static constexpr std::array<std::string_view, 2> outputs{"alpha_x", "alpha_y"};

  static std::array<T, 2> apply(std::span<const T, 2> p) {
    const T aspect = sqrt(1 - constant<T>(0.9L) * p[1]), alpha = square(p[0]);
    return {alpha / aspect, alpha * aspect};
  }
};

/// Imageworks' widths:  alpha_x = r² (1 + k),  alpha_y = r² (1 − k), which is 0 at k = 1.
template <Real T>
struct AnisoImageworks {
  static constexpr About about{
      "aniso.imageworks", "Widths along tangent and bitangent, Imageworks",
      "alpha_x = r² (1 + k), alpha_y = r² (1 − k)",
      "Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks",
      "Sony Imageworks' Arnold"};
  static constexpr std::array parameters{roughness_parameter, anisotropy_parameter};
  static constexpr std::array<std::string_view, 2> outputs{"alpha_x", "alpha_y"};

  static std::array<T, 2> apply(std::span<const T, 2> p) {
    const T alpha = square(p[0]);
    return {alpha * (1 + p[1]), alpha * (1 - p[1])};
  }
};

/// Blinn–Phong's exponent from an artist's slider:  p = 8192^s.  The width of the Beckmann
/// distribution beside it has alpha² = 2/(p + 2).
template <Real T>
struct BlinnPhongExponent {
  static constexpr About about{"exponent.artist", "Blinn–Phong exponent from a slider",
                               "p = 8192^s, alpha = √(2/(p + 2))",
                               "Lazarov 2011, Physically Based Lighting in Call of Duty: Black Ops",
                               "Call of Duty: Black Ops"};
  static constexpr std::array parameters{
      Parameter{"s", {0, 1}, {0, 1}, 0.5, false, "the slider: 0 roughest, 1 smoothest"}};
  static constexpr std::array<std::string_view, 2> outputs{"exponent", "alpha"};

  static std::array<T, 2> apply(std::span<const T, 1> p) {
    const T exponent = exp(p[0] * constant<T>(9.010913347279288L));  // ln 8192
    return {exponent, sqrt(2 / (exponent + 2))};
  }
};

/// Roughness widened by how much the normals of a pixel vary: the distribution convolved with a
/// Gaussian of slopes, of which alpha² adds up as a variance would.
///
///   alpha² ← min(1, alpha² + min(2 v, κ)),  κ = 0.18               [Tokuyoshi, Kaplanyan 2019, 2021]
///
/// \param variance  v = σ² (|∂n/∂x|² + |∂n/∂y|²) with the derivatives of one pixel and σ² of the pixel
///                  filter: 0.25 in the paper of 2019, 1/(2π) in that of 2021
template <Real T>
struct FilterNormalVariance {
  static constexpr About about{
      "filter.normal_variance", "Width raised against specular aliasing",
      "alpha² ← min(1, alpha² + min(2 v, 0.18)), v = σ² (|∂n/∂x|² + |∂n/∂y|²)",
      "Tokuyoshi, Kaplanyan 2019, Improved Geometric Specular Antialiasing",
      "Filament and Unity's HDRP, with other caps"};
  static constexpr std::array parameters{
      Parameter{"alpha", {0, 1}, {0, 1}, 0.1, false, "width, roughness²"},
      Parameter{"variance", {0, 1e4}, {0, 1e4}, 0.1, false, "variance of the pixel's normals, v"}};
  static constexpr std::array<std::string_view, 1> outputs{"alpha"};

  static std::array<T, 1> apply(std::span<const T, 2> p) {
    const T kernel = min<T>(2 * p[1], constant<T>(0.18L));
    const T alpha2 = min<T>(square(p[0]) + kernel, T(1));
    // At alpha = 0 on a flat surface the root has no slope.
    const auto positive = T(0) < alpha2;
    return {select<T>(positive, sqrt(select<T>(positive, alpha2, T(1))), T(0))};
  }
};

}  // namespace gonio::inline GONIO_ARCH
