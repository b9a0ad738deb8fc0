#pragma once
/// \file
/// Vectors of any length, as points and edges of a scene are.

#include <cmath>

#include "geometry/direction.h"

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

}  // namespace gonio
