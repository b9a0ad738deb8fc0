#pragma once
/// \file
/// Where in angle a fitted model is off, and by what factor.

#include <vector>

#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio {

/// ln f_model − ln f_data over theta_h × theta_d, all channels together, of the valid values where
/// both are positive and do not only repeat those of another angle.  Rows of theta_h grow as its square: fine at the peak.
struct ResidualMap {
  std::vector<double> theta_h_deg, theta_d_deg;  ///< edges, one more than there are bins
  std::vector<double> mean, rms;   ///< [h · bins of theta_d + d]; NaN where count is 0
  std::vector<std::size_t> count;  ///< values
  /// At most 2,000 of the values, evenly spread over the table, and the model there [1/sr].
  std::vector<double> measured, predicted;
};

ResidualMap make_residual_map(const Table&, const BoundModel& fitted);

}  // namespace gonio
