#pragma once
/// \file
/// What the names of a table's columns say: angles, values, uncertainties and wavelengths, in the words of instruments.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "table/format/column_map.h"
#include "table/format/csv.h"

namespace gonio::column_names {

inline constexpr std::string_view decimal_digits = "0123456789";

/// Letters and digits only, in lower case: "Theta_i [deg]" is "thetaideg", "θi" is "thetai".
std::string plain_name(std::string_view name);
/// True of a unit of angles, as plain_name() writes it.
bool is_angle_unit(std::string_view plain);

enum Angle { theta_i, phi_i, theta_o, phi_o, theta_h, phi_h, theta_d, phi_d };

/// Angle that the name of a column stands for.
struct Said {
  std::optional<Angle> angle;
  bool beside = false;                   ///< the angle counts only where no other name says it
  bool zenith = false, azimuth = false;  ///< of neither direction
};
/// \param plain  of plain_name()
Said said_by(const std::string& plain);

/// Kind of an uncertainty, as a role begins: "u_f", "U_percent"; "" where the name looks like one, but its coverage
/// factor, unit or words are not known; none of other names.
std::optional<std::string> uncertainty_kind(std::string_view name);

/// What values of that name are to be multiplied with where it is that of radiance factors, in parts or percent.
std::optional<double> factor_scale(std::string_view name);

/// A name with a wavelength in it, which others may have in its place.
struct WavelengthName {
  std::string pattern;  ///< "U *nm [%]"
  std::string without;  ///< "U  [%]"
};
std::optional<WavelengthName> wavelength_name(std::string_view name);

/// Columns by what their names say, each the first of its kind.
struct Found {
  std::array<std::optional<std::size_t>, angle_roles.size()> angle;
  std::optional<std::size_t> zenith_of_neither, azimuth_of_neither, value, channel, uncertainty;
  std::vector<std::string>
      unclear;  ///< names that look like uncertainties, of which no more is known
};

Found by_name(std::span<const ColumnSummary> columns);

}  // namespace gonio::column_names
