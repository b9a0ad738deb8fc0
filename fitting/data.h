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

/// Values that a metric cannot use are masked for it: the log and relative metrics need y > 0 unless
/// they have an offset.
struct FitData {
  AngleColumns<double> angles{0};
  std::vector<Column<double>> y;  ///< [channel]; −1 where masked
  Column<double> root_weight;     ///< √weight; 0 in the padding
  std::vector<std::uint16_t> incident;  ///< cluster of each sample: its incident angle
  std::size_t clusters = 0;
  double offset = 0;  ///< of the log and relative metrics [1/sr]

  std::size_t values_used = 0;
  std::map<std::string, std::size_t> masked;  ///< values left out, by reason

  std::size_t samples() const { return angles.size(); }
};

/// The noise floor that a table's negative values betray: 1.4826 · median |negative| where they are
/// noise and make up at least 0.1 % of the values, else 0.  As the offset of the log and relative
/// metrics it keeps values that are mostly noise from counting as much as real ones.
double noise_offset(const Table&);

/// Throws bad_input if nothing is left.
FitData fit_data(const Table&, Bins, Metric, double offset);

/// Every k-th sample, so that about `most` remain.
FitData thinned(const FitData&, std::size_t most);

}  // namespace gonio
