#pragma once
/// \file
/// A and B of the split sum by formulas that shaders run in place of a table:
/// F0 A + B.  Ours, of A + B alone, and MaterialX's stand in scattering.h.

#include <array>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// 2ˣ
template <Real T>
T power_of_2(const T& x) {
  return exp(x * constant<T>(0.693147180559945309417L));
}

/// Unreal Engine 4's on mobile devices: Lazarov's, fitted to GGX under k = α/2.
/// [Karis 2014, Physically Based Shading on Mobile]
template <Real T>
std::array<T, 2> split_sum_karis(const T& roughness, const T& nov) {
  const auto c = [](long double x) { return constant<T>(x); };
  const T x = 1 - roughness, y = c(0.0425L) - c(0.0275L) * roughness;
  const T least = min<T>(x * x, power_of_2<T>(c(-9.28L) * nov)) * x + y;
  return {c(1.04L) - c(0.572L) * roughness - c(1.04L) * least,
          c(0.022L) * roughness - c(0.04L) + c(1.04L) * least};
}

/// Black Ops II's, for Blinn–Phong of the exponent 2^(13 g); of GGX g is taken
/// from the exponent that has its α, 2/α² − 2, clamped to [0, 1]. [Lazarov
/// 2013, Getting More Physical in Call of Duty: Black Ops II]
template <Real T>
std::array<T, 2> split_sum_lazarov(const T& roughness, const T& nov) {
  const auto c = [](long double x) { return constant<T>(x); };
  const T alpha = roughness * roughness;
  const T exponent = 2 / max<T>(alpha * alpha, c(1e-8L)) - 2;
  const T gloss =
      min<T>(log(max<T>(exponent, T(1))) * c(1 / (13 * 0.693147180559945309417L)), T(1));
  const T at_f0_0 =
      gloss * c(1 / 0.96L) * min<T>(gloss * c(0.475L), power_of_2<T>(c(-9.28L) * nov)) +
      gloss * c((0.0275L - 0.25L * 0.04L) / 0.96L) + c((0.015L - 0.75L * 0.04L) / 0.96L);
  const T at_f0_1 = gloss * c(0.25L) + c(0.75L);
  return {at_f0_1 - at_f0_0, at_f0_0};
}

}  // namespace gonio::inline GONIO_ARCH
