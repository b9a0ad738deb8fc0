#pragma once
/// \file
/// The parts of energy_report(), each filling its own.

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "reports/energy.h"

namespace gonio {

/// Where crossings are looked for; 0 is the average.
inline constexpr std::array crossing_mu{1.0, 0.5, 0.1, 0.0};
inline constexpr std::array crossing_shares{0.01, 0.05, 0.1};

void add_forms(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
void add_materials(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
void add_estimators(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
void add_light(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
/// Costs of the compensations beside their errors; after the materials.
void add_costs(EnergyReport&);
/// From what the others have filled in.
void add_findings(EnergyReport&);

}  // namespace gonio
