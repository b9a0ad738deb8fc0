#pragma once
/// \file
/// Azimuths that are taken for others: mirror images and turns by quarters.

#include <array>
#include <cstddef>
#include <string_view>

namespace gonio {

/// x and y of directions become others.
struct Turn {
  std::array<int, 4> to;  ///< x' = to₀ x + to₁ y, y' = to₂ x + to₃ y
  std::string_view what;
  std::string_view azimuth;  ///< what the azimuth becomes, φ being as given
  std::string_view vector;   ///< what becomes of x and y
};
/// Each two, but for the last, differ by half a turn.
inline constexpr std::array<Turn, 7> turns{
    {{{1, 0, 0, -1}, "negated, or y points down", "−φ", "(x, −y)"},
     {{-1, 0, 0, 1}, "counted from −x and backwards", "180° − φ", "(−x, y)"},
     {{0, 1, 1, 0}, "counted from y, or x and y are exchanged", "90° − φ", "(y, x)"},
     {{0, -1, -1, 0}, "counted from −y and backwards", "270° − φ", "(−y, −x)"},
     {{0, -1, 1, 0}, "a quarter turn behind", "φ + 90°", "(−y, x)"},
     {{0, 1, -1, 0}, "a quarter turn ahead", "φ − 90°", "(y, −x)"},
     {{-1, 0, 0, -1}, "half a turn off", "φ + 180°", "(−x, −y)"}}};
inline constexpr std::size_t half_turn = 6;

}  // namespace gonio
