#pragma once
/// \file
/// Maps as functions over a number T of any kind, as functions.h has the terms.

#include <array>
#include <span>
#include <vector>

#include "brdf/term/map.h"

namespace gonio {

/// A map: one value per output.
template <class T>
using MapFunction = std::vector<T> (*)(std::span<const T> parameters);

/// All, in the order of the catalogue.
template <class T>
std::span<const MapFunction<T>> map_functions();

inline namespace GONIO_ARCH {

template <template <class> class Map, class T>
std::vector<T> map_at(std::span<const T> parameters) {
  static_assert(MapOver<Map<T>, T>);
  const auto out = Map<T>::apply(parameters.template first<Map<T>::parameters.size()>());
  return {out.begin(), out.end()};
}
template <class T, template <class> class... All>
constexpr auto functions_of(MapList<All...>) {
  return std::array{&map_at<All, T>...};
}

}  // namespace GONIO_ARCH

#define GONIO_MAPS_AS_FUNCTIONS(T)                       \
  template <>                                            \
  std::span<const MapFunction<T>> map_functions<T>() {   \
    static constexpr auto all = functions_of<T>(Maps{}); \
    return all;                                          \
  }

}  // namespace gonio
