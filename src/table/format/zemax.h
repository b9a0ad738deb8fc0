#pragma once
/// \file
/// Tabulated BSDF of Zemax OpticStudio, which imaging spheres and goniometers write, too.

#include <string_view>
#include <vector>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// True where a text begins, after its comments (#), with one of Zemax's keywords and what that may say.
bool is_zemax(std::string_view head);

/// The axes of a file [degrees], each ascending.
struct ZemaxAxes {
  std::vector<double> rotation{
      0};  ///< of the sample about its normal: the light's azimuth is its negative
  std::vector<double> incident;  ///< zenith angle of the light, and of the mirror direction
  std::vector<double> azimuth;   ///< about the mirror direction, 0 towards the normal,
                                 ///< counter-clockwise as seen from outside
  std::vector<double> radius;    ///< angle from the mirror direction
};
/// Direction that lies `radius` from the mirror direction, for light from azimuth 0 [degrees in]:
/// > wo = cos r m + sin r (cos a n + sin a m × n), m = (−sin θ, 0, cos θ), n = (cos θ, 0, sin θ).
Direction zemax_direction(double incident_deg, double azimuth_deg, double radius_deg);

/// f [1/sr, without the cosine] at the file's directions above the horizon; radius 0 and azimuth 360° count once.  Channels are f, or
/// X, Y, Z where the file holds CIE's tristimulus values.  Table::between is linear over angle of incidence, azimuth and
/// radius, and NaN outside of them.  The file's own integrals (TIS) stand in the notes beside those of its values by between; a
/// warning says where they differ by more than a tenth.
/// BTDF is refused.
/// [Zemax, "BSDF data interchange file format specification"]
Table read_zemax(InputFile&);

/// Axes for a table: its own where it is a list of at most 64 incident angles, else each 10° to 80°; radii close to the mirror direction
/// first.
ZemaxAxes zemax_axes(const Table&);
/// Directions of a file with these axes, those below the horizon and the repeated ones left out.
DirectionList zemax_directions(const ZemaxAxes&);
/// Sets Table::between of a table of those directions.
void interpolate_zemax(Table&);
/// A table of zemax_directions(zemax_axes()): PlaneSymmetrical, with the integral of its values as TIS.
void write_zemax(const Table&, OutputFile&, const std::string& path);

}  // namespace gonio
