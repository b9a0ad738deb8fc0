#pragma once
/// \file
/// Files that people take for tables and that are none for gonio: each is refused by its name, with what to do.

#include <string>
#include <string_view>

namespace gonio {

/// Refuses a document of gonio's own, JSON, spreadsheets, archives, arrays, pages, images and text formats of instruments that are not
/// read.  \param head  the file's beginning
void expect_no_foreign_format(const std::string& path, std::string_view head);

}  // namespace gonio
