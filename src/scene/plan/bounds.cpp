#include "scene/plan/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/function/any_function.h"
#include "integrate/rule/slopes.h"
#include "number/enclosure.h"

namespace gonio::scene {
namespace {

/// Directions within an angle of one.
struct Cone {
  Direction axis;
  double angle;  ///< [rad]
};

/// Cone of directions from any point of the sphere to a point; all, where that lies within.
Cone towards(const BoundingSphere& from, const Vector& point) {
  const Vector way = point - from.center;
  const double far = length(way);
  if (!(far > from.radius)) return {{0, 0, 1}, std::numbers::pi};
  return {direction(way), std::asin(from.radius / far)};
}
Cone of_range(const AngleRange& r) {
  const auto [e0, e1] = r.elevation_deg;
  const auto [a0, a1] = r.azimuth_deg;
  // A step in azimuth is at most as long as on the equator: the ways add up.
  const double angle = degree * ((e1 - e0) + (a1 - a0)) / 2;
  return {direction_of((e0 + e1) / 2, (a0 + a1) / 2), std::min(angle, std::numbers::pi)};
}
double between(const Direction& a, const Direction& b) {
  const Vector u = vector_of(a), v = vector_of(b);
  return std::atan2(length(cross(u, v)), dot(u, v));
}

Cone viewers(const Scene& s, const BoundingSphere& object) {
  if (const auto* camera = std::get_if<Camera>(&s.view)) return towards(object, camera->position);
  const auto& orbit = std::get<Orbit>(s.view);
  Cone from = of_range(orbit.from);
  // The orbit's centre may lie beside the object's.
  const double beside = length(orbit.target - object.center) + object.radius;
  if (!(orbit.distance > beside)) return {{0, 0, 1}, std::numbers::pi};
  return {from.axis, from.angle + std::asin(beside / orbit.distance)};
}
Cone light_from(const Light& light, const BoundingSphere& object) {
  if (const auto* l = std::get_if<DirectionalLight>(&light)) {
    if (const auto* fixed = std::get_if<DirectionalLight::Fixed>(&l->from))
      return {fixed->direction, 0};
    return of_range(std::get<DirectionalLight::Ranging>(l->from).range);
  }
  if (const auto* l = std::get_if<RectangleLight>(&light)) {
    // Seen from the middle the corners lie furthest from its centre.
    const BoundingSphere wider{object.center, object.radius + length(l->u) + length(l->v)};
    return towards(wider, l->center);
  }
  return {{0, 0, 1}, std::numbers::pi};
}

using Interval = Enclosure<double>;
using Reflectance = std::function<std::array<Interval, max_channels>(const Interval& voh)>;
Reflectance fresnel_of(const Surface& s) {
  if (s.spectrum) return SpectralReflectance<Interval>(s.spectrum->in<Interval>());
  const TermUse& term = s.base.model.lobes[0].fresnel;
  std::array<std::vector<Interval>, max_channels> parameters;
  for (std::size_t k = 0; k < max_channels; ++k)
    for (const double p : term_parameters(s.base, term, k)) parameters[k].emplace_back(p);
  return [parameters, f = any_function<Interval>(term.term)](const Interval& c) {
    const FrameAngles<Interval> all{{c, c, c, c, c}, c, c, c, c, c, c};  // it reads VoH alone
    std::array<Interval, max_channels> values;
    for (std::size_t k = 0; k < max_channels; ++k) values[k] = f(parameters[k], all).value();
    return values;
  };
}

/// Largest size of a − b, relative to b and to what b leaves of 1; infinite where that is not bounded.
double fresnel_change(const Surface& exact, const Surface& form, const Range& voh) {
  constexpr int pieces = 4096;
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  const bool passes = !exact.base.model.diffuse.empty();
  double worst = 0;
  const Reflectance exact_at = fresnel_of(exact), form_at = fresnel_of(form);
  const double step = (voh.high - voh.low) / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double low = voh.low + i * step, high = std::min(low + 1.000001 * step, voh.high);
    const auto c = Interval::between(std::min(low, high), high);
    const auto of_form = form_at(c), of_exact = exact_at(c);
    for (std::size_t k = 0; k < max_channels; ++k) {
      const auto &a = of_form[k], &b = of_exact[k];
      if (!a.is_finite() || !b.is_finite() || !(b.low() > 0)) return unbounded;
      const double size = std::max(a.high() - b.low(), b.high() - a.low());
      worst = std::max(worst, size / b.low());
      if (passes) {
        if (!(b.high() < 1)) return unbounded;
        worst = std::max(worst, size / (1 - b.high()));
      }
    }
  }
  return worst * (1 + 1e-12);  // the bound's own rounding
}

}  // namespace

BoundingSphere bounding_sphere(const Object& o) {
  if (const auto* s = std::get_if<Sphere>(&o.shape)) return {s->center, s->radius};
  const auto& points = std::get<MeshShape>(o.shape).mesh->positions;
  std::array<double, 3> low{points[0][0], points[0][1], points[0][2]}, high = low;
  for (const auto& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min<double>(low[k], p[k]);
      high[k] = std::max<double>(high[k], p[k]);
    }
  const Vector a{low[0], low[1], low[2]}, b{high[0], high[1], high[2]};
  return {0.5 * (a + b), 0.5 * length(b - a)};
}

ReachedAngles reached_angles(const Scene& s, const Object& object) {
  const BoundingSphere sphere = bounding_sphere(object);
  const Cone view = viewers(s, sphere);
  double least = std::numbers::pi, most = 0;
  for (const auto& light : s.lights) {
    const Cone from = light_from(light, sphere);
    const double apart = between(view.axis, from.axis), play = view.angle + from.angle + 1e-12;
    least = std::min(least, std::max(apart - play, 0.0));
    most = std::max(most, std::min(apart + play, std::numbers::pi));
  }
  return {{most < std::numbers::pi ? std::cos(most / 2) : 0, std::cos(least / 2)}};
}

std::optional<double> change_bound(const Look& look,
                                   Effect effect,
                                   Form form,
                                   const ReachedAngles& reached) {
  if (effect != Effect::fresnel) return {};
  Forms changed = look.structural();  // the same as exact, and what is absent reflects nothing
  const Surface exact = look.surface(changed);
  changed[effect] = form;
  if (exact.base.model.lobes.empty()) return {};
  const double change = fresnel_change(exact, look.surface(changed), reached.voh);
  return change < 1 ? std::optional(change) : std::nullopt;
}

double delta_e_bound(double change) {
  return change < 1 ? 733 * change / std::pow(1 - change, 2.0 / 3)
                    : std::numeric_limits<double>::infinity();
}

}  // namespace gonio::scene
