#pragma once
/// \file
/// Reflectance at normal incidence, F0, and what it says of the refractive index
/// N = n + i k: maps (brdf/term/map.h) between F0, n, Gulbrandsen's (r, g) and (n, k).

#include <array>
#include <span>
#include <string_view>

#include "number/parameter.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// √x, and 0 without a slope at 0, where the root has none.
template <Real T>
T sqrt_from_0(const T& x) {
  const auto positive = T(0) < x;
  return select<T>(positive, sqrt(select<T>(positive, x, T(1))), T(0));
}

/// F0 = ((n1 − n2)/(n1 + n2))²
template <Real T>
struct F0FromIor {
  static constexpr About about{
      "f0.from_ior", "F0 of an interface between two dielectrics", "f0 = ((n1 − n2)/(n1 + n2))²",
      "Born & Wolf, Principles of Optics, 1.5.3", "pbrt; glTF 2.0 (KHR_materials_ior)"};
  static constexpr std::array parameters{
      Parameter{"n1", {0.2, 10}, {1, 4}, 1.5, true, "refractive index of the surface"},
      Parameter{"n2", {0.2, 10}, {1, 4}, 1, false, "refractive index of what lies around it"}};
  static constexpr std::array<std::string_view, 1> outputs{"f0"};

  static std::array<T, 1> apply(std::span<const T, 2> p) {
    return {square((p[0] - p[1]) / (p[0] + p[1]))};
  }
};

/// F0 as notes in circulation print it: the square is missing, so that glass has F0 = 0.2 for 0.04, and an
/// index below that of the surroundings a negative F0.
template <Real T>
struct F0FromIorAsWritten {
  static constexpr About about{"f0.from_ior.as_written",
                               "F0 of an interface, its square missing",
                               "f0 = (n1 − n2)/(n1 + n2)",
                               "as printed in notes in circulation",
                               "",
                               "",
                               "f0.from_ior"};
  static constexpr std::array parameters = F0FromIor<T>::parameters;
  static constexpr std::array<std::string_view, 1> outputs{"f0"};

  static std::array<T, 1> apply(std::span<const T, 2> p) { return {(p[0] - p[1]) / (p[0] + p[1])}; }
};

/// η = (1 + √f0)/(1 − √f0): the index above 1 that has this F0; its inverse has it too.
template <Real T>
struct IorFromF0 {
  static constexpr About about{"f0.to_ior", "Refractive index of a dielectric with this F0",
                               "eta = (1 + √f0)/(1 − √f0)",
                               "Born & Wolf, Principles of Optics, 1.5.3, solved for n"};
  static constexpr std::array parameters{
      Parameter{"f0", {0, 0.9999}, {0, 0.36}, 0.04, true, "reflectance at normal incidence"}};
  static constexpr std::array<std::string_view, 1> outputs{"eta"};

  static std::array<T, 1> apply(std::span<const T, 1> p) {
    const T s = sqrt_from_0<T>(p[0]);
    return {(1 + s) / (1 - s)};
  }
};

/// f0 = lerp(dielectric, base_color, metallic), and what is left for the diffuse: kd = base_color (1 −
/// metallic), of which a coupled diffuse takes 1 − F.  The map's dielectric is 0.04.
template <Real T>
struct F0Metallic {
  static constexpr About about{"f0.metallic", "Metallic workflow",
                               "f0 = lerp(0.04, base_color, metallic), kd = base_color "
                               "(1 − metallic), to be coupled: Kd = (1 − F)(1 − metallic)",
                               "Burley 2012; glTF 2.0, Appendix B",
                               "glTF 2.0, Unreal Engine, Unity"};
  static constexpr std::array parameters{
      Parameter{"base_color", {0, 1}, {0, 1}, 0.5, true, "colour of diffuse or metal"},
      Parameter{"metallic", {0, 1}, {0, 1}, 0, false, "0 dielectric, 1 metal"}};
  static constexpr std::array<std::string_view, 2> outputs{"f0", "kd"};

  static std::array<T, 2> apply(std::span<const T, 2> p) {
    return of(constant<T>(0.04L), p[0], p[1]);
  }
  static std::array<T, 2> of(const T& dielectric, const T& base_color, const T& metallic) {
    return {dielectric * (1 - metallic) + base_color * metallic, base_color * (1 - metallic)};
  }
};

