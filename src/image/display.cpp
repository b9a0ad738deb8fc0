#include "image/display.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

std::array<unsigned char, 3> displayed_bytes(const Rgb& radiance, double exposure) {
  const Rgb c = displayed(radiance, exposure);
  return {srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2])};
}

Lab lab_of_display(const Rgb& c) {
  static const Rgb white = xyz_of_srgb({1, 1, 1});
  return lab(xyz_of_srgb(c), white);
}
Lab lab_of_albedo(std::span<const double> albedo) {
  return lab_of_display({albedo.front(), albedo[albedo.size() / 2], albedo.back()});
}

double displayed_difference(const Rgb& radiance, const Rgb& reference, double exposure) {
  const Rgb a = displayed(reference, exposure), b = displayed(radiance, exposure);
  const double d = a == b ? 0 : delta_e_2000(lab_of_display(a), lab_of_display(b));
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

double difference_in_light(const Rgb& radiance, const Rgb& reference, double exposure) {
  constexpr double white = 203;
  const auto of = [&](Rgb c) {
    for (double& v : c) v *= white * exposure;
    return itp(c);
  };
  const double d = delta_e_itp(of(radiance), of(reference));
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

Rgb colour_of_channels(const std::vector<std::string>& channels, std::span<const double> values) {
  if (channels == std::vector<std::string>{"r", "g", "b"}) return {values[0], values[1], values[2]};
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return {mean, mean, mean};
}

}  // namespace gonio
