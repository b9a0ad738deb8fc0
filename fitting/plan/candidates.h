#pragma once
/// \file
/// Candidates for measurement: directions that an instrument of the table's kind can take.

#include <vector>

#include "table/table.h"

namespace gonio {

/// Largest zenith angle of either direction [°]: closer to the horizon a goniometer's beam misses part of the sample.
inline constexpr double most_grazing_deg = 80;
/// Least angle between the directions [°]: closer together one arm stands in the other's light.
inline constexpr double least_apart_deg = 10;

/// True where no viewer lies more than sin⁻¹ 0.02 out of its light's plane of incidence, and some light lies a degree from the
/// normal, so that there is such a plane.  Each pair may have its own.
bool is_in_plane_of_incidence(const Table&);

/// Pairs of directions, with phi_i = 0, at angles that are multiples of 0.1°, within the limits above.  They lie on a grid of half and
/// difference angles: θ_h grows by its square, so that highlights from half a degree on are met, θ_d by 5°, φ_d by 15°.
/// \param in_plane  those in the plane of incidence alone
DirectionList candidates(bool in_plane);

}  // namespace gonio
