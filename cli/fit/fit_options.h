#pragma once
/// \file
/// Words that commands share that fit tables or have it done elsewhere.

#include <string>
#include <vector>

#include "cli/line/command.h"

namespace gonio::cli {

/// The tables: files, folders, @LIST.
void add_tables(Command&, std::vector<std::string>& files);
/// --pages
Option add_pages(Command&, bool& pages);

}  // namespace gonio::cli
