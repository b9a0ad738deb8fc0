#pragma once
/// \file
/// Values of a term over many rows, by the kernels: a file's function takes a tenth of the time that one row after another takes.

#include <cstddef>
#include <span>

#include "integrate/rule/slopes.h"
#include "reports/measure/samples.h"

namespace gonio {

class RowColumns {
 public:
  explicit RowColumns(std::span<const auditing::Row>);
  /// D, V, F, or a diffuse term at each row.
  auditing::Values values(std::size_t term, std::span<const double> parameters);

 private:
  std::size_t count_;
  AngleBlock block_{true};
};

}  // namespace gonio
