#pragma once
/// \file
/// Bytes as text that a page's script may hold, a sixteenth shorter than in base 64.

#include <string>
#include <string_view>

namespace gonio {

/// Five digits for four bytes, the highest first; of the last bytes, if they are fewer, one digit more than bytes.  The digits 0 to 84
/// are the characters from '*' to '~', but for '<', which may begin a tag: '!' stands in its place.
std::string base85(std::string_view bytes);

}  // namespace gonio
