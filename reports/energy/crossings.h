#pragma once
/// \file
/// Roughnesses from which on a loss exceeds a share.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "integrate/albedo/ggx_albedo.h"
#include "reports/energy/energy.h"

namespace gonio {

/// Goal of an albedo that crossings are solved from.
inline constexpr Goal fine_goal{1e-6, 400'000};

inline constexpr std::array crossing_shares{0.01, 0.05, 0.1};

/// Loss at a roughness, with the most that it is off by.
using LossAt = std::function<Bounded(double roughness)>;

/// Places where a loss exceeds each share.  Those between two roughnesses are solved for, by TOMS 748, to 1e-5; the
/// error is half of what is left of the bracket, and what the loss's own error moves it by.
/// \param loss  known at these ascending roughnesses: a share lies between two of them at most once
std::vector<Crossing> crossings_at(double mu,
                                   std::span<const double> roughness,
                                   std::span<const double> loss,
                                   const LossAt& at);

/// Losses by ascending roughness.
struct KnownLosses {
  std::vector<double> roughness, loss;
};
/// Crossings at mu 1, 0.5, 0.1 and on average (mu 0), where losses are known; both are asked in parallel.
std::vector<Crossing> gather_crossings(
    const std::function<KnownLosses(double mu)>& known,
    const std::function<Bounded(double mu, double roughness)>& at);

}  // namespace gonio
