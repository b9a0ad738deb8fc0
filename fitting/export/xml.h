#pragma once
/// \file
/// XML of exports: numbers, indentation, and the fit in a comment.

#include <string>
#include <vector>

namespace gonio {

/// "0.25, 0.5", each number with the digits that a float keeps.
std::string xml_numbers(const std::vector<double>&);

/// File of elements, one a line, indented by their depth, below a comment with the fit's document as it was read.  In a
/// comment "--" may not stand: of two hyphens, which only a text of JSON has, the second is written \u002d.
std::string xml_file(const std::string& elements, const std::string& fit);

}  // namespace gonio
