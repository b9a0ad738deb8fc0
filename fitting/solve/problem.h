#pragma once
/// \file
/// What a fit looks for: which parameters are free, and within which bounds.

#include <vector>

#include "fitting/solve/accumulate.h"
#include "fitting/solve/options.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// What stays the same for both bin conventions.
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

}  // namespace gonio
