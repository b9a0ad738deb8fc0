#pragma once
/// \file
/// Names of parameters that a model takes.

#include <string>
#include <string_view>

#include "brdf/model/model.h"

namespace gonio {

/// True where bind_model takes a setting of that name, whatever its value.  \param spec  a model's, or a preset
bool takes_parameter(std::string_view spec, const std::string& name);
/// True of a colour whose channels a file's function mixes, which are parameters each: tint_r, tint_g and tint_b by the name tint.
bool is_mixed_colour(const Model&, const std::string& name);

}  // namespace gonio
