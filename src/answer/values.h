#pragma once
/// \file
/// f_r of a model, or of a table between its samples, at given directions, as `gonio eval` and `gonio.eval` give it.

#include <span>

#include "brdf/model/model.h"
#include "table/format/in_memory.h"

namespace gonio {

/// f_r of the model [1/sr, no cosine]; 0 below the horizon.
/// \param out  a column per channel, as long as the directions
void evaluate_at(const BoundModel&, const DirectionColumns&, std::span<double* const> out);
/// f_r of a table between its samples; NaN where it has none.
/// \throws Error  bad_input of a table that has no values between its samples
void interpolate_at(const Table&, const DirectionColumns&, std::span<double* const> out);

}  // namespace gonio
