#pragma once
/// \file
/// Which column of a CSV file is what, and in which convention: said once, in the side file.
///
///   "columns": {"theta_i": "thetai", "phi_i": "#3", "theta_o": "thetar", "phi_o": "0", "f": "brdf",
///               "weight": …, "channel": "lambda",
///               "unit": "degrees"|"radians", "forward": 180, "cosine": false, "cosines": [0, 0], "scale": 1,
///               "skip": 0}
///
/// theta_i, phi_i, theta_o, phi_o, f or f_NAME (one for each channel), u_f or u_f_NAME (their standard uncertainties [1/sr];
/// u_rel in parts of the value, u_percent in percent; U_… where they are expanded by k = 2) and weight name a column: by its
/// name, by its number ("#1" is the first), or a constant in its place ("0").  What is not said is the
/// column of that very name; an azimuth without one is 0.  Columns that nothing names are passed over.
/// Where `channel` names a column, each of its values is a channel of its own (a wavelength a row).
/// theta_h, phi_h, theta_d and phi_d stand in place of the four angles [Rusinkiewicz 1998].
/// One angle may be "header": each column whose name holds a number has the values at that angle, as in a matrix; where
/// columns have no names, the first row holds these numbers.  theta_i or theta_o may be "90-NAME" of a column with elevations.
///
///   unit     of all angles
///   forward  phi_o − phi_i of the mirror direction [degrees]: 180, or 0 where azimuths are counted
///            from the direction that the light travels in
///   cosine   values are f cos θ_o
///   cosines  in its place: the powers of cos θ_i and cos θ_o that values are f times, as [0, −1] where f was divided
///            by cos θ_o
///   scale    values times this are f [1/sr]; 1/π for a radiance factor
///   skip     lines at the top that are passed over
///
/// A zenith angle may be negative: the other side, azimuth + 180°.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gonio {

/// Powers of cos θ_i and cos θ_o that values are f times: {0, 1} of f cos θ_o.
struct CosinePowers {
  int incident = 0, outgoing = 0;
  bool operator==(const CosinePowers&) const = default;
};
inline constexpr int most_cosines = 4;  ///< of either, up or down

struct ColumnMap {
  std::vector<std::pair<std::string, std::string>> columns;  ///< role → name, "#k" or number
  bool radians = false;
  double forward_deg = 180;
  CosinePowers cosines;
  double scale = 1;
  std::size_t skip = 0;
};

/// Angles of light and viewer, then half and difference angles.
inline constexpr std::array<std::string_view, 8> angle_roles{
    "theta_i", "phi_i", "theta_o", "phi_o", "theta_h", "phi_h", "theta_d", "phi_d"};
/// The word of the angle that the names of columns hold.
inline constexpr std::string_view in_header = "header";
/// What stands before the column of an elevation, from which the zenith angle is 90° less it.
inline constexpr std::string_view elevation_mark = "90-";

/// Regular expression of what a column can be: an angle, f, f_NAME, an uncertainty of these, weight or channel.
inline constexpr std::string_view role_pattern =
    "^(theta_[iohd]|phi_[iohd]|weight|channel|(f|[uU]_(f|rel|percent))(_[\\s\\S]+)?)$";
/// True for these.
bool is_role(std::string_view);
/// These, for people.
inline constexpr std::string_view role_words =
    "theta_i, phi_i, theta_o, phi_o, theta_h, phi_h, theta_d, phi_d, f, f_NAME, u_f, u_rel, "
    "u_percent, weight, channel";

/// Column with uncertainties: times the factor they are standard ones.
struct UncertaintyRole {
  std::string channel;  ///< "" for all
  double factor;
  bool relative;  ///< to the value, else [1/sr]
};
std::optional<UncertaintyRole> uncertainty_role(std::string_view role);

/// The only number in a text such as "theta_i = 30°", with its sign where none of a word is before it; none where there are
/// more.
std::optional<double> only_number(std::string_view);

}  // namespace gonio
