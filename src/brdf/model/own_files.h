#pragma once
/// \file
/// People's own files that a spec names, where a document says it and not a person.

#include <string>
#include <string_view>

namespace gonio {

/// True of a spec with a function of a file in it.
bool names_own_file(std::string_view spec);
/// Bad input of the document unless the spec's files lie below the folder that gonio runs in, or follow_paths() was called.
void expect_own_files_below(const std::string& document, std::string_view spec);

}  // namespace gonio
