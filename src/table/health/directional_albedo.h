#pragma once
/// \file
/// Share of the incoming light that goes out again, as far as a table's samples say.

#include <vector>

#include "table/health/health.h"

namespace gonio {

/// At one θ_i (φ_i = 0), of a grid or where Table::between says f: by quadrature over f between
/// samples.
AlbedoSample directional_albedo(const Table&, double theta_i_deg);

/// Grids, and lists with Table::between: at θ_i = 0, step, 2 step … below 90°, likewise.
/// Other lists: at each incident direction whose samples, mirrored where they go half round, leave less than a twentieth of the
/// cosine-weighted hemisphere further than 12° away, by quadrature over what is interpolated between samples along θ_h, unless
/// its error is then more than a third of it: a peak between samples that far apart cannot be
/// integrated.
/// An image slice holds no hemisphere: empty.
std::vector<AlbedoSample> albedo_curve(const Table&, double step_deg);
/// By 15°.
std::vector<AlbedoSample> directional_albedo(const Table&);

}  // namespace gonio
