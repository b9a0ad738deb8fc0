#pragma once
/// \file
/// Short descents inside bounds, for the many small problems of a search: Levenberg and Marquardt's
/// steps, each from one pass over the samples.

#include <span>
#include <vector>

#include "fitting/solve/solve.h"

namespace gonio {

struct DescentOptions {
  int max_passes = 20;
  double tolerance = 1e-6;  ///< of the cost: it ends before a step that promises less
};

struct Descent {
  double cost = 0;  ///< infinite where it was not finite at the start
  int passes = 0;
  bool settled = false;  ///< no step promises more than the tolerance
};

/// An unknown with an origin changes its distance from it by no more than a factor of 3 in a step: where
/// the cost is far from quadratic, Gauss and Newton's steps lead out of the valley that they begin in.
///
/// Unknowns at a bound that are pushed outwards stay there for that step; a step ends at the first
/// bounds that it meets, and the rest of it is solved for anew.
/// \param x  where to begin; the lowest point seen, after it
/// \param origins  NaN where an unknown has none; empty: none has
Descent descend(const NormalEquationsAt&,
                std::vector<double>& x,
                const Bounds&,
                const DescentOptions& = {},
                std::span<const double> origins = {});

}  // namespace gonio
