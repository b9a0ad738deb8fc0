#pragma once
/// \file
/// Check of a fitted model as physics: the light that it returns, and how high it rises.

#include "fitting/result/document.h"
#include "fitting/sample/data.h"
#include "table/health/facts.h"

namespace gonio {

/// Directional albedos at the incident angles at which the table's own are known, else by 15°, and the
/// greatest value at the table's samples over the greatest there.
/// \param thin  a thinned table, of which the greatest values are taken
Physics check_physics(const BoundModel&, TableFacts&, const FitData<double>& thin);

}  // namespace gonio
