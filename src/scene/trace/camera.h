#pragma once
/// \file
/// Rays of a camera, and the cameras of a view.

#include "base/random.h"
#include "geometry/direction.h"
#include "geometry/vector.h"
#include "scene/description/scene.h"

namespace gonio::scene {

struct Ray {
  Vector origin;
  Direction direction;
};

/// Rays of a camera through the points of its picture.
class Rays {
 public:
  /// \param aspect  width/height
  Rays(const Camera&, double aspect);
  /// \param x, y  in [0, 1], from the picture's left and from its top
  Ray operator()(double x, double y) const;

 private:
  Vector origin_, corner_, right_, down_;  ///< the picture at a distance of 1
};
inline Ray ray(const Camera& c, double x, double y, double aspect) {
  return Rays(c, aspect)(x, y);
}

/// Part of a picture, x and y in [0, 1].
struct PicturePart {
  double x = 0, y = 0, width = 1, height = 1;

  double area() const { return width * height; }
  bool holds(double at_x, double at_y) const {
    return at_x >= x && at_x <= x + width && at_y >= y && at_y <= y + height;
  }
};
/// Rectangle of a camera's picture that a sphere is seen in.
PicturePart part_around(const Camera&, double aspect, const Vector& center, double radius);

/// Camera of an orbit.  Above and below the target up is what it becomes on the way there.
Camera camera_of(const Orbit&, double elevation_deg, double azimuth_deg);
/// Camera in the middle of the view's ranges.
Camera middle_camera(const View&);
/// Camera drawn evenly in elevation and azimuth.
Camera draw_camera(const View&, Draws&);

}  // namespace gonio::scene
