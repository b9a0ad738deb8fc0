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

/// Ray through a point of the picture.  \param x, y  in [0, 1], from its left and from its top  \param aspect  width/height
Ray ray(const Camera&, double x, double y, double aspect);

/// Camera of an orbit.  Above and below the target up is what it becomes on the way there.
Camera camera_of(const Orbit&, double elevation_deg, double azimuth_deg);
/// Camera in the middle of the view's ranges.
Camera middle_camera(const View&);
/// Camera drawn evenly in elevation and azimuth.
Camera draw_camera(const View&, Draws&);

/// Angle drawn evenly between both ends.
double draw_between(const std::array<double, 2>& ends, Draws&);

}  // namespace gonio::scene
