#pragma once
/// \file
/// Directions: unit vectors away from the surface, normal +z, tangent +x.

#include <cmath>
#include <numbers>

namespace gonio {

struct Direction {
  double x = 0, y = 0, z = 1;
};

/// A direction pair: wi to the light, wo to the viewer.
struct DirectionPair {
  Direction wi, wo;
};

inline constexpr double degree = std::numbers::pi / 180;

inline double dot(const Direction& a, const Direction& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// \param theta  zenith angle [rad]  \param phi  azimuth from +x towards +y [rad]
inline Direction direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Zenith angle in [0, π].  By atan2: acos(z) loses half the digits near the pole.
inline double theta_of(const Direction& d) {
  return std::atan2(std::hypot(d.x, d.y), d.z);
}
/// Azimuth in (−π, π]; 0 at the pole.
inline double phi_of(const Direction& d) {
  return std::atan2(d.y, d.x);
}

}  // namespace gonio
