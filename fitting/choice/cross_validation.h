#pragma once
/// \file
/// Error of a model on incident angles that it was not fitted to.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fitting/choice/log_residuals.h"
#include "fitting/solve/problem.h"
#include "table/table.h"

namespace gonio {

/// Parts of a table's samples, each of incident angles that lie side by side: neighbours share their errors, and one of them would
/// tell the other.
struct Blocks {
  std::size_t count = 0;                 ///< none where the table has one incident angle
  std::vector<std::uint16_t> of_sample;  ///< [sample]
  /// Block of the same with light and viewer exchanged, of grids of half and difference angles, which have each pair twice; else
  /// empty.
  std::vector<std::uint16_t> of_exchanged;
};
/// Blocks of a table, or one of each incident angle where they are fewer.
/// \param most  blocks
Blocks incident_blocks(const Sampling&, std::size_t most = 10);

/// Residuals of each block under a fit of all others, of a million values about 65 536.  What is a sample of the block with light and
/// viewer exchanged is not fitted to either.  The fits go on from that of the whole table.
/// Empty where what is left of the table has no more values than the model has parameters.
std::vector<LogResiduals> cross_validate(const Table&,
                                         const Problem&,
                                         const Blocks&,
                                         const BoundModel& whole);

}  // namespace gonio
