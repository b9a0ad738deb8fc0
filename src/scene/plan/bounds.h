#pragma once
/// \file
/// Proved bounds of what a form changes, over all angles that a scene can reach.

#include <optional>

#include "number/parameter.h"
#include "scene/description/scene.h"
#include "scene/surface/surface.h"

namespace gonio::scene {

/// Sphere that holds an object.
struct BoundingSphere {
  Vector center;
  double radius = 0;
};
BoundingSphere bounding_sphere(const Object&);

/// Angles that lights and viewers of a scene leave.
struct ReachedAngles {
  Range voh{0, 1};  ///< cosine of half the angle between light and viewer
};

/// Angles at an object's surface, whatever its normals: those between any point of the lights and any of the viewers, as seen
/// from the sphere around the object.  Environments, and viewers within the sphere, reach all.
ReachedAngles reached_angles(const Scene&, const Object&);

/// Most by which f changes, relative to the exact, where one effect takes a form and all others are exact: all that adds up to f is
/// positive, so that f changes by no more than the part that changes most.
///
///   Fresnel    max(|F − F'|/F, |F − F'|/(1 − F)), the latter where light goes below; several bounces have the exact F_avg
///
/// by enclosures of the terms over pieces of the range, rounding included.  No value where the change is not bounded by angles
/// alone, or by no less than 1.
std::optional<double> change_bound(const Look&, Effect, Form, const ReachedAngles&);

/// Bound of ΔE2000 between display colours of which each channel differs by `change`, relative.  With f' ≤ f/3 of CIELAB's f,
///
///   ΔL ≤ 116/3 d, Δa ≤ 1000/3 d, Δb ≤ 400/3 d,   d = change/(1 − change)^⅔
///   ΔE² ≤ ΔL² + 2 ((1.5 Δa)² + Δb²) ≤ (733 d)²:   S_L, S_C, S_H ≥ 1, a' ≤ 1.5 a, |R_T| ≤ 2
double delta_e_bound(double change);

}  // namespace gonio::scene
