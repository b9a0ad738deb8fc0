#pragma once
/// \file
/// Which distribution a term belongs to.

#include <string_view>

namespace gonio {

/// "ggx", "beckmann", "gtr", "charlie" or "student_t": the distribution that a masking term is for, or that a distribution is of
/// the kind of.
constexpr std::string_view shape_of_term(std::string_view id) {
  const auto has = [&](std::string_view word) { return id.find(word) != id.npos; };
  if (has("charlie")) return "charlie";
  if (has("student_t")) return "student_t";
  return has("gtr") ? "gtr" : has("beckmann") || has("blinn") ? "beckmann" : "ggx";
}

}  // namespace gonio
