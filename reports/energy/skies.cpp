#include "reports/energy/skies.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/direction.h"

namespace gonio {
namespace {

constexpr std::size_t width = 256, height = 128;
constexpr double ground = 0.2;  ///< of its light that the ground under a sky sends back

/// Solid angle of a texel of row j.
double solid_angle(const Environment& e, std::size_t j) {
  const double w = static_cast<double>(e.width), y = static_cast<double>(j);
  return 2 * std::numbers::pi / w * (std::cos(e.theta(y)) - std::cos(e.theta(y + 1)));
}

Environment sky(const std::function<Rgb(const Direction&)>& radiance) {
  Environment e{width, height, {}};
  for (std::size_t j = 0; j < height; ++j)
    for (std::size_t i = 0; i < width; ++i) {
      const double theta = e.theta(static_cast<double>(j) + 0.5),
                   phi = e.phi(static_cast<double>(i) + 0.5);
      const Rgb l = radiance(direction(theta, phi));
      e.radiance.push_back(
          {static_cast<float>(l[0]), static_cast<float>(l[1]), static_cast<float>(l[2])});
    }
  return e;
}

/// Overcast sky of the CIE, three times as bright at the zenith as at the horizon:  L = (1 + 2 sin elevation)/3
Rgb overcast(const Direction& d) {
  const double l = d.z > 0 ? (1 + 2 * d.z) / 3 : ground * 7 / 9;  // E/π of that sky is 7/9
  return {l, l, l};
}

/// Blue above, white at the horizon; brown ground.
Rgb clear(const Direction& d) {
  if (d.z <= 0) return {0.16, 0.12, 0.08};
  const double up = std::sqrt(d.z);
  return {std::lerp(0.9, 0.15, up), std::lerp(0.95, 0.3, up), std::lerp(1.0, 0.8, up)};
}
/// A texel 40° above the horizon that sends four times the light of the clear sky to what faces it.
Environment with_sun() {
  auto e = sky(clear);
  double flux = 0;
  for (std::size_t j = 0; j < height / 2; ++j)
    for (std::size_t i = 0; i < width; ++i)
      flux += luminance(e.texel(i, j)) * solid_angle(e, j) *
              std::cos(e.theta(static_cast<double>(j) + 0.5));
  const auto [i, j] = e.texel_at(direction(50 * degree, 0));
  const double sun = 4 * flux / solid_angle(e, j);
  e.radiance[j * width + i] = {static_cast<float>(sun), static_cast<float>(0.95 * sun),
                               static_cast<float>(0.85 * sun)};
  return e;
}

/// Dim walls, and a window 40° wide and from the horizon to 35° above it, a hundred times as bright.
Rgb room(const Direction& d) {
  const double elevation = std::asin(d.z) / degree, azimuth = std::atan2(d.y, d.x) / degree;
  const bool window = std::abs(azimuth) < 20 && elevation > 0 && elevation < 35;
  return window ? Rgb{4.5, 5, 5.5} : Rgb{0.055, 0.05, 0.045};
}

}  // namespace

Environment even_light() {
  return sky([](const Direction&) { return Rgb{1, 1, 1}; });
}
std::vector<ReportOptions::Light> synthetic_skies() {
  return {{"overcast sky", sky(overcast)},
          {"clear sky with sun", with_sun()},
          {"room with a window", sky(room)}};
}

double exposure_for(const Environment& e) {
  double sum = 0;
  for (std::size_t j = 0; j < e.height; ++j)
    for (std::size_t i = 0; i < e.width; ++i) sum += luminance(e.texel(i, j)) * solid_angle(e, j);
  return 0.5 * 4 * std::numbers::pi / sum;
}

}  // namespace gonio
