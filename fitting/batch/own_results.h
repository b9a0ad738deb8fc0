#pragma once
/// \file
/// Files of a folder of results that gonio may replace: those that it made.

#include <string>
#include <vector>

namespace gonio {

/// True of a page of gonio's.
bool is_page(const std::string& path);

/// Refuses to replace files of somebody else: what no batch made, nor an earlier one in this folder was to make.
/// \param documents, results  names in the folder: of tables' documents, and of all files
/// \throws Error  bad_input that names the file
void expect_own(const std::string& folder,
                const std::vector<std::string>& documents,
                const std::vector<std::string>& results);

}  // namespace gonio
