#pragma once
/// \file
/// Points and directions spread evenly: what integrals over directions are sampled by.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "geometry/direction.h"

namespace gonio {

/// i's binary digits mirrored behind the point, in [0, 1).
inline double radical_inverse(std::uint32_t i) {
  std::uint32_t mirrored = 0;
  for (int bit = 0; bit < 32; ++bit) mirrored |= (i >> bit & 1U) << (31 - bit);
  return mirrored * 0x1p-32;
}

/// Point i of the n of Hammersley in the unit square: (i/n, radical inverse of i).
inline std::array<double, 2> hammersley(std::uint32_t i, double n) {
  return {i / n, radical_inverse(i)};
}

/// A direction drawn from cos θ/π by a point of the unit square: φ = 2π u, sin² θ = w.
inline Direction cosine_direction(const std::array<double, 2>& point) {
  const double phi = 2 * std::numbers::pi * point[0], sine = std::sqrt(point[1]);
  return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - point[1])};
}

/// Direction i of n that lie evenly on the sphere, on a spiral of golden angles.
inline Direction spiral_direction(std::size_t i, std::size_t n) {
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
  const double phi = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
  const double sine = std::sqrt((1 - z) * (1 + z));
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

/// Tangent, bitangent and normal: right-handed.
struct Frame {
  Direction x, y, z;

  /// Around a normal, turned about it by `turn` [rad] from where nothing says it should be.
  ///                                                                  [Duff et al. 2017, Listing 3]
  explicit Frame(const Direction& n, double turn = 0) : z(n) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    const Direction t{1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    const Direction u{b, sign + n.y * n.y * a, -n.y};
    const double c = std::cos(turn), s = std::sin(turn);
    x = {c * t.x + s * u.x, c * t.y + s * u.y, c * t.z + s * u.z};
    y = {c * u.x - s * t.x, c * u.y - s * t.y, c * u.z - s * t.z};
  }
  Direction outside(const Direction& d) const {
    return {d.x * x.x + d.y * y.x + d.z * z.x, d.x * x.y + d.y * y.y + d.z * z.y,
            d.x * x.z + d.y * y.z + d.z * z.z};
  }
  Direction inside(const Direction& d) const { return {dot(d, x), dot(d, y), dot(d, z)}; }
};

}  // namespace gonio
