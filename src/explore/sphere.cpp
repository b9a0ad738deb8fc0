#include "explore/sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/quantile.h"
#include "brdf/model/roughness.h"
#include "image/colour_difference.h"
#include "image/display.h"

namespace gonio::explore {
namespace {

constexpr double beside = std::numeric_limits<double>::quiet_NaN();
const double grazing = std::sin(5 * degree);

std::vector<DirectionPair> directions_of(std::span<const LitPoint> points) {
  std::vector<DirectionPair> at;
  at.reserve(points.size());
  for (const auto& p : points) at.push_back(p.at);
  return at;
}

/// f of each point by channel, three or one, in float: a display shows no more.
std::vector<Column<float>> values(const Surface& s,
                                  std::span<const LitPoint> points,
                                  const AngleColumns<float>& columns) {
  std::vector<Column<float>> f;
  for (std::size_t c = 0; c < s.channels(); ++c) f.emplace_back(columns.padded());
  if (const auto* m = s.model()) {
    Evaluator<float> evaluator(m->model);
    evaluator.set(std::vector<float>(m->values.begin(), m->values.end()));
    std::vector<float*> out;
    for (auto& channel : f) out.push_back(channel.data());
    evaluator(columns.block(), out);
    return f;
  }
  const Channels known = s(directions_of(points));
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < points.size(); ++i)
      f[c][i] = std::isnan(known[c][i]) && points[i].at.wi.z < grazing
                    ? 0.0F
                    : static_cast<float>(known[c][i]);
  return f;
}

AngleColumns<float> columns_of(std::span<const LitPoint> points) {
  AngleColumns<float> columns(points.size(), true);
  for (std::size_t i = 0; i < points.size(); ++i) columns.set(i, frame_angles(points[i].at));
  return columns;
}

/// Widths that directions are drawn for: of a model its lobes', of a table some that leave out none.
std::vector<double> widths_of(const Surface& s) {
  const auto* m = s.model();
  if (!m) return {0.1, 0.4};
  std::vector<double> widths;
  for (const auto& p : m->model.parameters)
    if (is_alpha(p.name)) widths.push_back(std::clamp(m->values[p.first], 0.001, 1.0));
  return widths;
}

constexpr Vector upper_right{0.5, 0.6, 0.62};

/// A square of half a side `half` whose middle is `far` from the sphere.
scene::RectangleLight softbox(double half, double far) {
  const Direction d = direction(upper_right);
  const Direction across = direction(Vector{d.z, 0, -d.x});
  const Vector up = cross(vector_of(d), vector_of(across));
  // Share of a hemisphere's cosine that it fills at that distance [Howell, configuration factor
  // B-4].
  const double x = half / far, r = std::hypot(1, x);
  const double share = 4 / std::numbers::pi * (x / r) * std::atan(x / r);
  const double radiance = 1 / (std::numbers::pi * share);
  return {(1 + far) * vector_of(d),
          half * up,
          half * vector_of(across),
          {radiance, radiance, radiance}};
}

scene::EnvironmentLight sky_and_sun() {
  scene::EnvironmentLight sky;
  sky.map.width = 256, sky.map.height = 128;
  const Direction sun = scene::EnvironmentLight::into_map(direction(upper_right));
  double irradiance = 0;
  for (std::size_t j = 0; j < sky.map.height; ++j)
    for (std::size_t i = 0; i < sky.map.width; ++i) {
      const double theta = sky.map.theta(static_cast<double>(j) + 0.5);
      const Direction d = direction(theta, sky.map.phi(static_cast<double>(i) + 0.5));
      const double l = dot(d, sun) > std::cos(6 * degree) ? 20.0
                       : d.z > 0                          ? 0.22 - 0.1 * d.z
                                                          : 0.05;
      const auto value = static_cast<float>(l);
      sky.map.radiance.push_back({value, value, value});
      irradiance += l * std::max(dot(d, sun), 0.0) * std::sin(theta);
    }
  const double texel = std::numbers::pi / static_cast<double>(sky.map.height);
  sky.scale = 1 / (irradiance * texel * texel);
  return sky;
}

const scene::Lighting& lighting(std::size_t light) {
  static const auto all = [] {
    std::vector<scene::Lighting> made;
    for (const auto& l : wide_lights()) made.emplace_back(l.scene, nullptr);
    return made;
  }();
  return all.at(light);
}

}  // namespace

