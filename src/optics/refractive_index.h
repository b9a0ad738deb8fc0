#pragma once
/// \file
/// Measured refractive indices N = n + i k of metals.

#include <array>
#include <span>
#include <string_view>

namespace gonio {

/// At 650, 550 and 450 nm, standing for red, green and blue.
struct Metal {
  std::string_view symbol, name;
  std::array<double, 3> n, k;
  std::string_view source;
};

std::span<const Metal> metals();
/// By symbol or name, without regard to case; nullptr if unknown.
const Metal* find_metal(std::string_view symbol_or_name);

}  // namespace gonio
