#pragma once
/// \file
/// Where a fit begins.

#include "brdf/model.h"
#include "fitting/accumulate.h"
#include "fitting/solve.h"

namespace gonio {

/// Computed from the data: kd from the dim samples of each channel, then short fits of a thinned
/// table from a ladder of widths and reflectances, the best of which is the start.
/// \param values  fixed values where they are fixed
/// \return        values for all slots
std::vector<double> find_start(const Model&,
                               const FitData& thin,
                               const FreeSlots&,
                               const Objective&,
                               const Bounds&,
                               std::vector<double> values);

}  // namespace gonio
