#pragma once
/// \file
/// Files that an earlier run, or somebody else, left where results go.

#include <string>

namespace gonio {

/// Removes a file, or a link itself, unless the run reads it: an input stays.  A folder stays, too, and what is not there is no
/// failure.
/// \return false where it is an input
bool remove_unless_input(const std::string& path);

/// Refuses a name to write that a link has: in a folder of a stranger it would lead to a file elsewhere.
void expect_no_link(const std::string& path);

}  // namespace gonio
