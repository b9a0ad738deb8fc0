#include "fitting/judge/azimuths.h"

#include <cmath>

namespace gonio::misfit {

std::vector<double> values_of(const Harmonics& harmonics, const Unit& unit) {
  const auto& [l, v] = unit.at;
  const auto angle = [&] {
    switch (harmonics.of) {
      case Azimuth::half_vector:
        return std::atan2(l.y + v.y, l.x + v.x);
      case Azimuth::light:
        return std::atan2(l.y, l.x);
      case Azimuth::detector:
        return std::atan2(v.y, v.x);
      case Azimuth::between:
        break;
    }
    return std::atan2(l.x * v.y - l.y * v.x, l.x * v.x + l.y * v.y);
  };
  const double phi = angle();
  constexpr int of_a_line = 2;
  std::vector<double> all;
  for (int k = harmonics.first; k <= harmonics.last; ++k) {
    const double c = std::cos(k * phi), s = std::sin(k * phi);
    all.insert(all.end(), {c, s});
    const double h = unit.functions[1];
    if (harmonics.of == Azimuth::half_vector && k == of_a_line)
      all.insert(all.end(), {c * h, s * h, c * h * h, s * h * h});
  }
  return all;
}

}  // namespace gonio::misfit
