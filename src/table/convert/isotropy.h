#pragma once
/// \file
/// Whether a table changes as its surface is turned about the normal.

#include <optional>

#include "table/table.h"

namespace gonio {

/// Σ |f − f'| / Σ (f + f')/2 over pairs of values at the same θ_i, θ_o and φ_o − φ_i, and different φ_i; channels averaged.
/// Between the samples, where the format says what lies there, by turns of 45° and 90°; else of samples that agree to 0.05°.
/// Absent where no two values are to be compared, as in grids.
std::optional<double> change_with_azimuth(const Table&);

}  // namespace gonio
