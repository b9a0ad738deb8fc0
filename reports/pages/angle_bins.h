#pragma once
/// \file
/// Bins over two angles of a sample, for maps that people look at.

#include <string>
#include <vector>

#include "table/table.h"

namespace gonio {

/// theta_h × theta_d, where theta_h grows as its square (fine at the peak), or theta_i × theta_o.
struct AngleBins {
  Grid::Kind kind;
  std::size_t x, y;  ///< how many

  std::string x_name() const { return kind == Grid::Kind::in_out ? "theta_i" : "theta_h"; }
  std::string y_name() const { return kind == Grid::Kind::in_out ? "theta_o" : "theta_d"; }
  std::vector<double> x_deg() const;  ///< edges from 0 to 90°, one more than there are bins
  std::vector<double> y_deg() const;
  /// \return  bin of x · y + bin of y.  Samples on an edge, as those of many grids are, belong to
  ///           the bin above it whatever the rounding of their angle.
  std::size_t cell(const Angles<double>&) const;
};

}  // namespace gonio
