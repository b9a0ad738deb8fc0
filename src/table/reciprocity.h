#pragma once
/// \file
/// Whether light that goes the other way finds the same reflectance.

#include <optional>
#include <string>

#include "table/table.h"

namespace gonio {

struct Reciprocity {
  std::optional<double> error;  ///< median |a − b| / ((a + b)/2) over channels and valid pairs
  std::string note;             ///< why there is none, or from what it is
};

/// Pairs are samples with wi and wo exchanged.  In a list whose light always comes from one azimuth
/// the pair may also be turned about the normal: the surface is taken as isotropic.
Reciprocity reciprocity(const Table&);

}  // namespace gonio
