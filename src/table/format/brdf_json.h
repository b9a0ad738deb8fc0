#pragma once
/// \file
/// BRDFs in JSON: those of Europe's metrology institutes, and those of OpenMATERIAL 3D.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// True where JSON begins that has the keys of either.
bool is_brdf_json(std::string_view head);
bool is_xompt(std::string_view head);

/// New form: data.variables names the columns of data.values, theta_i, phi_i, theta_r, phi_r (deg or rad) and BRDF [1/sr] among them;
/// rows that differ in wavelength_i [nm] only are one sample.  Old form: data has wavelengths [nm], and theta_i, phi_i, theta_v, phi_v
/// [degrees] of each geometry; a row of data.data has the values of a wavelength, which may stand before them, or of a geometry: its
/// length tells.
///
/// Channels are named by their wavelength, or "f".  A negative zenith angle lies on the other side of the plane.  Geometries of
/// polarised light are samples of their own, and a warning counts them.  What the head or the metadata says is in the notes.
/// [EMPIR 16NRM08 BiRD; PTB and partners]
Table read_brdf_json(InputFile&);

/// OpenMATERIAL 3D: brdf.lookupTable has rows of wavelength [m], θ_i, θ_o, φ_o − φ_i [rad] and f [1/sr].  [ASAM OpenMATERIAL 3D 1.0]
Table read_xompt(InputFile&);

}  // namespace gonio
