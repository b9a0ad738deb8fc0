#pragma once
/// \file
/// Which functions of a file call one.

#include <string>
#include <vector>

namespace gonio::foreign {

/// Functions of the file that call one and multiply or divide by π, maybe with 2 or 4, by name.
std::vector<std::string> callers_with_pi(const std::string& path, const std::string& function);

}  // namespace gonio::foreign
