#pragma once
/// \file
/// ASTM E1392 text: lines "KEY value", one of them VARS with the columns' names, and after it rows of numbers between commas.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// True where a line VARS names theta_i soon.
bool is_astm(std::string_view head);

/// VARS names theta_i, phi_i, theta_s and phi_s, in any order, and beside them channels: R, G, B become r, g, b, a single one f.  Both
/// directions point away from the surface, so that the mirror direction is at phi_s = phi_i + π; a negative θ is the other side of the
/// normal.  Values are f_r [1/sr] without the cosine.  Where NUM_POINTS stands above VARS, there are as many rows.
///
/// The unit of the angles does not stand in the file.  They are radians, as Cornell's files have them and libbsdf takes them, unless
/// one is beyond 2π: then all are degrees.  A note says which.
/// [ASTM E1392-96; no real file was at hand: as ALTA (belcour/alta, 7c54015) and libbsdf (KimuraRyo/libbsdf, eb62dc1) read them]
Table read_astm(InputFile&);

}  // namespace gonio
