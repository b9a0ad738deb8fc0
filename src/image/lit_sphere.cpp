#include "image/lit_sphere.h"

#include <cmath>

#include "geometry/vector.h"

namespace gonio {
namespace {

/// A viewer's direction in the frame of a surface there.
struct SurfaceFrame {
  Vector x, y, z;

  /// \param normal  not straight up or down
  explicit SurfaceFrame(const Vector& normal) : z(normal) {
    x = vector_of(direction(Vector{z.z, 0, -z.x}));
    y = cross(z, x);
  }
  Direction operator()(const Direction& d) const {
    const Vector v = vector_of(d);
    return {dot(x, v), dot(y, v), dot(z, v)};
  }
};

}  // namespace

const std::array<SphereLight, 3>& sphere_lights() {
  static const std::array<SphereLight, 3> all{
      SphereLight{"front light",
                  {direction(Vector{0.5, 0.6, 0.62}), direction(Vector{-0.7, 0.2, 0.69}),
                   direction(Vector{0.1, -0.5, 0.86})}},
      SphereLight{"rim light",
                  {direction(Vector{0.9, 0.3, -0.3}), direction(Vector{-0.95, 0.1, -0.2}),
                   direction(Vector{0.5, 0.6, 0.62})}},
      SphereLight{"flash", {Direction{0, std::sin(10 * degree), std::cos(10 * degree)}}}};
  return all;
}

LitSphere::LitSphere(std::span<const Direction> towards_lights, std::size_t size)
    : pixels(size), inside(size * size) {
  constexpr Direction viewer{0, 0, 1};
  constexpr double horizon = 1e-9;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const auto place = [&](std::size_t k) {
      return ((2 * static_cast<double>(k) + 1) / static_cast<double>(size) - 1) / radius;
    };
    const double x = place(i % size), y = -place(i / size), z2 = 1 - x * x - y * y;
    inside[i] = z2 > 0;
    if (!inside[i]) continue;
    const SurfaceFrame into({x, y, std::sqrt(z2)});
    const Direction wo = into(viewer);
    for (const Direction& light : towards_lights)
      if (const Direction wi = into(light); wi.z > horizon && wo.z > horizon)
        points.push_back({i, {wi, wo}});
  }
}

std::vector<Rgb> LitSphere::radiance(std::span<const Rgb> f) const {
  std::vector<Rgb> all(inside.size(), Rgb{});
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) all[points[k].pixel][c] += f[k][c] * points[k].at.wi.z;
  return all;
}

}  // namespace gonio
