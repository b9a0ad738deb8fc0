#pragma once
/// \file
/// The parts of energy_report(), each filling its own.

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "reports/energy/energy.h"

namespace gonio {

inline constexpr std::array crossing_shares{0.01, 0.05, 0.1};

/// Where `loss`, at ascending roughnesses, exceeds each share.  Between two of them it is taken to follow a power
/// of the roughness; the error is what twice the step would change.
std::vector<Crossing> crossings_at(double mu,
                                   std::span<const double> roughness,
                                   std::span<const double> loss);
/// The same at mu 1, 0.5, 0.1 and on average (mu 0), where there are losses.
/// \param gather  (mu, add): calls add(roughness, loss) by ascending roughness
std::vector<Crossing> gather_crossings(
    const std::function<void(double mu, const std::function<void(double, double)>& add)>& gather);

/// The form of that name; nullptr if it was not looked at.
const EnergyForm* find_form(const EnergyReport&, std::string_view name);
/// Where it reflects most.
const EnergyForm::At& brightest(const EnergyForm&);
/// Whether it reflects more than comes in there, beyond its error.
bool makes_light(const EnergyForm&);
/// "59.1 %"
std::string percent(double share);

void add_forms(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
void add_materials(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
void add_estimators(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
void add_light(EnergyReport&, const EnergyOptions&, const std::function<void(double)>& done);
/// Costs of the compensations beside their errors; after the materials.
void add_costs(EnergyReport&);
void add_albedo_forms(EnergyReport&);
/// What is in circulation on highlights and energy; after the forms.
void judge_claims(EnergyReport&);
/// From what the others have filled in.
void add_findings(EnergyReport&);

}  // namespace gonio
