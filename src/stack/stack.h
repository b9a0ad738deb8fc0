#pragma once
/// \file
/// Stack: registered images of one surface, each under its own light and from its own side; gonio.stack/1 resolved.  The map's frame: x
/// to the right, y upwards in the image, z towards the viewer of the flat surface.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/names.h"
#include "geometry/direction.h"
#include "geometry/half_difference.h"
#include "geometry/vector.h"

namespace gonio {

/// Which of an image's two directions.
enum class Side { light, view };

/// Direction of all texels by its angles, as everywhere in gonio.
template <Side>
struct SideAngles {
  double theta_deg = 0;  ///< from the normal, in [0, 90)
  double phi_deg = 0;    ///< from x towards y
};
/// Direction of all texels as a vector of any length but 0.
template <Side>
struct SideVector {
  Vector towards{0, 0, 1};
};
/// Direction of each texel: an image of three channels, X, Y, Z or R, G, B, the vector's components at any length but 0.
template <Side>
struct SideMap {
  std::string path;
};
/// Place of a lamp, or a camera, that is so near that its direction is another one at each texel: from the middle of the image, x to the right, y upwards
/// in it, z above the flat surface, in the unit of Stack::width.
template <Side>
struct SidePosition {
  Vector at{0, 0, 1};
};
template <Side side>
using Towards = std::variant<SideAngles<side>, SideVector<side>, SideMap<side>, SidePosition<side>>;

/// Direction of all texels; no value where each has its own.
template <Side side>
std::optional<Direction> direction_of(const Towards<side>& towards) {
  if (const auto* angles = std::get_if<SideAngles<side>>(&towards))
    return direction(angles->theta_deg * degree, angles->phi_deg * degree);
  if (const auto* vector = std::get_if<SideVector<side>>(&towards))
    return direction(vector->towards);
  return std::nullopt;
}

struct StackImage {
  std::string path;
  Towards<Side::light> light;
  Towards<Side::view> view;
  double scale =
      1;  ///< what its numbers are multiplied with: of a lamp with a position those in the middle
};

/// Quantity that the images hold, linear [1/sr].
enum class StackValues {
  f_r,        ///< the reflectance, as everywhere in gonio
  f_r_cosine  ///< times n·l: what a camera sees of a surface under a light of irradiance 1; of a
              ///< near lamp that is so in the middle
};
template <>
inline constexpr std::array<std::string_view, 2> names_of<StackValues>{"f_r", "f_r_cosine"};

/// What a synthetic stack was made from.
struct StackTruth {
  std::string model;
  std::string parameters;  ///< path of an image with a channel for each of them
  double noise = 0;        ///< σ of the multiplicative noise exp(σ z)
  std::uint64_t seed = 0;
};

struct Stack {
  std::string path;  ///< of its file; others are relative to that one's folder
  StackValues values = StackValues::f_r;
  std::optional<std::vector<std::string>>
      channels;  ///< of each image, one or three; none: R, G, B, or the only one
  std::optional<std::string> normals;  ///< path of an image as that of SideMap; none: all are z
  std::optional<double> width;         ///< of the surface in the images, in the unit of positions
  std::optional<std::string>
      heights;  ///< path of an image of the surface's heights, in that unit; none: it is flat
  /// Numbers of the images, before they are scaled: from the one on a value is clipped light, up to the other it is a shadow or the camera's noise.
  /// Both are left out; none: none is.
  std::optional<double> saturation, floor;
  /// Paths of two photographs by the same camera: one without light, whose numbers are in all others, and one of a white sheet under even light.
  std::optional<std::string> dark, flat;
  bool linear = false;  ///< images in PNG and TIFF are light, whatever they say of themselves
  std::vector<StackImage> images;
  std::optional<StackTruth> truth;

  /// Path of a file that the stack names.
  std::string path_of(const std::string& name) const;
};

/// Directions in the frame of a texel's normal, whose tangent is the map's x less its part along the normal.
DirectionPair within(const DirectionPair&, const Direction& normal);

/// Stack of a file; the images are not opened.  Whatever is wrong is bad_input: the file, the place as a JSON pointer [RFC 6901], what was
/// found and what is expected there.
Stack read_stack(const std::string& path);
std::string to_json(const Stack&);
/// JSON Schema of such a file.
std::string stack_schema();

}  // namespace gonio
