#pragma once
/// \file
/// Light from all around, as a map over latitude and longitude.

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/direction.h"

namespace gonio {

/// Linear red, green, blue.
using Rgb = std::array<double, 3>;
/// Luminance of ITU-R BT.709's primaries.
inline double luminance(const Rgb& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

/// Radiance, one value over each texel.  The point (x, y), texel (i, j) being [i, i + 1) × [j, j + 1) and
/// row 0 first, lies in the direction of
///
///   θ = π y/height from the zenith, +z,   φ = π − 2π x/width from +x towards +y
///
/// so that the map's middle is +x, and from within, upright, +y is a quarter of its width to the left of that:
/// OpenEXR's convention, whose (z, x, y) are these (x, y, z); there samples lie on the edges, here
/// texels fill them.
struct Environment {
  std::size_t width = 0, height = 0;
  std::vector<std::array<float, 3>> radiance;  ///< [j * width + i]
  std::size_t negative = 0;                    ///< values that were, and are 0

  double theta(double y) const { return std::numbers::pi * y / static_cast<double>(height); }
  double phi(double x) const { return std::numbers::pi * (1 - 2 * x / static_cast<double>(width)); }
  Rgb texel(std::size_t i, std::size_t j) const {
    const auto& l = radiance[j * width + i];
    return {double{l[0]}, double{l[1]}, double{l[2]}};
  }
  /// Numbers i, j of the texel that lies in a direction.
  std::array<std::size_t, 2> texel_at(const Direction& d) const {
    const auto index = [](double part, std::size_t n) {
      return std::min(static_cast<std::size_t>(part * static_cast<double>(n)), n - 1);
    };
    return {index((1 - phi_of(d) / std::numbers::pi) / 2, width),
            index(theta_of(d) / std::numbers::pi, height)};
  }
  Rgb operator()(const Direction& d) const {
    const auto [i, j] = texel_at(d);
    return texel(i, j);
  }
};

/// The channels R, G, B of an OpenEXR file, twice as wide as high and at most 8192 wide.  A value that is
/// infinite or not a number is refused by its place.  Negative ones, which lossy compression leaves
/// beside edges, become 0; where they take away more than 1/1000 of the light the first is refused.
Environment read_environment(const std::string& path);

}  // namespace gonio
