#pragma once
/// \file
/// Every map, once: a new one is its struct and its name here.

#include "brdf/formula/parameter_maps.h"
#include "brdf/formula/scattering.h"
#include "brdf/term/map.h"
#include "optics/f0.h"

namespace gonio::inline GONIO_ARCH {

using Maps = MapList<ClampAlpha,
                     ClampNov,
                     ClampVis,
                     AnisoDisney,
                     AnisoImageworks,
                     BlinnPhongExponent,
                     FilterNormalVariance,
                     F0FromIor,
                     F0FromIorAsWritten,
                     IorFromF0,
                     F0Metallic,
                     IndexFromEdgeTint,
                     EdgeTintFromIndex,
                     KullaConty,
                     KullaContyLinear,
                     KullaContyLobe,
                     Turquin,
                     TurquinAverage,
                     FdezAguera,
                     AlbedoFit,
                     AlbedoFitMaterialx>;

}  // namespace gonio::inline GONIO_ARCH
