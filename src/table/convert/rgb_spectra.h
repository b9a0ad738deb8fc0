#pragma once
/// \file
/// Spectra in place of linear sRGB, for renderers that read nothing else.

#include <array>
#include <cstddef>

namespace gonio {

inline constexpr std::size_t rgb_bands = 16;
/// Middle of a band [nm]: 400 to 700 by 20; the first and last hold for all beyond.
inline constexpr double rgb_band_nm(std::size_t band) {
  return 400 + 20 * static_cast<double>(band);
}

/// Reflectance at each band of red, green and blue: linear between bands, their colours under D65 are those of linear sRGB
/// (optics/spectrum.h, waveband_colours()) within 1e-4, they add up to 1, so that white stays white, and none is below 0.  Of all
/// such the smoothest: least Σ (second differences)².
inline constexpr std::array<std::array<double, 3>, rgb_bands> rgb_spectra{{
    {0.1891, 0, 0.8109},
    {0.0958, 0, 0.9042},
    {0.0118, 0, 0.9882},
    {0, 0, 1},
    {0, 0.2670, 0.7330},
    {0, 0.7413, 0.2587},
    {0, 1, 0},
    {0, 1, 0},
    {0, 1, 0},
    {0.1471, 0.7791, 0.0738},
    {0.7843, 0.2146, 0.0011},
    {1, 0, 0},
    {1, 0, 0},
    {1, 0, 0},
    {1, 0, 0},
    {1, 0, 0},
}};

}  // namespace gonio
