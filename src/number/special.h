#pragma once
/// \file
/// Functions beyond those that every Real has, made of them, and right to the last digits of whatever
/// number they are evaluated with: lengths of sums come from the number of its digits.

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Significant bits of a number; Half, which has fewer than float, is served as float is.
template <Real T>
inline constexpr int digits = std::max(24, std::numeric_limits<base_t<T>>::digits);

/// Lower bound for the input of a division or a logarithm that would be 0: the smallest number whose square
/// and whose reciprocal's square are normal numbers.  Too small to matter, but for Half, of which it is 2⁻⁶.
template <Real T>
T small() {
  constexpr int exponent = std::max(std::numeric_limits<base_t<T>>::min_exponent / 2, -510);
  return constant<T>(std::ldexp(1.0L, exponent));
}
/// Upper bound for a factor of what may be 0: the greatest number, of those that double holds.
template <Real T>
T most() {
  constexpr int exponent = std::min(std::numeric_limits<base_t<T>>::max_exponent, 1024);
  constexpr int bits = std::min(std::numeric_limits<base_t<T>>::digits, 53);
  return constant<T>(std::ldexp(1 - std::ldexp(1.0L, -bits), exponent));
}
/// Lower bound for a square that is divided by: small<T>() where that is below 2⁻¹⁴; in Half that, its least normal
/// number.  The reciprocal is finite, its square only where small<T>() is small.
template <Real T>
T small_square() {
  return min<T>(small<T>(), constant<T>(0x1p-14L));
}
/// Lower bound for a divisor that would be 0, where nothing but the quotient is needed, and no square of it: the least
/// normal number, whose reciprocal is finite too.
template <Real T>
T least() {
  constexpr int exponent = std::max(std::numeric_limits<base_t<T>>::min_exponent - 1, -1022);
  return constant<T>(std::ldexp(1.0L, exponent));
}

/// E(z) = (eᶻ − 1)/z, continued through z = 0 by its series, where the difference would cancel.
template <Real T>
T expm1_over(const T& z) {
  constexpr int terms = digits<T> <= 53 ? 15 : digits<T> / 4;  // |z| ≤ 1/2:  2^−terms / terms!
  T series(1);
  for (int k = terms; k >= 2; --k) series = 1 + series * z / constant<T>(k);
  const auto far = constant<T>(0.5L) < max<T>(z, -z);
  const T safe = select<T>(far, z, T(1));
  return select<T>(far, (exp(safe) - 1) / safe, series);
}

/// 1/n, of narrow numbers known when compiled.
template <Real T>
T reciprocal(int n) {
  if constexpr (std::numeric_limits<long double>::digits < digits<T>)
    return 1 / constant<T>(n);
  else
    return constant<T>(1.0L / n);
}

/// ln(1 + x)/x of x ≥ 0, continued through x = 0: twice the series of artanh x/(x + 2), where the quotient would be 0/0.
template <Real T>
T log1p_over(const T& x) {
  constexpr int terms = digits<T> / 4 + 1;  // (x/(x + 2))² ≤ 1/25
  const auto far = constant<T>(0.5L) < x;
  const T near = select<T>(far, T(0), x), z2 = square(near / (2 + near));
  T series = reciprocal<T>(2 * terms + 1);
  for (int k = terms - 1; k >= 0; --k) series = reciprocal<T>(2 * k + 1) + series * z2;
  const T safe = select<T>(far, x, T(1));
  return select<T>(far, log(1 + safe) / safe, series * 2 / (2 + near));
}

/// arcsin x of 0 ≤ x ≤ 1, given with c = √(1 − x²):  8 arctan t of t = tan(arcsin(x)/8), where t ≤ 0.2.
template <Real T>
T arcsin(const T& x, const T& c) {
  constexpr int terms = digits<T> / 4 + 1;
  const auto half = [](const T& t) { return t / (1 + sqrt(1 + square(t))); };
  const T t = half(half(x / (1 + c))), t2 = square(t);
  T series = reciprocal<T>(2 * terms + 1);
  for (int k = terms - 1; k >= 0; --k) series = reciprocal<T>(2 * k + 1) - series * t2;
  return series * t * 8;
}

/// ln u of u > 0 given with u − 1, which of u alone would have lost its digits near 1:
/// ln u / (u − 1) is smooth there, whatever u lost.                      [after Kahan's log1p]
template <Real T>
T log_near_one(const T& u, const T& u_minus_1) {
  const T d = u - 1;
  const auto apart = d < T(0) || T(0) < d;
  const T l = log(u);
  const T ratio = select<T>(apart, l / select<T>(apart, d, T(1)), T(1));
  return select<T>(constant<T>(0.5L) < max<T>(u_minus_1, -u_minus_1), l, u_minus_1 * ratio);
}

/// ierfc(a) = ∫ₐ^∞ erfc(t) dt = e^(−a²)/√π − a erfc(a) for a ≥ 0, a few eps from it however small.
///
/// The difference cancels for large a; of the integral
///
///   ierfc(a) = e^(−a²)/π ∫ t² e^(−t²)/(t² + a²) dt  over all t
///
/// nothing does.  The trapezoidal rule with step h errs by e^(−π²/h²) once the pole at t = ia, where
/// it lies below π/h, is accounted for                           [Matta & Reichel 1971, for erfc]:
///
///   ierfc(a) = e^(−a²) (2h/π) Σₙ tₙ² e^(−tₙ²)/(tₙ² + a²) + 2a/(e^(2πa/h) − 1),   tₙ = n h, n ≥ 1
///
/// Every part is positive.  15 terms for double, 9 for float.
template <Real T>
T ierfc(const T& a) {
  using P = plain_t<T>;
  constexpr double bits = digits<T>, nats = bits * std::numbers::ln2 + 10;
  constexpr std::size_t n = static_cast<std::size_t>(nats / std::numbers::pi) + 1;
  struct Nodes {
    std::array<P, n> t2, weight;
    P h, end;  // step; π/h, where the pole is passed
  };
  static const Nodes nodes = [] {
    // Narrow numbers get long double's constants, wide ones their own; h need not be exact.
    const auto fill = [](const auto& h, auto&& number) {
      const auto per_pi = h / pi<std::remove_cvref_t<decltype(h)>>();
      const auto t2 = [&](std::size_t k) { return square(h * static_cast<int>(k + 1)); };
      return [&]<std::size_t... k>(std::index_sequence<k...>) {
        return Nodes{{number(t2(k))...},
                     {number(2 * per_pi * t2(k) * exp(-t2(k)))...},
                     number(h),
                     number(1 / per_pi)};
      }
      (std::make_index_sequence<n>());
    };
    const double h = std::numbers::pi / std::sqrt(nats);
    if constexpr (std::numeric_limits<long double>::digits < digits<T>)
      return fill(P(h), [](const P& x) { return x; });
    else
      return fill(static_cast<long double>(h), [](long double x) { return constant<P>(x); });
  }();

  const T a2 = square(a);
  T sum(0);
  for (std::size_t k = n; k-- > 0;) sum = sum + nodes.weight[k] / (a2 + nodes.t2[k]);
  const T z = 2 * nodes.end * min<T>(a, T(nodes.end));
  const T pole = nodes.h / (pi<P>() * expm1_over<T>(z));
  return exp(-a2) * sum + select<T>(a < T(nodes.end), pole, T(0));
}

}  // namespace gonio::inline GONIO_ARCH
