#pragma once
/// \file
/// Numbers that tests of many rooms compare with.

#include <limits>
#include <numbers>

namespace gonio::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr double ln2 = std::numbers::ln2;
inline constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace gonio::test
