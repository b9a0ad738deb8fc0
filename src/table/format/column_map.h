#pragma once
/// \file
/// Which column of a CSV file is what, and in which convention: said once, in the side file.
///
///   "columns": {"theta_i": "thetai", "phi_i": "#3", "theta_o": "thetar", "phi_o": "0", "f": "brdf",
///               "weight": …, "channel": "lambda",
///               "unit": "degrees"|"radians", "forward": 180, "cosine": false, "scale": 1, "skip": 0}
///
/// theta_i, phi_i, theta_o, phi_o, f or f_NAME (one for each channel), u_f or u_f_NAME (their standard uncertainties [1/sr];
/// U_f where they are expanded by k = 2) and weight name a column: by its
/// name, by its number ("#1" is the first), or a constant in its place ("0").  What is not said is the
/// column of that very name; an azimuth without one is 0.  Columns that nothing names are passed over.
/// Where `channel` names a column, each of its values is a channel of its own (a wavelength a row).
///
///   unit     of all angles
///   forward  phi_o − phi_i of the mirror direction [degrees]: 180, or 0 where azimuths are counted
///            from the direction that the light travels in
///   cosine   values are f cos θ_o
///   scale    values times this are f [1/sr]; 1/π for a radiance factor
///   skip     lines at the top that are passed over
///
/// A zenith angle may be negative: the other side, azimuth + 180°.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gonio {

struct ColumnMap {
  std::vector<std::pair<std::string, std::string>> columns;  ///< role → name, "#k" or number
  bool radians = false;
  double forward_deg = 180;
  bool cosine = false;
  double scale = 1;
  std::size_t skip = 0;
};

/// Regular expression of what a column can be: an angle, f, f_NAME, u_f, u_f_NAME, weight or channel.
inline constexpr std::string_view role_pattern =
    "^(theta_i|phi_i|theta_o|phi_o|weight|channel|([uU]_)?f|([uU]_)?f_[\\s\\S]+)$";
/// True for these.
bool is_role(const std::string&);

}  // namespace gonio