Sphere::Sphere(std::size_t pixels, std::span<const Direction> towards)
    : lit_(towards, pixels), columns_(columns_of(lit_.points)) {}

void Sphere::draw(const Surface& s, double exposure, std::span<unsigned char> rgba) const {
  const auto f = values(s, lit_.points, columns_);
  Channels radiance(f.size(), std::vector<double>(lit_.inside.size()));
  for (std::size_t c = 0; c < f.size(); ++c) {
    for (std::size_t i = 0; i < lit_.points.size(); ++i)
      radiance[c][lit_.points[i].pixel] += static_cast<double>(f[c][i]) * lit_.points[i].at.wi.z;
    for (std::size_t i = 0; i < lit_.inside.size(); ++i)
      if (!lit_.inside[i]) radiance[c][i] = beside;
  }
  paint(radiance, exposure, false, rgba);
}

SphereDifference Sphere::difference(const Surface& s,
                                    const Surface& reference,
                                    double exposure) const {
  constexpr std::size_t step = 7;  // of odd rows and columns alike
  std::vector<DirectionPair> at;
  for (std::size_t i = 0; i < lit_.points.size(); i += step) at.push_back(lit_.points[i].at);
  const Channels a = s(at), b = reference(at);
  const auto radiance = [&](const Channels& f, std::size_t i) {
    Rgb l;
    for (std::size_t c = 0; c < 3; ++c) l[c] = f[f.size() == 3 ? c : 0][i] * at[i].wi.z;
    return l;
  };
  std::vector<double> all;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (const double d = displayed_difference(radiance(a, i), radiance(b, i), exposure);
        std::isfinite(d))
      all.push_back(d);
  if (all.empty()) return {};
  const double covered = static_cast<double>(all.size()) / static_cast<double>(at.size());
  return {median(all), quantile(all, 0.95), covered};
}

const std::vector<WideLight>& wide_lights() {
  static const auto all = [] {
    std::vector<WideLight> made;
    made.push_back({"softbox", {}});
    made.back().scene.lights.emplace_back(softbox(1, 2));
    made.push_back({"sky and sun", {}});
    made.back().scene.lights.emplace_back(sky_and_sun());
    return made;
  }();
  return all;
}

WideSphere::WideSphere(std::size_t pixels, std::size_t light)
    : lights_(lighting(light)), pixels_(pixels) {
  for (std::size_t i = 0; i < pixels * pixels; ++i)
    if (const auto frame = sphere_frame(pixels, i)) points_.push_back({i, *frame});
}

std::size_t WideSphere::gather(const Surface& s) {
  // A pass takes, of each pixel's points, one far from that of the pass before; all passes take
  // them all.
  const scene::Part part{done_ * 25 % passes, passes};
  const auto widths = widths_of(s);
  std::vector<LitPoint> points;
  std::vector<double> weights;
  std::vector<scene::Incident> light;
  sums_.resize(s.channels(), std::vector<double>(pixels_ * pixels_));
  for (const auto& [pixel, frame] : points_) {
    Draws draw(pixel);
    light.clear();
    lights_.incident(vector_of(frame.z), frame, towards_viewer, widths, 1, draw, light, part);
    for (const auto& l : light) {
      points.push_back({pixel, {frame.inside(l.direction), frame.inside(towards_viewer)}});
      weights.push_back(l.weight[0]);  // these lights are grey
    }
  }
  const auto f = values(s, points, columns_of(points));
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!std::isnan(f[c][i]))
        sums_[c][points[i].pixel] += static_cast<double>(f[c][i]) * weights[i];
  return ++done_;
}

Channels WideSphere::radiance() const {
  Channels mean(sums_.size(), std::vector<double>(pixels_ * pixels_, beside));
  for (std::size_t c = 0; c < mean.size(); ++c)
    for (const auto& p : points_) mean[c][p.pixel] = sums_[c][p.pixel] / static_cast<double>(done_);
  return mean;
}

}  // namespace gonio::explore
