#pragma once
/// \file
/// Surfaces that rays meet.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "geometry/direction.h"
#include "geometry/sampling.h"
#include "geometry/vector.h"
#include "scene/description/scene.h"

namespace gonio::scene {

/// Point of an object, as it is shaded.
struct Hit {
  Vector position;
  /// Normal z, to the side that the ray comes from, and tangent x, turned as its material asks for.
  Frame frame;
  std::size_t object = 0, material = 0;
};

/// Objects of a scene, for rays.  Spheres are met in double; triangles by Embree in float, where a hit
/// lies on its triangle and has the normal between those of its corners, leant over where that would face away from
/// the ray's origin.  The tangent of a sphere is where the azimuth around +y grows; that of a
/// mesh its own, and where it has none, any that fits the normal.
///
/// It looks into the scene, which outlives it.  All calls may come from many threads.
class Tracer {
 public:
  /// \param turns  of the tangents about the normal [rad], by material (Look::turn()); empty: none
  explicit Tracer(const Scene&, std::span<const double> turns = {});
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// First hit of a ray.
  std::optional<Hit> closest(const Vector& origin, const Direction&) const;
  /// True where something lies between a point of a surface and a distance from it.  The ray starts a step off the
  /// surface, along its normal: 1e-6 of the greatest coordinate of a mesh, 1e-12 of that of a sphere.
  bool occluded(const Vector& from,
                const Direction& normal,
                const Direction&,
                double distance) const;

 private:
  struct Objects;
  std::unique_ptr<const Objects> objects_;
};

}  // namespace gonio::scene
