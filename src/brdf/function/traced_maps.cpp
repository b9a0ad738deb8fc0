// Every map as a graph, of which shaders are written.
#include "brdf/catalogue/maps.h"
#include "brdf/function/map_functions.h"
#include "number/half.h"
#include "number/traced.h"

namespace gonio {
namespace {

template <template <class> class Map, class T>
std::vector<T> as_function(std::span<const T> parameters) {
  static_assert(MapOver<Map<T>, T>);
  const auto out = Map<T>::apply(parameters.template first<Map<T>::parameters.size()>());
  return {out.begin(), out.end()};
}
template <class T, template <class> class... All>
constexpr auto functions_of(MapList<All...>) {
  return std::array{&as_function<All, T>...};
}

}  // namespace

template <>
std::span<const MapFunction<Traced<float>>> map_functions<Traced<float>>() {
  static constexpr auto all = functions_of<Traced<float>>(Maps{});
  return all;
}
template <>
std::span<const MapFunction<Traced<Half>>> map_functions<Traced<Half>>() {
  static constexpr auto all = functions_of<Traced<Half>>(Maps{});
  return all;
}

}  // namespace gonio
