#include "scene/trace/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gonio::scene {

Rays::Rays(const Camera& c, double aspect) : origin_(c.position) {
  const Vector forward = vector_of(direction(c.target - c.position));
  const Vector right = vector_of(direction(cross(forward, c.up))), up = cross(right, forward);
  const double half = std::tan(c.fov_deg * degree / 2);
  right_ = 2 * half * aspect * right;
  down_ = -2 * half * up;
  corner_ = forward - 0.5 * (right_ + down_);
}

Ray Rays::operator()(double x, double y) const {
  return {origin_, direction(corner_ + x * right_ + y * down_)};
}

namespace {

/// Ends of the picture of a disc on a line at a distance of 1, within [−half, half].
std::array<double, 2> ends_of(double across, double ahead, double radius, double half) {
  const double far = std::hypot(across, ahead);
  if (!(far > radius)) return {-half, half};
  const double middle = std::atan2(across, ahead), wide = std::asin(radius / far);
  const auto end = [&](double angle) {
    if (std::abs(angle) >= std::numbers::pi / 2) return std::copysign(half, angle);
    return std::clamp(std::tan(angle), -half, half);
  };
  return {end(middle - wide), end(middle + wide)};
}

}  // namespace

PicturePart part_around(const Camera& c, double aspect, const Vector& center, double radius) {
  const Vector forward = vector_of(direction(c.target - c.position));
  const Vector right = vector_of(direction(cross(forward, c.up))), up = cross(right, forward);
  const Vector to = center - c.position;
  const double high = std::tan(c.fov_deg * degree / 2), wide = high * aspect;
  const auto [left, end] = ends_of(dot(to, right), dot(to, forward), radius, wide);
  const auto [bottom, top] = ends_of(dot(to, up), dot(to, forward), radius, high);
  return {(left / wide + 1) / 2, (1 - top / high) / 2, (end - left) / (2 * wide),
          (top - bottom) / (2 * high)};
}

Camera camera_of(const Orbit& o, double elevation_deg, double azimuth_deg) {
  // a quarter of a turn further up lies the direction in which the elevation grows
  return {o.target + o.distance * vector_of(direction_of(elevation_deg, azimuth_deg)), o.target,
          vector_of(direction_of(elevation_deg + 90, azimuth_deg)), Camera{}.fov_deg};
}

Camera middle_camera(const View& view) {
  if (const auto* camera = std::get_if<Camera>(&view)) return *camera;
  const auto& o = std::get<Orbit>(view);
  const auto middle = [](const std::array<double, 2>& ends) { return (ends[0] + ends[1]) / 2; };
  return camera_of(o, middle(o.from.elevation_deg), middle(o.from.azimuth_deg));
}

Camera draw_camera(const View& view, Draws& draw) {
  if (const auto* camera = std::get_if<Camera>(&view)) return *camera;
  const auto& o = std::get<Orbit>(view);
  const auto between = [&](const std::array<double, 2>& ends) {
    return std::lerp(ends[0], ends[1], draw.uniform());
  };
  const double elevation = between(o.from.elevation_deg);
  return camera_of(o, elevation, between(o.from.azimuth_deg));
}

}  // namespace gonio::scene
