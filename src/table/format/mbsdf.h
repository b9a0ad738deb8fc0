#pragma once
/// \file
/// NVIDIA's MBSDF, reflection part: two ASCII lines, uint32 type (0 scalar, 1 RGB), res_theta and
/// res_phi, then float32 f_r [1/sr] as [theta_i][theta_o][phi][channel], all little-endian.
///
/// theta covers [0, π/2) in bins; phi covers [0, π] with both ends, π being the mirror direction.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

Grid mbsdf_grid(std::size_t n_theta, std::size_t n_phi, Bins);

bool is_mbsdf(std::string_view head);
Table read_mbsdf(InputFile&);
/// Values are rounded to float.
void write_mbsdf(const Table&, OutputFile&, const std::string& path);

}  // namespace gonio
