#pragma once
/// \file
/// Where a fit begins.

#include "brdf/model/model.h"
#include "fitting/solve/accumulate.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// Computed from the data: kd from the dim samples of each channel; a ladder of widths, each with the
/// best of a few reflectances; short fits of a thinned table from the best rungs, the best of which is
/// the start.
/// \param values  fixed values where they are fixed
/// \return        values for all slots
template <class F>
std::vector<double> find_start(const Model&,
                               const FitData<F>& thin,
                               const FreeSlots&,
                               const Bounds&,
                               std::vector<double> values);

}  // namespace gonio
