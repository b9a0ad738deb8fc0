#pragma once
/// \file
/// Claims on what forms cost.  For this room only.

#include "reports/cost/cost.h"

namespace gonio {

/// Fifth powers as Schlick's form takes them, by `pow` and by multiplication: points of the picture "power".
std::vector<CostPoint> power_points(const TimingOptions&);
/// Adds the verdicts.
void judge_costs(Findings&, const CostRows&);

}  // namespace gonio
