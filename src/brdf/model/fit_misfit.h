#pragma once
/// \file
/// Misfit that a fit's document tells of itself.

#include <optional>
#include <string>

namespace gonio {

/// Typical factor of a fit from its table, exp of the log RMS that its document has; none where it has none.
std::optional<double> typical_misfit(const std::string& path, const std::string& bytes);

}  // namespace gonio
