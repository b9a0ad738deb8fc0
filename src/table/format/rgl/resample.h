#pragma once
/// \file
/// Any isotropic reflectance as an RGL file has it.

#include <cstddef>
#include <string>
#include <vector>

#include "table/format/rgl/function.h"
#include "table/table.h"

namespace gonio {

struct RglSizes {
  std::size_t n_theta = 32;  ///< incident zenith angles from 0 to 90°, denser towards the horizon
  std::size_t n = 64;        ///< of the grid of values, along each side
};

struct RglTable {
  Table table;
  std::size_t nodes = 0;  ///< grid points above the horizon
  /// Of these, those that took the value of the nearest that has one, in the channel of most.
  std::size_t without_data = 0;
};

/// The file's facets are distributed as f says: D(θ_h) is the mean of 4 f cos θ_i cos θ_o over θ_d = 0° to 60° at φ_d = 90°,
/// normalised, with an even one as a hundredth of it.  What is stored over D is smooth, then.  The grid points of an incident
/// direction follow the facets that f shows at θ_d = θ_i, an even distribution as 3/10 of it, less those that mirror light below
/// the horizon.  θ_i = 90° (1 − (1 − t)^1.5), t even.
///
/// \param f         f_r [1/sr], of the same sign and function for every azimuth; NaN: no data
/// [Dupuy and Jakob 2018, §4]
RglTable rgl_table(const RglFunction& f, std::vector<std::string> channels, const RglSizes&);

/// Numbers that a table of that size has beside its angles; a reader refuses more than most_values with these.
std::size_t rgl_numbers(std::size_t channels, const RglSizes&);

/// The channels of a file as mixtures of those of rgl_table(): f_k = Σ weight[k][c] f_c.
/// \param channels  r, g, b; or wavelengths [nm], ascending
Table rgl_mixed(const Table&,
                std::vector<std::string> channels,
                bool spectral,
                const std::vector<std::vector<double>>& weight);

}  // namespace gonio
