#pragma once
/// \file
/// Rounding errors of sums and products, exactly: for the few differences on which everything
/// hangs.

#include <concepts>
#include <limits>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// True of a number that is rounded to nearest after every operation.
template <class F>
inline constexpr bool rounds_to_nearest = std::floating_point<F>;

/// True of a T that computes as its base does, bit by bit, in such a number.  Others lose nothing here (Wide), or do
/// not stay in one number (Mixed).  Shaken is held to be such a T: nearly the same error is found (shaken.h).
template <class T>
inline constexpr bool computes_as_base = rounds_to_nearest<base_t<T>>;

/// a + b = sum + sum_error                                                            [Knuth 1969]
template <Real T>
T sum_error(const T& a, const T& b, const T& sum) {
  const T of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b);
}

/// a b = product + product_error, where nothing overflows                           [Dekker 1971]
template <Real T>
T product_error(const T& a, const T& b, const T& product) {
  if constexpr (computes_as_base<T>) {
    constexpr int half = (std::numeric_limits<base_t<T>>::digits + 1) / 2;
    const auto upper = [](const T& x) {
      const T s = x * constant<T>(static_cast<long double>((1LL << half) + 1));
      return s - (s - x);
    };
    const T a1 = upper(a), a2 = a - a1, b1 = upper(b), b2 = b - b1;
    return ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
  } else {
    return T(0);
  }
}

}  // namespace gonio::inline GONIO_ARCH
