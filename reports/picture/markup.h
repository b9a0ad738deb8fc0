#pragma once
/// \file
/// Text in HTML and SVG.

#include <string>
#include <string_view>

namespace gonio {

/// With entities for what an element or an attribute in double quotes would not take as text.
std::string escaped_markup(std::string_view text);

}  // namespace gonio
