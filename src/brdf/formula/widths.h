#pragma once
/// \file
/// Parameters of a distribution's shape, which masking and others read too.

#include "number/parameter.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

inline constexpr Parameter alpha_parameter{"alpha", {1e-4, 1}, {1e-4, 1},
                                           0.3,     false,     "width, roughness²"};
/// α of terms that read r = √α and divide by neither: r is 0 to the sixth digit.
inline constexpr Parameter any_alpha_parameter{"alpha", {1e-12, 1}, {1e-4, 1},
                                               0.3,     false,      "width, roughness²"};
inline constexpr Parameter alpha_x_parameter{"alpha_x", {1e-4, 4}, {1e-4, 1},
                                             0.3,       false,     "width along the tangent"};
inline constexpr Parameter alpha_y_parameter{"alpha_y", {1e-4, 4}, {1e-4, 1},
                                             0.3,       false,     "width along the bitangent"};
/// Azimuth of the tangent, in that of the directions.  It is the same tangent half a turn further: a fit that
/// passes 0° or 180° meets no bound.
inline constexpr Parameter tangent_parameter{"tangent", {-360, 360}, {-360, 360},
                                             0,         false,       "azimuth of the tangent [°]"};
inline constexpr Parameter gamma_parameter{"gamma", {0.5, 10}, {0.5, 10},
                                           2,       false,     "tail exponent; 1 Berry, 2 GGX"};
inline constexpr Parameter tail_parameter{
    "tail", {0, 1.5}, {0, 1.5}, 1, false, "tail τ of Student's t; 0 Beckmann, 1 GGX"};

}  // namespace gonio::inline GONIO_ARCH
