#pragma once
/// \file
/// A Fresnel term at one angle, its parameters given one by one.

#include <array>
#include <concepts>
#include <span>

#include "geometry/angles.h"
#include "number/real.h"
#include "optics/fresnel.h"

namespace gonio {

template <template <class> class Term, class T>
T reflectance(plain_t<T> c, const T& first, const std::same_as<T> auto&... others) {
  const std::array p{first, others...};
  const Term<T> term{std::span<const T, 1 + sizeof...(others)>(p)};
  return as_value<T>(term(Angles<plain_t<T>>{c, c, plain_t<T>(1), c, plain_t<T>(0)}));
}

}  // namespace gonio
