#pragma once
/// \file
/// What looking a path up found, for a user.

#include <filesystem>

#include "base/error.h"

namespace gonio {

/// The same as bad_input of the path.
inline Error path_error(const std::filesystem::filesystem_error& e) {
  return bad_input(e.path1().string(), "looking it up", e.code().message(), "a path within reach");
}

}  // namespace gonio
