#pragma once
/// \file
/// Values that noise, digits, a full detector or somebody who filled gaps took away.

#include <string>
#include <vector>

#include "table/health/facts.h"

namespace gonio {

/// Says that zeros or digits hide values.
void warn_of_zeros(TableFacts&, std::vector<std::string>& all);

/// A greatest value that many samples share is where a detector was full; a least one, where noise was clipped; any other, where
/// somebody filled a gap.
void warn_of_shared_ends(TableFacts&, std::vector<std::string>& all);

/// Size of noise or digits below which the table lost values [1/sr]: the noise floor that negative values betray, or, where
/// more than 2 % of the values are 0, what those beside them typically are.  Else 0.
double lost_below(TableFacts&);

}  // namespace gonio