/// The index of a conductor from its reflectance r at normal incidence and an edge tint g.
///
///   n = g n_min + (1 − g) n_max,   n_min = (1 − r)/(1 + r),   n_max = (1 + √r)/(1 − √r)
///   k² = (r (n + 1)² − (n − 1)²)/(1 − r)                                            [Gulbrandsen 2014]
///
/// k² is computed as (n_max − n)(n − 1/n_max), where with s = √r nothing cancels:
///   n_max − n     = g d,   d = n_max − n_min = 2 s (1 + s)/((1 − s)(1 + r))
///   n − 1/n_max   = (1 − g) d + 2 s (1 − s)/((1 + r)(1 + s))
///
/// which are left apart: in half their product is too large where r is near 1.
///
/// \param r  in (0, 1)   \param g  in [0, 1]
template <Real T>
struct TintedIndex {
  T n, n_less_one;
  T above, below;  ///< n_max − n, n − 1/n_max; k² is their product
};
template <Real T>
TintedIndex<T> tinted_index(const T& r, const T& g) {
  const T s = sqrt(r), rest = 1 - g, one_less_s = (1 - r) / (1 + s);
  const T d = 2 * s * (1 + s) / (one_less_s * (1 + r));
  return {g * (1 - r) / (1 + r) + rest * (1 + s) / one_less_s,
          rest * 2 * s / one_less_s - g * 2 * r / (1 + r), g * d,
          rest * d + 2 * s * one_less_s / ((1 + r) * (1 + s))};
}

/// (r, g) → (n, k)
template <Real T>
struct IndexFromEdgeTint {
  static constexpr About about{
      "f0.to_index", "Index of a conductor from reflectance and edge tint",
      "eta = g (1−f0)/(1+f0) + (1−g) (1+√f0)/(1−√f0), k² = (f0 (eta+1)² − (eta−1)²)/(1−f0)",
      "Gulbrandsen 2014, Artist Friendly Metallic Fresnel", "MaterialX (artistic_ior)"};
  static constexpr std::array parameters{
      Parameter{"f0", {1e-6, 0.9999}, {0.01, 0.99}, 0.8, true, "reflectance at normal incidence"},
      Parameter{"g", {0, 1}, {0, 1}, 0.5, true, "edge tint: 0 no absorption, 1 the most"}};
  static constexpr std::array<std::string_view, 2> outputs{"eta", "k"};

  static std::array<T, 2> apply(std::span<const T, 2> p) {
    const auto i = tinted_index<T>(p[0], p[1]);
    return {i.n, sqrt_from_0<T>(i.above * i.below)};
  }
};

/// (n, k) → (r, g):  r = ((n − 1)² + k²)/((n + 1)² + k²),  g = (n_max − n)/(n_max − n_min)
///
/// g is above 1 where n < n_min: then no (r, g) of the paper stands for this index.  Where n ≥ 1,
/// n_max − n is computed as k²/(n − 1/n_max), else nothing of it is left when k is small.  The index 1
/// without absorption reflects nothing; its g is 0.
template <Real T>
struct EdgeTintFromIndex {
  static constexpr About about{
      "f0.from_index", "Reflectance and edge tint of a conductor",
      "f0 = ((eta−1)² + k²)/((eta+1)² + k²), g = (n_max − eta)/(n_max − n_min), "
      "n_min = (1−f0)/(1+f0), n_max = (1+√f0)/(1−√f0)",
      "Gulbrandsen 2014, Artist Friendly Metallic Fresnel"};
  static constexpr std::array parameters{
      Parameter{"eta", {0.001, 20}, {0.01, 10}, 1.5, true, "refractive index, real part"},
      Parameter{"k", {0, 1000}, {0, 20}, 3, true, "extinction coefficient"}};
  static constexpr std::array<std::string_view, 2> outputs{"f0", "g"};

  static std::array<T, 2> apply(std::span<const T, 2> p) {
    const T &n = p[0], k2 = square(p[1]);
    const T den = square(n + 1) + k2, r = (square(n - 1) + k2) / den;
    const auto reflects = T(0) < r;
    const T s = sqrt(select<T>(reflects, r, constant<T>(0.25L)));
    const T one_less_r = 4 * n / den, one_less_s = one_less_r / (1 + s);
    const T n_max = (1 + s) / one_less_s, d = 2 * s * (1 + s) / (one_less_s * (1 + r));
    const auto above = !(n < T(1));
    const T n_max_less_n =
        select<T>(above, k2 / select<T>(above, n - one_less_s / (1 + s), T(1)), n_max - n);
    return {r, select<T>(reflects, n_max_less_n / d, T(0))};
  }
};

}  // namespace gonio::inline GONIO_ARCH
