#pragma once
/// \file
/// Half and difference angles of a direction pair [Rusinkiewicz 1998].
///
///   h = normalize(wi + wo);   d = wi turned by −phi_h about the normal, then by −theta_h about
///   the binormal
///
/// With phi_h = 0:
///   wi_z = cos θ_h cos θ_d − sin θ_h sin θ_d cos φ_d
///   wo_z = cos θ_h cos θ_d + sin θ_h sin θ_d cos φ_d

#include "geometry/direction.h"
#include "geometry/half_vector.h"

namespace gonio {

/// [rad]; theta_h and theta_d in [0, π/2].  φ_d has the period π on a reciprocal surface.
struct HalfDifference {
  double theta_h = 0, phi_h = 0, theta_d = 0, phi_d = 0;
};

/// With the tangent +x and the bitangent +y.
inline FrameAngles<double> frame_angles(const DirectionPair& p) {
  return angles_between<double>({p.wi.x, p.wi.y, p.wi.z}, {p.wo.x, p.wo.y, p.wo.z});
}
inline Angles<double> angles(const DirectionPair& p) {
  return frame_angles(p);
}

DirectionPair directions(const HalfDifference&);
/// phi_d is 0 where theta_d is 0, phi_h is 0 where theta_h is 0: they are undefined there.
HalfDifference half_difference(const DirectionPair&);

/// Sine and cosine of one angle, so that a grid computes them once per row.
struct SinCos {
  double sin = 0, cos = 1;
  SinCos() = default;
  explicit SinCos(double angle) : sin(std::sin(angle)), cos(std::cos(angle)) {}
};

inline Angles<double> angles(const SinCos& theta_h, const SinCos& theta_d, double cos_phi_d) {
  const double a = theta_h.cos * theta_d.cos, b = theta_h.sin * theta_d.sin * cos_phi_d;
  return {a - b, a + b, theta_h.cos, theta_d.cos, theta_h.sin * theta_h.sin};
}

}  // namespace gonio
