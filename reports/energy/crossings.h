#pragma once
/// \file
/// Roughnesses from which on a loss exceeds a share.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "reports/energy/energy.h"

namespace gonio {

inline constexpr std::array crossing_shares{0.01, 0.05, 0.1};

/// Places where `loss`, at ascending roughnesses, exceeds each share.  Between two of them it is taken to follow a power
/// of the roughness; the error is what twice the step would change.
std::vector<Crossing> crossings_at(double mu,
                                   std::span<const double> roughness,
                                   std::span<const double> loss);
/// Crossings at mu 1, 0.5, 0.1 and on average (mu 0), where there are losses.
/// \param gather  (mu, add): calls add(roughness, loss) by ascending roughness
std::vector<Crossing> gather_crossings(
    const std::function<void(double mu, const std::function<void(double, double)>& add)>& gather);

}  // namespace gonio
