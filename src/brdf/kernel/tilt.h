#pragma once
/// \file
/// Normals that tilt, where texels are lanes.  Included only by files compiled per instruction set.

#include "brdf/kernel/lane.h"

namespace gonio::inline GONIO_ARCH {

/// A register of texels whose normals tilt: f is compared times the cosine of the light over that of the normal given.
struct TiltedTexels : TexelsAsLanes<false> {
  static constexpr std::size_t block = 512;
};
template <class Way>
inline constexpr bool tilts = false;
template <>
inline constexpr bool tilts<TiltedTexels> = true;

/// Angles as numbers that carry their derivatives by the tilt of the normal, n' = n + t x + u y, the last two unknowns of N:
///
///   ∂NoL/∂t = XoL,   ∂|n×h|²/∂t = −2 NoH XoH
template <std::size_t N, class B>
auto tilting(const FrameAngles<B>& a) {
  using T = Dual<B, N, true>;
  const auto along = [](const B& value, const B& x, const B& y) {
    T t(value);
    t.d[N - 2] = x;
    t.d[N - 1] = y;
    return t;
  };
  const B by_noh = a.noh * B(-2);
  return Angles<T>{along(a.nol, a.xol, a.yol), along(a.nov, a.xov, a.yov),
                   along(a.noh, a.xoh, a.yoh), T(a.voh),
                   along(a.sin2_theta_h, by_noh * a.xoh, by_noh * a.yoh)};
}

}  // namespace gonio::inline GONIO_ARCH
