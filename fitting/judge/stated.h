#pragma once
/// \file
/// Residuals of a fit, beside the uncertainties that a table states.

#include <optional>

#include "fitting/sample/sampling.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/solve.h"

namespace gonio {

struct BesideStated {
  double chi2_per_freedom;  ///< squares of residuals in standard uncertainties, over values less
                            ///< unknowns
  bool holds;               ///< not larger than chance makes in one of 1000 tables
};

/// None where nothing is stated, where residuals are not counted in it (l2_cosine) or large ones are clipped (relative, robust fits).
/// \param cost  ½ Σ r²
std::optional<BesideStated> beside_stated(const Sampling&,
                                          const Problem&,
                                          double cost,
                                          double values);

}  // namespace gonio
