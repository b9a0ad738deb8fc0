#pragma once
/// \file
/// Tables of ALTA (https://alta.gforge.inria.fr): lines "#KEY value", then samples as text or doubles.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// True where a header line #DIM, #PARAM_IN or #ALTA… stands at the beginning.
bool is_alta(std::string_view head);

/// #DIM nx ny; #PARAM_IN how nx numbers [rad] give two directions: SPHERICAL_TL_PL_TV_PV, CARTESIAN
/// (view, light), ISOTROPIC_TL_TV_PROJ_DPHI (θ_l, θ_v cos Δφ, θ_v sin Δφ), ISOTROPIC_TV_PROJ_DPHI (θ_l =
/// 0), ISOTROPIC_TV_TL (one plane, one side of the normal: equal angles are retro-reflection),
/// ISOTROPIC_TV_TL_DPHI, RUSIN_TH_PH_TD_PD, RUSIN_TH_TD_PD, RUSIN_TH_TD (φ_d = π/2), COS_TH_TD (φ_d = 0);
/// Δφ = 0 is the light's own side, and the difference direction is the view's.  #PARAM_OUT:
/// INV_STERADIAN, RGB_COLOR (both f_r), or INV_STERADIAN_COSINE_FACTOR, whose factor is cos θ_v of the
/// view, which the reader divides out (see least_cosine).  Other parametrizations do not give two
/// directions, or not in an agreed way, and are refused by name.  Confidence intervals (#VS) are read
/// over.  Channels: "f"; "r", "g", "b"; else "1", "2", …
/// [Belcour et al. 2015, ALTA; conventions as in its sources/core/params]
Table read_alta(InputFile&);

}  // namespace gonio
