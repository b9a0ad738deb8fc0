#include "image/display.h"

#include <algorithm>
#include <cmath>

#include "optics/spectrum.h"

namespace gonio {

Rgb displayed(const Rgb& radiance, double exposure) {
  Rgb c = radiance;
  for (double& v : c) v = std::clamp(v * exposure, 0.0, 1.0);
  return c;
}

unsigned char srgb_byte(double linear) {
  const double x = linear < 1 ? std::max(linear, 0.0) : 1;
  const double v = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255 * v));
}

Lab lab_of_display(const Rgb& c) {
  static const Rgb white = xyz_of_srgb({1, 1, 1});
  return lab(xyz_of_srgb(c), white);
}

}  // namespace gonio
