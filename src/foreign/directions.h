#pragma once
/// \file
/// Which direction or cosine an argument of that name stands for, and its scalars in a program.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "foreign/function.h"

namespace gonio::foreign {

/// The name in lower case without underscores: "n_dot_l" and "NdotL" become "ndotl".
std::string plain(std::string_view name);
/// What an argument of that name and size stands for: N L V H X Y or a cosine; empty for a parameter.
/// \throws Error  wrong usage of what --argument says
std::string direction_of(const std::string& name, std::size_t size, const Reading&);

/// Its place among angle_names.
std::size_t angle(std::string_view name);
/// Scalars of a direction, in the frame N = z.
std::vector<Ref> coordinates(Program&, char direction);
/// The same in the frame of the half vector, where VoH is all that light and view have.
std::vector<Ref> from_half(Program&, char direction);
Ref cosine(Program&, const std::string& name);

}  // namespace gonio::foreign
