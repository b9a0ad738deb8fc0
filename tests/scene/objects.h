#pragma once
/// \file
/// Scenes of spheres and squares, made without files.

#include <memory>
#include <utility>
#include <vector>

#include "scene/description/scene.h"

namespace gonio::scene::test {

inline Object sphere(const Vector& center, double radius, std::size_t material = 0) {
  return {Sphere{center, radius}, material};
}

/// Square [−size, size]² at a height, seen from above, of two triangles.
inline std::shared_ptr<Mesh> square(float size, float height) {
  Mesh m;
  m.positions = {
      {-size, height, size}, {size, height, size}, {size, height, -size}, {-size, height, -size}};
  m.normals.assign(4, {0, 1, 0});
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::make_shared<Mesh>(m);
}
inline Object object(std::shared_ptr<const Mesh> mesh, std::size_t material = 0) {
  return {MeshShape{"", MeshShape::OfName{}, std::move(mesh)}, material};
}

/// Objects before a camera at (0, 0, 10) that looks at the origin.
inline Scene scene_of(std::vector<Object> objects, std::vector<Light> lights = {}) {
  Scene s;
  s.materials.resize(3);
  s.objects = std::move(objects);
  s.lights = std::move(lights);
  s.view = Camera{{0, 0, 10}, {0, 0, 0}};
  return s;
}

}  // namespace gonio::scene::test
