#pragma once
/// \file
/// What a person is told of many tables.

#include <cstddef>
#include <string>

#include "fitting/batch/batch_document.h"

namespace gonio::cli {

/// Line of how many were fitted and how many not, then a line for each of the first that were not.
/// \param kept  of them, which were not fitted again
void print_rows(const BatchSummary&, std::size_t kept);
/// Lines of documents that lie in the folder and are not in the summary, by why; none of none.
void print_left_out(const BatchSummary&);
/// "a, b, c and 2 more"
std::string some_of(const std::vector<std::string>& names);
/// Line of where the summary lies.
void print_summary_place(const std::string& folder);

}  // namespace gonio::cli
