#pragma once
/// \file
/// A sphere under directional lights, seen from far away: what its pixels ask of a BRDF, and what they then show.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/direction.h"
#include "geometry/sampling.h"
#include "image/environment.h"

namespace gonio {

/// Directional lights of equal irradiance, under one name.  Towards them, in the viewer's frame: x to the right, y up,
/// z to the viewer.
struct SphereLight {
  std::string_view name;
  std::vector<Direction> towards;
};
/// Front light: three on the viewer's side; rim light: one of these, and two from behind; flash: one 10° above the viewer.
const std::array<SphereLight, 3>& sphere_lights();

/// Where the viewer of such a sphere is.
inline constexpr Direction towards_viewer{0, 0, 1};

/// Frame of the sphere in the middle of a pixel, row by row from the top, of a picture so many pixels wide and high; none
/// beside the sphere.  Its tangent lies level, to the right where the sphere faces the viewer.
std::optional<Frame> sphere_frame(std::size_t pixels, std::size_t pixel);

/// Directions in which one light meets the surface in the middle of a pixel.
struct LitPoint {
  std::size_t pixel;  ///< row by row from the top
  DirectionPair at;
};

/// Pixels of a sphere and the light on them.  The sphere casts no shadow on itself but on its far side, so a pixel asks for
/// no more than f of one pair of directions a light.
struct LitSphere {
  static constexpr double radius = 0.96;  ///< of half a picture's width

  std::size_t pixels;            ///< width and height of the picture
  std::vector<bool> inside;      ///< of each pixel, whether its middle shows the sphere
  std::vector<LitPoint> points;  ///< those where light and viewer are above the horizon, by pixel

  LitSphere(std::span<const Direction> towards_lights, std::size_t pixels);

  /// Radiance of each pixel over the irradiance E of one light's beam; 0 where no light arrives.
  ///
  ///   L/E = Σ f cos θ_i   over the pixel's points [1/sr]
  ///
  /// \param f  of each point [1/sr]; NaN, where it is not known, makes its pixel's radiance NaN
  std::vector<Rgb> radiance(std::span<const Rgb> f) const;
};

}  // namespace gonio
