#pragma once
/// \file
/// Lists in sentences.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.h"

namespace gonio {

/// Most names that a sentence lists.
inline constexpr std::size_t most_listed = 6;

/// Names for a sentence, whose file may have thousands and long ones: "a, b"; the first few of many, each cut: "a, b … and 12 more".
inline std::string few_of(const std::vector<std::string>& names, const char* between = ", ") {
  constexpr std::size_t longest = 60;  // bytes
  std::string all;
  const std::size_t n = std::min(names.size(), most_listed);
  for (std::size_t k = 0; k < n; ++k) all += (k ? between : "") + printable(names[k], longest);
  if (names.size() > n) all += " … and " + std::to_string(names.size() - n) + " more";
  return all;
}

}  // namespace gonio
