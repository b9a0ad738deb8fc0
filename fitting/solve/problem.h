#pragma once
/// \file
/// Problem that a fit solves: which parameters are free, and within which bounds.

#include <vector>

#include "fitting/solve/accumulate.h"
#include "fitting/solve/options.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// Model, unknowns and bounds: all that a fit is asked, the samples apart.
struct Problem {
  const FitOptions& options;
  BoundModel start;  ///< fixed values in place
  FreeSlots free;
  Bounds bounds;               ///< of the free slots
  std::vector<bool> narrowed;  ///< of the free slots: whether the user gave the bounds
  double offset;
  double rounding = 0;  ///< of the cost of one value in float, see SolveOptions; 0: in double alone
};

/// A preset's name becomes its spec, with what the preset holds held: its own parameters tie those of
/// the spec together, and a fit leaves them free.
FitOptions expanded(FitOptions);

/// Throws wrong usage for options that do not fit the model or the table's channels.
/// \param expanded  outlives the problem
Problem pose(const Table&, const FitOptions& expanded);

/// True where f stays the same with light and viewer exchanged: then such samples are one to the fit.
bool is_reciprocal(const BoundModel&);

}  // namespace gonio
