#pragma once
/// \file
/// Names that someone may have meant by one that there is not.

#include <span>
#include <string_view>

namespace gonio {

/// Throws wrong usage that names the three of `known` that the fewest changed letters lead to.
/// \param what  the names stand for: "no WHAT 'NAME'; nearest: …"
[[noreturn]] void refuse_name(std::string_view name,
                              std::span<const std::string_view> known,
                              std::string_view what);

}  // namespace gonio
