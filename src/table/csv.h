#pragma once
/// \file
/// Plain CSV: samples anywhere.  The columns theta_i, phi_i, theta_o, phi_o [degrees], one or more of
/// `f` or `f_NAME` [1/sr, no cosine] and perhaps `weight`, in any order, named in the first line.
///
/// Lines that are blank or start with '#' are passed over.  Numbers are written so that they read
/// back as the same doubles.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

bool is_csv(std::string_view head);
/// Refuses angles outside [0, 180] (theta) and [−360, 360] (phi) and weights that are negative or not
/// finite; values may be anything, also nan (see mask()).
Table read_csv(InputFile&);
/// Directions alone: value columns may be missing.
Table read_directions_csv(InputFile&);
/// A grid is written as the list of its directions; what its format marks as "no data" as nan.
void write_csv(const Table&, OutputFile&);

}  // namespace gonio
