#pragma once
/// \file
/// CSV: samples anywhere.  Text with columns (table/format/delimited.h) named theta_i, phi_i, theta_o, phi_o
/// [degrees], one or more of `f` or `f_NAME` [1/sr, no cosine] and perhaps `weight`, in any order; or
/// of other names and conventions, with a map that says which (table/format/column_map.h).
///
/// Numbers are written so that they read back as the same doubles, channels with the same names.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "table/format/column_map.h"
#include "table/format/delimited.h"
#include "table/table.h"

namespace gonio {

/// Text with columns, whatever their names.
bool is_csv(std::string_view head);
/// Refuses zenith angles outside [0, 180] ([−180, 180] under a map), azimuths outside [−360, 360], a
/// file whose light comes from below in most rows, and weights that are negative or not finite; values
/// may be anything, also nan (see mask()).  What is odd but possible is a Table::warning.
Table read_csv(InputFile&, const ColumnMap* = nullptr);
/// Directions alone: value columns may be missing.
Table read_directions_csv(InputFile&);
/// Refuses a list in which most of the light comes from below.
void expect_light_from_above(const std::string& path, const DirectionList&);
/// Adds to a list's warnings what is odd about its directions but possible.
/// \param forward_deg  azimuth at which the file has the mirror direction's side
void warn_of_directions(Table&, double forward_deg = ColumnMap().forward_deg);
/// A grid is written as the list of its directions; what its format marks as "no data" as nan.  More than is read again is refused.
void write_csv(const Table&, OutputFile&);

/// A column as it stands in the file.
struct ColumnSummary {
  std::string name;                ///< "" if it has none
  std::size_t numbers = 0;         ///< rows in which it holds a number
  double lowest = 0, highest = 0;  ///< of these
  std::size_t distinct = 0;  ///< different entries; counted up to 1,000, and fewer where there are
                             ///< thousands of columns
  std::optional<double> first = {};  ///< number of the first row
};
std::vector<ColumnSummary> csv_columns(InputFile&, std::size_t skip = 0, PassedOver* = nullptr);

}  // namespace gonio
