#pragma once
/// \file
/// Operations that a model costs.

#include "brdf/model/model.h"
#include "foreign/function.h"
#include "number/counted.h"

namespace gonio {

/// Operations of one sample in all channels, the model written as one formula: where a lobe multiplies the fractions D, V and F, it
/// divides once.
Operations operations_of(const Model&);
/// Operations of one sample of a file's function, in so many channels: what they share is done once, and what parameters decide is not counted.
Operations operations_of(const foreign::Function&, std::size_t channels);

}  // namespace gonio
