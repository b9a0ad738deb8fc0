#pragma once
/// \file
/// How much of the light that comes in goes out again, as far as a table's samples say.

#include <vector>

#include "table/health.h"

namespace gonio {

/// Grids: at θ_i = 0, 15, 30, 45, 60 and 75°, by quadrature over the interpolated table.
/// Lists: at each incident direction whose samples leave less than a twentieth of the cosine-weighted
/// hemisphere further than 12° away, every place taking its nearest sample's value, unless one sample
/// then makes more than a tenth of the sum: a peak between samples that far apart cannot be integrated.
/// An image slice holds no hemisphere: empty.
std::vector<AlbedoSample> directional_albedo(const Table&);

}  // namespace gonio
