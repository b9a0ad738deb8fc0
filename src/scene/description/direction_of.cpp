// Apart from the reading of scenes: a page's lights need no more of them.
#include <cmath>

#include "scene/description/scene.h"

namespace gonio::scene {

Direction direction_of(double elevation_deg, double azimuth_deg) {
  const double e = elevation_deg * degree, a = azimuth_deg * degree;
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

}  // namespace gonio::scene
