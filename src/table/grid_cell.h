#pragma once
/// \file
/// Place between the samples of a grid, found once for all channels.

#include <array>

#include "table/table.h"

namespace gonio {

/// Samples around a pair of directions, with their parts in a trilinear value there.
struct GridCell {
  std::array<std::size_t, 8> sample;
  std::array<double, 8> part;
  std::size_t count = 0;  ///< of those above the horizon; none outside the grid by more than a bin

  /// Those whose values all of these channels have.
  GridCell valid_in(const std::vector<Values>& channels) const;
  /// Mean of a channel's valid values; NaN where they carry half of the weight or less.
  double mean_of(const Values&) const;
};
/// \param at    of the table, which is a grid
/// \param step  samples from one corner to the next along each axis: 2 as if every other sample were missing
GridCell cell_around(const Table&,
                     const SampleAngles& at,
                     const DirectionPair&,
                     std::ptrdiff_t step = 1);

}  // namespace gonio
