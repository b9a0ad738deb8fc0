#pragma once
/// \file
/// Where a fit begins.

#include <vector>

#include "fitting/solve/colours.h"

namespace gonio {

/// A few places in different valleys, each near the bottom, the best first.  Lobe after lobe joins the model: its widths
/// and exponents step over a grid, the colours are solved for in each cell from every valley of their
/// own, and the best cells are descended from.  So a model of several lobes begins from the optimum of
/// those with fewer.
/// \param huber  threshold of the loss
template <class F>
std::vector<Start> find_starts(const Problem&, const FitData<F>& thin, double huber);

}  // namespace gonio
