#pragma once
/// \file
/// The plain way to fit a table with Ceres, kept to be measured against: one residual block per bin,
/// each with its own automatic derivatives.

#include <vector>

#include "table/table.h"

namespace gonio {

struct PlainFit {
  std::vector<double> values;  ///< alpha, f0 r g b, kd r g b
  int iterations = 0;
  double build_ms = 0, solve_ms = 0;
};

/// lambert+ggx/smith_ggx.correlated/schlick under the log metric, three channels, from `start`.
PlainFit fit_plainly(const Table&, std::vector<double> start, int threads);

}  // namespace gonio
