#pragma once
/// \file
/// Rounding of a table's values, told from their digits.

#include "table/table.h"

namespace gonio {

/// Rounding of a table's values: what their digits leave out, as the standard deviation of a value y.
struct FileRounding {
  double absolute = 0;  ///< where all values are multiples of one decimal fraction [1/sr]; else 0
  double relative = 0;  ///< by the most digits that a value has
  double of(double y) const;
};
FileRounding rounding_of(const Table&);

}  // namespace gonio
