#pragma once
/// \file
/// The number type of a formula: all that it may ask of it.
///
/// Every formula is a template over `Real`; evaluated with double it gives the value, with Dual its
/// derivatives, with Batch a register full of samples.  The rules that make this work, each enforced
/// by instantiating the formula with Archetype (archetype.h) in its test:
///
///   - no `if`, no `?:` on numbers: `select(mask, a, b)`, which evaluates both sides, so guard the
///     *input* of sqrt, log and division, not their result;
///   - integer literals as they are (`1 - c`), all other constants through `constant<T>(…L)`;
///   - functions unqualified: `sqrt(x)`, found by the using-declarations below or by the argument.
///
/// GONIO_ARCH names the instruction set a file is compiled for.  Everything templated stands in an
/// inline namespace of that name: otherwise the linker might keep the AVX-512 copy of
/// `square<float>` for all, and the program would die on a lesser machine.

#include <cmath>
#include <concepts>
#include <cstddef>

#ifndef GONIO_ARCH
#define GONIO_ARCH baseline
#endif

namespace gonio::inline GONIO_ARCH {

// Without these, unqualified sqrt(float) picks C's double version silently.
using std::exp;
using std::log;
using std::sqrt;

/// Specialised once per number type:
///   Base    the plain number underneath (float for Dual<Batch<float>, 2>)
///   Plain   the number without derivatives (Batch<float> for Dual<Batch<float>, 2>)
///   Mask    what `a < b` returns
///   select  lane-wise choice
///   max, min  where one instruction does what `max` and `min` below say
template <class T>
struct RealTraits;

template <std::floating_point T>
struct RealTraits<T> {
  using Base = T;
  using Plain = T;
  using Mask = bool;
  static constexpr T select(bool m, const T& a, const T& b) { return m ? a : b; }
};

template <class T>
using base_t = typename RealTraits<T>::Base;
template <class T>
using plain_t = typename RealTraits<T>::Plain;
template <class T>
using mask_t = typename RealTraits<T>::Mask;

/// Lane-wise `mask ? a : b`; both are evaluated.
template <class T>
constexpr T select(const mask_t<T>& mask, const T& a, const T& b) {
  return RealTraits<T>::select(mask, a, b);
}

template <class T>
concept Real = requires(const T a, const T b, const mask_t<T> m) {
  T(1);
  { a + b } -> std::same_as<T>;
  { a - b } -> std::same_as<T>;
  { a* b } -> std::same_as<T>;
  { a / b } -> std::same_as<T>;
  { -a } -> std::same_as<T>;
  { 1 - a } -> std::same_as<T>;
  { a * 2 } -> std::same_as<T>;
  { a < b } -> std::same_as<mask_t<T>>;
  { gonio::select<T>(m, a, b) } -> std::same_as<T>;
  { sqrt(a) } -> std::same_as<T>;
  { exp(a) } -> std::same_as<T>;
  { log(a) } -> std::same_as<T>;
};

template <Real T>
constexpr T square(const T& x) {
  return x * x;
}
/// a where neither is less: of equal ones, of −0 and 0, and where one is NaN.
template <Real T>
constexpr T max(const T& a, const T& b) {
  if constexpr (requires { RealTraits<T>::max(a, b); })
    return RealTraits<T>::max(a, b);
  else
    return select<T>(a < b, b, a);
}
template <Real T>
constexpr T min(const T& a, const T& b) {
  if constexpr (requires { RealTraits<T>::min(a, b); })
    return RealTraits<T>::min(a, b);
  else
    return select<T>(b < a, b, a);
}

/// The one door for constants that are not integers; rounded to the base type first.
template <Real T>
constexpr T constant(long double x) {
  return T(static_cast<base_t<T>>(x));
}
template <Real T>
constexpr T pi() {
  return constant<T>(3.14159265358979323846264338327950288L);
}

/// x as a shader's variable declared `half` or `float` holds it: Mixed alone has both, found by in_half(x), not in_half<T>(x).
template <Real T>
constexpr T in_half(const T& x) {
  return x;
}
template <Real T>
constexpr T in_float(const T& x) {
  return x;
}

}  // namespace gonio::inline GONIO_ARCH
