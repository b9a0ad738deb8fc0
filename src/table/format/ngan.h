#pragma once
/// \file
/// MIT CSAIL's anisotropic measurements (Ngan, Durand and Matusik 2005, EGSR, doi:10.2312/EGWR/EGSR05/117-126): sixteen int32, then a
/// plane of float32 for each of red, green and blue, all little-endian; θ_i slowest, then θ_o, φ_diff, φ_i.
///
/// In the header 0 to 3 are the bins of θ_i, θ_o, φ_diff, φ_i; 6 is 1 (these angles), 7 is 0 (even bins), 9 says whether φ_diff = φ_o − φ_i
/// covers π (1) or 2π (0), 10 is 3 (channels).  θ covers [0, π/2], φ_i 2π from the surface's tangent, towards the light; the mirror direction is
/// at φ_diff = π.  Values are f_r without the cosine, negative where nothing was measured.  No real file was at hand: layout as Disney's BRDF
/// Explorer (wdas/brdf, f39eb38) has it.  It counts φ_i from the other end of the tangent, and draws ten times the values: their
/// scale is not confirmed, nor that a sample sits in its bin's centre, which is assumed.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// \param head  the first bytes
bool is_ngan(std::string_view head);
/// A list of the bins' centres.  Of more bins than a table holds, evenly spaced φ_i are kept, as many as fit, with a warning.
Table read_ngan(InputFile&);

}  // namespace gonio
