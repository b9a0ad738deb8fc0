#pragma once
/// \file
/// A table as the fit reads it: valid samples as columns, cosines ready.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "brdf/evaluate.h"
#include "brdf/kernels.h"
#include "table/table.h"

namespace gonio {

/// A valid 0 stays in the columns: the kernels leave it out where the metric cannot use it.
struct FitData {
  AngleColumns<double> angles{0};
  std::vector<Column<double>> y;        ///< [channel]; −1 where masked
  Column<double> root_weight;           ///< √(weight over its mean); 0 in the padding
  std::vector<std::uint32_t> incident;  ///< cluster of each sample: its incident angle
  std::size_t clusters = 0;             ///< how many of them there are
  Metric metric = Metric::log;
  double offset = 0;  ///< of the log and relative metrics [1/sr]

  std::size_t values_used = 0;
  std::map<std::string, std::size_t> masked;  ///< values left out, by reason

  std::size_t samples() const { return angles.size(); }
};

/// Throws bad_input if nothing is left.
FitData fit_data(const Table&, Bins, Metric, double offset);

/// Every k-th sample, so that about `most` remain.
FitData thinned(const FitData&, std::size_t most);

}  // namespace gonio
