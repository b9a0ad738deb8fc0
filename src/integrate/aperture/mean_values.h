#pragma once
/// \file
/// f as an instrument reports it.

#include <cstddef>
#include <functional>
#include <vector>

#include "brdf/model/model.h"
#include "integrate/aperture/aperture_angles.h"

namespace gonio {

/// Means of f over the cones of samples first, first + 1 … first + count − 1: [channel][sample].
std::vector<std::vector<double>> mean_values(const BoundModel&,
                                             const ApertureAngles&,
                                             std::size_t first,
                                             std::size_t count);

/// f of so many pairs of directions as an instrument with that aperture reports it: [channel][pair].
std::vector<std::vector<double>> mean_values(
    const BoundModel&,
    std::size_t pairs,
    const std::function<DirectionPair(std::size_t)>& directions,
    const Aperture&);

}  // namespace gonio
