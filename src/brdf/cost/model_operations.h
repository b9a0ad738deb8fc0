#pragma once
/// \file
/// Operations that a model costs.

#include "brdf/model/model.h"
#include "number/counted.h"

namespace gonio {

/// Operations of one sample in all channels, the model written as one formula: where a lobe multiplies the fractions D, V and F, it
/// divides once.
Operations operations_of(const Model&);

}  // namespace gonio
