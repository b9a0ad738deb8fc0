#pragma once
/// \file
/// Claims on distributions and on sums over the hemisphere.  For this room only.

#include "reports/energy/energy.h"

namespace gonio {

/// Blinn–Phong from Beckmann, with the exponent 2α⁻² − 2.
std::vector<ClaimRows::Apart> phong_from_beckmann();
/// Adds the verdicts.
void judge_distributions_and_sums(Findings&, const EnergyRows&);

}  // namespace gonio
