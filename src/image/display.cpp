#include "image/display.h"

#include <algorithm>

#include "optics/spectrum.h"

namespace gonio {

Rgb displayed(const Rgb& radiance, double exposure) {
  Rgb c = radiance;
  for (double& v : c) v = std::clamp(v * exposure, 0.0, 1.0);
  return c;
}

Lab lab_of_display(const Rgb& c) {
  static const Rgb white = xyz_of_srgb({1, 1, 1});
  return lab(xyz_of_srgb(c), white);
}

}  // namespace gonio
