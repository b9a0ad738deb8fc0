#pragma once
/// \file
/// Text taken apart, and made fit for a line that people read.

#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// The parts between separators: at least one, empty ones included.
std::vector<std::string> split(std::string_view, char at);

/// Text as one line of UTF-8 that leaves a terminal alone: control characters and bytes that are not
/// UTF-8 become \xNN; what is longer than `most` bytes is cut and ends in "…".
std::string printable(std::string_view, std::size_t most = std::string_view::npos);

/// "1 iteration", "2 iterations".
std::string counted(std::size_t n, std::string_view thing);

/// Word of a command line: in quotes where a shell would take it apart.
std::string shell_word(const std::string&);

}  // namespace gonio
