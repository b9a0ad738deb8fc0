#pragma once
/// \file
/// Which columns of a text are read, and as what: by their names, or by a map (table/format/column_map.h).

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "table/format/column_map.h"
#include "table/format/delimited.h"

namespace gonio {

/// Of half and difference angles, the place of the first among angle_roles.
inline constexpr std::size_t half_roles = 4;
/// Place among angle_roles, whose size for others.
inline std::size_t angle_place(std::string_view role) {
  return static_cast<std::size_t>(std::ranges::find(angle_roles, role) - angle_roles.begin());
}
/// True of an angle of light or viewer.
inline bool is_angle(std::string_view role) {
  return angle_place(role) < half_roles;
}

/// One thing that is read of each row.
struct CsvColumn {
  std::string role;
  std::optional<std::size_t> index;  ///< of the text's column; else the constant
  double constant = 0;
  std::optional<std::string> channel;  ///< of a column with values
  bool is_uncertainty = false, radians = false;
  double low = 0, high = std::numeric_limits<double>::max();  ///< of what is not a value

  bool allows(double v) const;
  /// Names what was found, and what is allowed.
  [[noreturn]] void refuse(const Delimited&,
                           std::string_view found,
                           const std::string& label) const;
};

/// All that is read of each row.
struct CsvColumns {
  std::vector<CsvColumn> all;
  std::set<std::string, std::less<>> roles;  ///< theirs, and that of the header
  std::optional<std::size_t> channel;        ///< the text's column that names a row's channel
  std::optional<std::string> header;         ///< the angle that the columns' names hold
  std::vector<double> header_angles;         ///< in the map's unit; of each column with values
  /// Zenith angles, by their place among angle_roles, that are 90° less their column.
  std::vector<std::size_t> elevations;

  bool has(std::string_view role) const { return roles.contains(role); }
};

/// Columns that the text names itself.
/// \param path          named in errors
/// \param needs_values  refuses a text without a column f or f_NAME
CsvColumns columns_by_name(Delimited&, const std::string& path, bool needs_values);
/// Columns that a map names, with those of the usual names beside them. It reads a line where that has the angles of a matrix.
CsvColumns columns_by_map(Delimited&, const std::string& path, const ColumnMap&);

}  // namespace gonio
