#pragma once
/// \file
/// Surface scattering distribution data, libbsdf's open format (KimuraRyo/libbsdf, doc/SsddFileFormatSpecification.md at eb62dc1): lines
/// "KEY value", "# " before comments, and after DATA the numbers, as lines or as little-endian float32.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// True where VERSION comes first and a DATA_TYPE soon.
bool is_ssdd(std::string_view head);

/// The block DATA_TYPE brdf; of btdf and specular ones only a note stays, for transmission and mirrors have no place in a table.  Its samples
/// are all combinations of PARAM0_LIST to PARAM3_LIST [degrees], the first fastest, by PARAM_TYPE:
///
///   spherical_coordinate_system          θ_i, φ_i, θ_o, φ_o, both directions away from the surface
///   specular_coordinate_system           θ_i, φ_i, then the angle s from the mirror direction and the azimuth φ around it, of which 0 is
///                                        towards the normal: wo is (s, φ) turned about y by −θ_i − PARAM4, then about z by φ_i
///   half_difference_coordinate_system    θ_h, φ_h, θ_d, φ_d of Rusinkiewicz, d being the light's
///
/// distorted_spherical_coordinate_system is refused: what it is has not been written down.  Without PARAM1_LIST that angle is 0.  Of a direction
/// with several names (a pole under each azimuth, 0° and 360°) the first counts.  Values are f_r [1/sr] without the cosine; what
/// REDUCTION_TYPE leaves out is not filled in.  Channels: f; r, g, b; x, y, z; or WAVELENGTH_LIST [nm].  No real file was at hand.
Table read_ssdd(InputFile&);

}  // namespace gonio
