#pragma once
/// \file
/// Models whose terms read a workflow's parameters, in the reflectances that they stand for.

#include "brdf/model/model.h"

namespace gonio {

/// The same model with f0 and kd in place of base_color, metallic and reflectance:
///
///   f0 = lerp(d, base_color, metallic),   kd = base_color (1 − metallic),   d = 0.04 or 0.16 reflectance²
///
/// A model without such terms is itself.
BoundModel in_reflectances(const BoundModel&);

}  // namespace gonio
