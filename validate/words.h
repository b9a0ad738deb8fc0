#pragma once
/// \file
/// Words of a validation.

#include <string>
#include <string_view>

#include "validate/validate.h"

namespace gonio {

/// "Directional albedo off the reference's"
std::string_view title_of(std::string_view budget);
/// Value of a budget as people write it: "0.012", "24 operations", "1.3 times the baseline".
std::string value_text(std::string_view budget, double value);
/// "roughness 1, mu 0.05, gold"
std::string place_text(const BudgetCheck&);
/// "The directional albedo is off by 0.12 at roughness 1, mu 0.05; the budget is 0.05."
std::string sentence(const BudgetCheck&);
/// "0.5", "0.8, 0.4, 0.2, default", "from the domain"
std::string value_text(const UsedParameter&);

}  // namespace gonio
