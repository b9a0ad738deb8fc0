#pragma once
/// \file
/// Rounding of a table's values, told from their digits.

#include "table/table.h"

namespace gonio {

/// Rounding of a table's values: what their digits leave out, as the standard deviation of a value y.
struct FileRounding {
  double absolute = 0;  ///< where all values have the same decimals [1/sr]; else 0
  int digits = 0;       ///< where all have the same significant digits; else 0
  double relative = 0;  ///< of binary floats; else 0
  double of(double y) const;
};
/// Decimals or digits, whichever the last places show: rounded values seldom end in 0.
FileRounding rounding_of(const Table&);

}  // namespace gonio
