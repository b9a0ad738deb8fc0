#pragma once
/// \file
/// From spectra of reflectance to linear RGB, and the colour of measured materials: integrated over the
/// spectrum, and by the shortcut of one wavelength per channel that renderers take.

#include <array>
#include <cstddef>

#include "optics/refractive_index.h"

namespace gonio {

inline constexpr double first_nm = 360, step_nm = 5;
inline constexpr std::size_t wavelengths = 95;  ///< up to 830 nm
/// One value per wavelength.
using Spectrum = std::array<double, wavelengths>;

/// f(nm) at every wavelength
Spectrum spectrum(auto&& f) {
  Spectrum s;
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = f(first_nm + step_nm * static_cast<double>(i));
  return s;
}

/// ∫ R(λ) D65(λ) {x̄, ȳ, z̄}(λ) dλ / ∫ D65 ȳ dλ, of the CIE's 2° observer of 1931: Y is 1 for a
/// perfect reflector.  Within 2e-4 of the sum by 1 nm for spectra as smooth as reflectance is.
std::array<double, 3> xyz(const Spectrum& reflectance);

/// Linear sRGB under D65: a perfect reflector is 1, 1, 1.  Not clipped, so colours outside the gamut
/// have channels below 0 or above 1.
///
/// The matrix has the primaries of IEC 61966-2-1 and for white what xyz() gives for 1, which differs
/// from that standard's rounded x = 0.3127, y = 0.3290 by 2e-5.
std::array<double, 3> linear_srgb(const Spectrum& reflectance);

/// Wavelength that stands for those about it, and what light of it that is reflected adds to linear sRGB.
struct Waveband {
  double nm;
  std::array<double, 3> rgb;
};
/// Bands by 20 nm from 400 to 700 nm, the first and last with all beyond: Σ R(nm) rgb is linear_srgb() of an R that is linear
/// between them, and 1, 1, 1 of R = 1.  Of the measured metals at every angle it is within 4e-3.
inline constexpr std::size_t wavebands = 16;
std::array<Waveband, wavebands> waveband_colours();

/// XYZ of linear sRGB, by the inverse of that matrix: {1, 1, 1} is the white of xyz().
std::array<double, 3> xyz_of_srgb(const std::array<double, 3>& rgb);

/// Reflectance of a smooth surface at angles of cosine c, exactly: Fresnel reflectance of every
/// wavelength, then linear_srgb().
std::array<double, 3> reflectance_rgb(const Material&, double c);
/// The shortcut: Fresnel reflectance of the index at 650, 550 and 450 nm.
std::array<double, 3> reflectance_per_channel(const Material&, double c);

}  // namespace gonio
