#pragma once
/// \file
/// RGL's material database: tensor files with a BRDF on grids that follow its facets' distribution.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

bool is_rgl(std::string_view head);

/// Table of a file that holds, for each incident direction, f cos θ_o · 4σ(wi)/D(m) (the factor only
/// where `jacobian` is 1) on a grid s over the unit square.  s becomes the facet normal m by the
/// inverse of the marginal and then conditional distribution of the density `vndf`, which is bilinear
/// on its grid over (√(2 θ_m/π), φ_m/2π + ½); in an isotropic file, one of at most two phi_i, φ_m
/// counts from φ_i.  Densities of neighbouring incident directions are mixed linearly in θ_i and φ_i.
/// That the cosine is in the values the material shows: with it divided out, reciprocity holds and
/// the directional albedos are the database's.
///
/// The samples are the grid points, each direction once: φ_m = ±π is two grid points, θ_m = 0 a whole
/// column, of which the sample is the mean, θ_i = 0 all φ_i.  Those below the horizon stay and are
/// masked, so are negative values (outside the RGB gamut, or noise) and those too near the horizon to
/// divide (least_cosine).  Isotropic files are read at φ_i = 0.  Channels: r, g, b, or the wavelengths
/// [nm] as numbers.
/// Table::between is the format's own evaluation, guarded near the horizon
/// (table/format/rgl/function.h); a file over half or a quarter of φ_i is symmetric under a half turn,
/// or mirrored.
/// [Dupuy and Jakob 2018, doi:10.1145/3272127.3275059]
Table read_rgl(InputFile&);

/// The file of a table that read_rgl() or rgl_table() made, with the `luminance` that renderers draw by: Rec. 709's of r, g, b,
/// the mean of wavelengths.  Little is lost where a renderer's random numbers are few: it is the density of f cos θ_o itself.
void write_rgl(const Table&, OutputFile&, const std::string& path);

}  // namespace gonio
