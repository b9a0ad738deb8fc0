#pragma once
/// \file
/// Whether light that goes the other way finds the same reflectance.

#include <optional>
#include <string>

#include "table/table.h"

namespace gonio {

struct Reciprocity {
  std::optional<double> error;  ///< median |a − b| / ((a + b)/2) over channels and samples
  std::string note;             ///< why there is none, or from what it is
};

/// Each sample against the one with wi and wo exchanged, where both are valid; a sample that is its
/// own partner (θ_i = θ_o on a grid) counts, with no error.  In a list whose light always comes from
/// one azimuth the partner may be turned about the normal: the surface is taken as isotropic.
/// Where no sample has a partner, against Table::between.
Reciprocity reciprocity(const Table&);

}  // namespace gonio
