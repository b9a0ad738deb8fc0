#pragma once
/// \file
/// Subjects of tests, over domains of their own.

#include <string_view>
#include <utility>
#include <vector>

#include "stability/subject.h"

namespace gonio::stability {

inline Subject subject(std::string_view id,
                       Given given,
                       const std::vector<std::pair<const char*, Range>>& domain = {}) {
  auto s = subject_of(id, name_of(given));
  for (const auto& [input, range] : domain) set_domain(s, input, range);
  return s;
}

}  // namespace gonio::stability
