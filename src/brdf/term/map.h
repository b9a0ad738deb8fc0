#pragma once
/// \file
/// A map: a formula from parameters to parameters, as shaders run before they evaluate a model
/// (roughness to the two widths, metallic to F0, a clamp).
///
///   about, parameters    what it is called, what it is given
///   outputs              names of what it answers
///   apply(span of T)     the formula; answers one T per output

#include <array>
#include <span>
#include <string_view>

#include "number/parameter.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

template <template <class> class... Maps>
struct MapList {};

template <class Map, class T>
concept MapOver = Real<T> && requires(std::span<const T, Map::parameters.size()> p) {
  { Map::about } -> std::same_as<const About&>;
  { Map::apply(p) } -> std::same_as<std::array<T, Map::outputs.size()>>;
};

/// A map of numbers:  mapped<ClampNov, T>(nov)
template <template <class> class Map, Real T>
auto mapped(const std::same_as<T> auto&... p) {
  return Map<T>::apply(std::array<T, sizeof...(p)>{p...});
}

}  // namespace gonio::inline GONIO_ARCH
