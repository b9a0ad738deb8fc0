#pragma once
/// \file
/// Text taken apart, and made fit for a line that people read.

#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// The parts between separators: at least one, empty ones included.
std::vector<std::string> split(std::string_view, char at);

}  // namespace gonio
