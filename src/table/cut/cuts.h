#pragma once
/// \file
/// Cuts through a table, and a fitted model if there is one: curves over one angle that people can look at.

#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio {

/// One curve per channel along `along`, at one value of `at`.
///
/// In the plane of incidence: at theta_i, along theta_o, which is positive on the mirror side and
/// negative on the side of the incident direction.  A half-difference slice away from that plane
/// (one phi_d, the usual image slice) has no such curve: there it is at theta_d, along theta_h.
struct Cut {
  std::string at;  ///< "theta_i" or "theta_d"
  double at_deg;
  double within_deg = 0;    ///< data of `at` this far off are shown too (directions at random)
  std::string along;        ///< "theta_o" or "theta_h"
  std::vector<double> deg;  ///< ascending, of the data and, with a model, of a dense grid
  std::vector<std::vector<double>> data;   ///< [channel][point], 1/sr; NaN: no valid sample here
  std::vector<std::vector<double>> model;  ///< likewise; NaN below the horizon; empty without one
  std::vector<std::vector<double>>
      uncertainty{};  ///< likewise, standard, of the data of a list; empty: none is stated
  std::vector<std::vector<double>>
      left_out{};  ///< likewise: what a mask left out of the table; empty: nothing
};

/// At most six cuts, only such that show data.  Data of grids are shown where the grid has nodes:
/// theta_i and theta_o, or theta_h, are the grid's own, the other angles interpolated; data of lists
/// as they are, up to 1.5° out of the plane; beside an anisotropic model those at azimuth 0 or 180°.
std::vector<Cut> make_cuts(const Table&, const BoundModel& fitted);
/// Without a model.
std::vector<Cut> make_cuts(const Table&);

}  // namespace gonio
