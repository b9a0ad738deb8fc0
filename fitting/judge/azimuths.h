#pragma once
/// \file
/// Harmonics of azimuths, which a model that is the same all round leaves of a surface that is not.

#include <array>
#include <vector>

#include "fitting/judge/left_over.h"

namespace gonio::misfit {

/// Azimuths that residuals may follow: of the half vector, the light and the detector, and from light to detector.
enum class Azimuth { half_vector, light, detector, between };
inline constexpr std::array azimuths{Azimuth::half_vector, Azimuth::light, Azimuth::detector,
                                     Azimuth::between};

/// Harmonics of one azimuth from the first to the fourth, or one of them.
struct Harmonics {
  Azimuth of;
  int first = 1, last = 4;
};
/// Their values; of the half vector's second also times a function of θ_h, as an anisotropic highlight follows it.
std::vector<double> values_of(const Harmonics&, const Unit&);

}  // namespace gonio::misfit
