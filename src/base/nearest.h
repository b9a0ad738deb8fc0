#pragma once
/// \file
/// Names that a name may be a slip of.

#include <span>
#include <string_view>
#include <vector>

namespace gonio {

/// The three of `known`, or as many as there are, that the fewest changed letters lead to; the nearest first,
/// before them those that begin with the name.
std::vector<std::string_view> nearest(std::string_view name,
                                      std::span<const std::string_view> known);

}  // namespace gonio
