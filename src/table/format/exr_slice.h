#pragma once
/// \file
/// An image slice in OpenEXR: theta_h to the right, theta_d downwards, one phi_d; pixels are f_r
/// [1/sr].
///
/// Channels r, g, b are named R, G, B, the channel f is Y; others keep their names.  String
/// attributes, all needed: gonio:layout "image_slice", gonio:phi_d_rad, gonio:channels (names
/// between commas, quoted as in CSV) and gonio:table (see table/format/metadata.h).  Other channels
/// are left unread.

#include <string>

#include "table/table.h"

namespace gonio {

/// theta_h quadratic as in MERL, theta_d uniform.  \param phi_d  [rad]
Grid image_slice_grid(std::size_t n_theta_h, std::size_t n_theta_d, double phi_d, Bins);

/// Of a slice that is read or written.
inline constexpr std::size_t most_slice_values = std::size_t{1} << 24;
Table read_exr_slice(const std::string& path);
/// Values are rounded to float.
void write_exr_slice(const Table&, const std::string& path);

}  // namespace gonio
