#pragma once
/// \file
/// Vectors of any length, as points and edges of a scene are.

#include <cmath>

#include "geometry/direction.h"
#include "geometry/sampling.h"

namespace gonio {

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator*(double s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector& a) {
  return std::hypot(a.x, a.y, a.z);
}
inline Vector vector_of(const Direction& d) {
  return {d.x, d.y, d.z};
}
/// Direction of a vector.  \param a  not zero
inline Direction direction(const Vector& a) {
  const double l = length(a);
  return {a.x / l, a.y / l, a.z / l};
}

/// Frame around a normal with a tangent's part across it; where that has none, with any tangent.
inline Frame frame_along(const Direction& normal, const Vector& tangent, double turn = 0) {
  const Vector across = tangent - dot(tangent, vector_of(normal)) * vector_of(normal);
  Frame f(normal, turn);
  if (!(length(across) > 1e-6)) return f;
  const Vector t = vector_of(direction(across)), b = cross(vector_of(normal), t);
  const double c = std::cos(turn), s = std::sin(turn);
  f.x = direction(c * t + s * b);
  f.y = direction(c * b - s * t);
  return f;
}

}  // namespace gonio
