#pragma once
/// \file
/// XML of exports: numbers, indentation, and the fit in a comment.

#include <string>
#include <vector>

namespace gonio {

/// "0.25, 0.5", each number with the digits that a float keeps.
std::string xml_numbers(const std::vector<double>&);

/// What an exported file keeps in its comment.
inline constexpr const char* exported_fit = "the fit as it was exported";

/// File of elements, one a line, indented by their depth, below a comment with a document as it was read.  In a
/// comment "--" may not stand: of two hyphens, which only a text of JSON has, the second is written \u002d.
/// \param what  the document is: exported_fit
std::string xml_file(const std::string& elements,
                     const std::string& what,
                     const std::string& document);

}  // namespace gonio
