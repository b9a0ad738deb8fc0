#pragma once
/// \file
/// Value that a document gives a parameter.

#include <string>
#include <utility>
#include <vector>

namespace gonio {

/// Numbers, or a word (metal: Au).
struct GivenParameter {
  std::vector<double> values;
  std::string word;
};
using GivenParameters = std::vector<std::pair<std::string, GivenParameter>>;

}  // namespace gonio
