#pragma once
/// \file
/// Profile of the cost over the one or two shapes of a model that are free, everything else solved for
/// anew in each cell: evidence that no other valley lies below the optimum, found by looking.

#include <cstddef>
#include <limits>
#include <vector>

#include "fitting/solve/search.h"

namespace gonio {

struct ProfileCell {
  std::vector<double> at;  ///< on each axis
  double cost = 0;         ///< of the thinned table
  /// Cost of all samples; NaN where that was not asked.
  double cost_of_all = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;  ///< of all slots
};

struct Profile {
  std::vector<std::size_t>
      parameters;                  ///< of the axes, by their number in the model; none: no cells
  double optimum = 0;              ///< cost of the thinned table where it is lowest
  std::vector<ProfileCell> cells;  ///< the last axis runs fastest
  int moves = 0;                   ///< of the fit, to a valley that a profile found lower
};

/// Cells of a profile over one axis, and along each of two.
inline constexpr std::size_t profile_cells = 64, profile_side = 16;

/// Widths first, then exponents; where one of these is free at most, an index or an extinction that all
/// channels share.
std::vector<std::size_t> profile_axes(const Problem&);

/// Profile of the thinned table.  Its cells within 1 % of the lowest are solved for once more with all
/// samples, and so are, everything free, the bottoms of its other valleys; where one of them is lower
/// than the fit by more than 1e-6 of it, the fit goes on from there and is profiled again.
/// \param scan  a thinned table with more samples
template <class F>
Profile profile(
    const Problem&, const FitData<F>& thin, const FitData<F>& scan, const FitData<F>& all, Fitted&);

}  // namespace gonio
