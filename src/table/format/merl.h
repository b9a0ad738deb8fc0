#pragma once
/// \file
/// MERL's isotropic `.binary` [Matusik 2003]: three int32 (90, 90, 180), then a plane of doubles for
/// each of red, green and blue, all little-endian; theta_h slowest, phi_d fastest.
///
/// A stored value is f_r [1/sr] over 1/1500, 1.15/1500 and 1.66/1500; negative where there is no
/// data.  The variant for surfaces that are not reciprocal has 360 bins over 2π in phi_d.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

Grid merl_grid(Bins, bool reciprocal = true);

/// \param head  the first bytes of a file of `size` bytes
bool is_merl(std::string_view head, std::uint64_t size);
Table read_merl(InputFile&);
/// Bins below the horizon become −1; a table with one channel is written as grey.
void write_merl(const Table&, OutputFile&, const std::string& path);

}  // namespace gonio
