#pragma once
/// \file
/// What is left between a model and a table.

#include "brdf/model.h"
#include "fitting/data.h"
#include "table/fit_document.h"

namespace gonio {

/// RMS over all values and per band of theta_i, theta_h and theta_d.
FitResiduals residual_statistics(const BoundModel&, const FitData&);

}  // namespace gonio
