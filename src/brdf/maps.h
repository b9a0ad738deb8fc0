#pragma once
/// \file
/// Every map, once: a new one is its struct and its name here.

#include "brdf/map.h"
#include "brdf/parameter_maps.h"

namespace gonio::inline GONIO_ARCH {

using Maps = MapList<ClampAlpha,
                     ClampNov,
                     ClampVis,
                     AnisoDisney,
                     AnisoImageworks,
                     BlinnPhongExponent,
                     FilterNormalVariance>;

}  // namespace gonio::inline GONIO_ARCH
