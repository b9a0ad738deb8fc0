#pragma once
/// \file
/// Angles' indices set low: θ_i in a text becomes θ with a small i.

#include <string>
#include <string_view>

namespace gonio {

/// Markup in which the letter after "θ_", "φ_" or "ω_" stands between two pieces of markup, in place of "_", where it is an index of one
/// letter.
std::string with_indices(std::string_view markup, std::string_view open, std::string_view close);

}  // namespace gonio
