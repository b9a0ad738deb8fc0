#pragma once
/// \file
/// A fraction that is not divided yet: a product of terms then costs one division, not one a term.

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

template <Real T>
struct Quotient {
  T num, den;
  bool whole = false;  ///< no fraction at all: den is 1, and nobody divides by it
  T value() const { return whole ? num : num / den; }
};

template <Real T>
Quotient<T> operator*(const T& factor, const Quotient<T>& q) {
  return {factor * q.num, q.den, q.whole};
}

template <Real T>
Quotient<T> as_quotient(const Quotient<T>& q) {
  return q;
}
template <Real T>
Quotient<T> as_quotient(const T& x) {
  return {x, T(1), true};
}
template <Real T>
T as_value(const Quotient<T>& q) {
  return q.value();
}
template <Real T>
T as_value(const T& x) {
  return x;
}

}  // namespace gonio::inline GONIO_ARCH
