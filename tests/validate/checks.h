#pragma once
/// \file
/// What the tests of budgets ask of a check.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "validate/validate.h"

namespace gonio {

inline const std::string smith = "ggx/smith_ggx.correlated/schlick";

/// Input of that name at which the check found its worst value.
inline double at(const BudgetCheck& b, const std::string& name) {
  const auto x = std::ranges::find(b.at, name, &std::pair<std::string, double>::first);
  if (x == b.at.end()) throw std::out_of_range(name);
  return x->second;
}

}  // namespace gonio
