#pragma once
/// \file
/// Minimises a cost of which only the normal equations are known, inside bounds, with Ceres.

#include <functional>
#include <string>
#include <vector>

#include "fitting/solve/accumulate.h"

namespace gonio {

using NormalEquationsAt = std::function<NormalEquations(const std::vector<double>&)>;

struct Bounds {
  std::vector<double> low, high;

  /// True of a value of the i-th unknown that stands at an end of its range.
  bool at_end(std::size_t i, double x) const {
    const double near = 1e-7 * (high[i] - low[i]);
    return x <= low[i] + near || x >= high[i] - near;
  }
};

/// Way to a minimum; where it lies is in the unknowns themselves.
struct Solution {
  NormalEquations at;  ///< the normal equations there
  bool converged = false;
  int iterations = 0, passes = 0;  ///< trial steps; evaluations
  std::vector<double> cost_per_iteration;
  std::string message;
};

struct SolveOptions {
  int max_iterations = 100;
  double function_tolerance = 1e-10;
  double parameter_tolerance = 1e-10;
  /// Rounding of the cost, where the sums are those of rounded numbers: it stops where the cost is below
  /// `rounding`, or where a step fails by less than that or 1e-7 of the cost.
  double rounding = 0;
};

/// Ceres sees n + 1 residuals that have the same gradient, Gauss–Newton matrix and cost as the
/// samples themselves:  with S H S = V Λ Vᵀ, S = diag(H)^(−1/2),
///
///   J = Λ^(1/2) Vᵀ S⁻¹,   r = Λ^(−1/2) Vᵀ S g   (rows with Λ ≈ 0 left out),
///   r_(n+1) = √(2 cost − |r|²), constant
///
/// so that Jᵀr = g, JᵀJ = H and ½|r|² = cost, also where H is singular.
///
/// Ceres projects its steps onto the bounds and so creeps along them: what it leaves at a bound is held
/// there and the rest solved again, until no held unknown is pulled back inside.
///
/// The gradient of rounded numbers is worth more than their cost, whose rounding hides the last steps.
/// With `rounding` these are plain Gauss–Newton steps, until one promises less than 1e-8 of the cost:
/// a fifth of a standard error where there are millions of independent values.
/// \param x  where to begin; the minimum, after it
Solution solve(const NormalEquationsAt&,
               std::vector<double>& x,
               const Bounds&,
               const SolveOptions& = {});

}  // namespace gonio
