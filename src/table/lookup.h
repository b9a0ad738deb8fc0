#pragma once
/// \file
/// What a table says at any pair of directions, or that it says nothing there.

#include "table/grid_cell.h"
#include "table/nearest_sample.h"
#include "table/table.h"

namespace gonio {

/// The samples that speak for a pair of directions: of a grid the valid corners of its cell, of a list the valid sample
/// nearest in wi and wo, where neither is further off than the reach.  Of a list that is seen from the other side as well,
/// f(wi, wo) = f(wo, wi), and as an isotropic surface's, f(φ) = f(−φ).
///
/// A grid that ends before the horizon, or has one azimuth alone, speaks for what is within the reach of it.
/// Not for lists with Table::between, which need no samples to speak for them.
class Lookup {
 public:
  /// \param reach  [rad]
  Lookup(const Table&, double reach);

  /// Samples whose values all channels have: their mean_of() is the table's value; NaN where the table does not cover,
  /// which is where they carry half of the weight of those above the horizon or less.
  GridCell operator()(const DirectionPair&) const;

 private:
  bool is_within_reach(const DirectionPair&) const;

  const Table& table_;
  SampleAngles at_;
  double chord2_;  ///< of the reach, squared
  NearestSample nearest_;
};

}  // namespace gonio
