#pragma once
/// \file
/// Names of parameters that a model takes.

#include <string>
#include <string_view>

namespace gonio {

/// True where bind_model takes a setting of that name, whatever its value.  \param spec  a model's, or a preset
bool takes_parameter(std::string_view spec, const std::string& name);

}  // namespace gonio
