#pragma once
/// \file
/// Files that an earlier run, or somebody else, left where results go.

#include <string>

namespace gonio {

/// Removes a file, or a link itself, unless the run reads it: an input stays.  A folder stays, too, and what is not there is no
/// failure.
/// \return false where it is an input
bool remove_unless_input(const std::string& path);

}  // namespace gonio
