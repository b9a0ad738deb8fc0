#include "image/lit_sphere.h"

#include <cmath>

#include "geometry/vector.h"

namespace gonio {

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

std::optional<Frame> sphere_frame(std::size_t pixels, std::size_t pixel) {
  const auto place = [&](std::size_t k) {
    return ((2 * static_cast<double>(k) + 1) / static_cast<double>(pixels) - 1) / LitSphere::radius;
  };
  const double x = place(pixel % pixels), y = -place(pixel / pixels), z2 = 1 - x * x - y * y;
  if (!(z2 > 0)) return {};
  const Direction normal{x, y, std::sqrt(z2)};
  return frame_along(normal, {normal.z, 0, -normal.x});
}

LitSphere::LitSphere(std::span<const Direction> towards_lights, std::size_t size)
    : pixels(size), inside(size * size) {
  constexpr double horizon = 1e-9;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const auto frame = sphere_frame(size, i);
    inside[i] = frame.has_value();
    if (!frame) continue;
    const Direction wo = frame->inside(towards_viewer);
    for (const Direction& light : towards_lights)
      if (const Direction wi = frame->inside(light); wi.z > horizon && wo.z > horizon)
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
