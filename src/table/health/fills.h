#pragma once
/// \file
/// Fills: one value that stands where a table has none.

#include <cstddef>
#include <optional>
#include <vector>

#include "table/table.h"

namespace gonio {

/// Value that many samples share to the last digit, as they share no other, and that is not what is around them.
struct Fill {
  double value;                       ///< [1/sr]
  std::size_t sharers, values;        ///< of the samples looked at, in these channels
  std::vector<std::size_t> channels;  ///< that hold it
};
/// None of a table that states its own origin, nor where most values are the same: a flat surface may be so.
std::optional<Fill> fill_of(const Table&);

}  // namespace gonio
