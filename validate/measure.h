#pragma once
/// \file
/// Measurements of the budgets of a choice.

#include <optional>
#include <string>
#include <vector>

#include "validate/search.h"
#include "validate/validate.h"

namespace gonio::validating {

/// Directional albedo at F as it is, by channel: [mu][channel].
std::vector<std::vector<double>> albedos(const BoundModel&,
                                         Bounces,
                                         std::span<const double> mu,
                                         const Effort& = {});

/// The same of a choice's side, its coat and its scattering as that says.  \param b  of its spec()
std::vector<std::vector<double>> albedos(const Shipped&,
                                         const BoundModel& b,
                                         std::span<const double> mu,
                                         const Effort& = {});

BudgetCheck check_albedo_error(const Choice&,
                               const Effort&,
                               const std::function<void(double)>& done);
BudgetCheck check_delta_e(const Choice&, const Effort&, const std::function<void(double)>& done);
BudgetCheck check_energy_gain(const Choice&,
                              const Effort&,
                              const std::function<void(double)>& done);
BudgetCheck check_energy_loss(const Choice&,
                              const Effort&,
                              const std::function<void(double)>& done);
BudgetCheck check_fresnel_error(const Choice&);
BudgetCheck check_reciprocity(const Choice&,
                              const Effort&,
                              const std::function<void(double)>& done);
BudgetCheck check_nonfinite(const Choice&);
BudgetCheck check_operations(const Choice&);
BudgetCheck check_table_bytes(const Choice&);
BudgetCheck check_time(const Choice&);

/// Check of one budget that a choice has.
struct NamedCheck {
  const char* what;
  std::function<BudgetCheck(const std::function<void(double)>& done)> check;
};
/// Those of all, the cheapest first.  \param choice  outlives them
std::vector<NamedCheck> checks_of(const Choice& choice, const Effort& = {});

}  // namespace gonio::validating
