#pragma once
/// \file
/// The functions that shaders call and that not every Real has: pow, sin, floor … for each number that a program runs in.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "number/batch.h"
#include "number/counted.h"
#include "number/enclosure.h"
#include "number/half.h"
#include "number/mixed.h"
#ifdef GONIO_SHAKEN
#include "number/shaken.h"
#endif

namespace gonio::foreign::inline GONIO_ARCH {

/// Names of these functions, each of one number or of two.
enum class Call { pow, atan2, exp2, log2, sin, cos, asin, acos, atan, floor };

template <class F>
F called(Call f, const F& x, const F& y) {
  using std::pow, std::atan2, std::exp2, std::log2, std::sin, std::cos, std::asin, std::acos,
      std::atan, std::floor;
  switch (f) {
    case Call::pow:
      return pow(x, y);
    case Call::atan2:
      return atan2(x, y);
    case Call::exp2:
      return exp2(x);
    case Call::log2:
      return log2(x);
    case Call::sin:
      return sin(x);
    case Call::cos:
      return cos(x);
    case Call::asin:
      return asin(x);
    case Call::acos:
      return acos(x);
    case Call::atan:
      return atan(x);
    case Call::floor:
      break;
  }
  return floor(x);
}

/// Plain numbers, and those that have the functions themselves: a register, fifty digits.
template <class T>
struct Functions {
  static auto less_equal(const T& a, const T& b) { return a <= b; }
  static auto equal(const T& a, const T& b) { return a == b; }
  template <Call f>
  static T call(const T& x, const T& y) {
    // The library of fifty digits never returns from a power whose exponent is no number.
    if constexpr (!std::floating_point<T> && requires { bool(x != x); }) {
      if (x != x) return x;
      if (f == Call::pow && y != y) return y;
    }
    if constexpr (f == Call::exp2 && !requires { exp2(x); } && !std::floating_point<T>)
      return pow(T(2), x);
    else if constexpr (f == Call::log2 && !requires { log2(x); } && !std::floating_point<T>)
      return log(x) / log(T(2));
    else
      return one<f>(x, y);
  }

 private:
  template <Call f>
  static T one(const T& x, const T& y) {
    using std::pow, std::atan2, std::exp2, std::log2, std::sin, std::cos, std::asin, std::acos,
        std::atan, std::floor;
    if constexpr (f == Call::pow)
      return pow(x, y);
    else if constexpr (f == Call::atan2)
      return atan2(x, y);
    else if constexpr (f == Call::exp2)
      return exp2(x);
    else if constexpr (f == Call::log2)
      return log2(x);
    else if constexpr (f == Call::sin)
      return sin(x);
    else if constexpr (f == Call::cos)
      return cos(x);
    else if constexpr (f == Call::asin)
      return asin(x);
    else if constexpr (f == Call::acos)
      return acos(x);
    else if constexpr (f == Call::atan)
      return atan(x);
    else
      return floor(x);
  }
};

/// Halves, one or a register: computed in double, rounded once.
template <class R, HalfRules rules>
struct Functions<HalfOver<R, rules>> {
  using T = HalfOver<R, rules>;
  using Traits = RealTraits<T>;
  static auto less_equal(const T& a, const T& b) { return Traits::roomy(a) <= Traits::roomy(b); }
  static auto equal(const T& a, const T& b) { return Traits::roomy(a) == Traits::roomy(b); }
  template <Call f>
  static T call(const T& x, const T& y) {
    using One = HalfOver<float, rules>;
    const auto at = [](float a, float b) {
      return static_cast<float>(
          One(called<double>(f, static_cast<double>(a), static_cast<double>(b))));
    };
    if constexpr (T::is_one) {
      return T(at(static_cast<float>(x), static_cast<float>(y)));
    } else {
      alignas(64) std::array<float, R::size> a, b;
      Traits::roomy(x).store_aligned(a.data());
      Traits::roomy(y).store_aligned(b.data());
      for (std::size_t k = 0; k < a.size(); ++k) a[k] = at(a[k], b[k]);
      return T(R::load_aligned(a.data()));
    }
  }
};

template <>
struct Functions<Mixed> {
  static bool less_equal(const Mixed& a, const Mixed& b) {
    return Mixed::apply<bool>(
        [](auto x, auto y) { return Functions<decltype(x)>::less_equal(x, y); }, a, b);
  }
  static bool equal(const Mixed& a, const Mixed& b) { return less_equal(a, b) && less_equal(b, a); }
  template <Call f>
  static Mixed call(const Mixed& x, const Mixed& y) {
    const auto of = [](auto a, auto b) { return Functions<decltype(a)>::template call<f>(a, b); };
    if constexpr (f == Call::pow || f == Call::atan2)
      return Mixed::apply(of, x, y);
    else
      return Mixed::apply([&](auto a) { return of(a, a); }, x);
  }
};

/// Operations of a call: a power is a logarithm, a product and an exponential, all others count as one exponential, floor as an
/// addition; a comparison is one.
template <class B>
struct Functions<Counted<B>> {
  using T = Counted<B>;
  static auto less_equal(const T& a, const T& b) { return !(b < a); }
  static auto equal(const T& a, const T& b) { return !(b < a); }
  template <Call f>
  static T call(const T& x, const T& y) {
    if constexpr (f == Call::pow)
      return exp(y * log(x));
    else if constexpr (f == Call::floor)
      return x + 0;
    else
      return exp(x);
  }
};

/// All values over a box: monotone functions at their ends, some units of F outwards.
template <class F>
struct Functions<Enclosure<F>> {
  using T = Enclosure<F>;
  static EnclosureMask less_equal(const T& a, const T& b) {
    if (!a.may_be_nan() && !b.may_be_nan()) return !(b < a);
    return {a.low() <= b.high(), true};
  }
  static EnclosureMask equal(const T& a, const T& b) {
    const bool same = a.low() == a.high() && b.low() == b.high() && a.low() == b.low() &&
                      !a.may_be_nan() && !b.may_be_nan();
    return {a.low() <= b.high() && b.low() <= a.high(), !same};
  }
  template <Call f>
  static T call(const T& x, const T& y) {
    const auto at = [](double v) { return called<double>(f, v, v); };
    if constexpr (f == Call::pow) return power(x, y);
    if constexpr (f == Call::atan2)
      return between(-3.1416, 3.1416, x.may_be_nan() || y.may_be_nan());
    if constexpr (f == Call::sin || f == Call::cos) return between(-1, 1, !x.is_finite());
    if constexpr (f == Call::asin || f == Call::acos) {
      const bool outside = x.may_be_nan() || x.low() < -1 || x.high() > 1;
      const double low = at(std::clamp(x.low(), -1.0, 1.0)),
                   high = at(std::clamp(x.high(), -1.0, 1.0));
      return between(std::min(low, high), std::max(low, high), outside);
    }
    if constexpr (f == Call::log2)
      return between(at(std::max(x.low(), 0.0)), at(std::max(x.high(), 0.0)),
                     x.may_be_nan() || x.low() < 0);
    return between(at(x.low()), at(x.high()), x.may_be_nan());
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// [low, high], wider by what any library or driver may be off: 2⁻⁹ of half, 2⁻¹⁶ of others, and a step.
  static T between(double low, double high, bool nan) {
    const double slack = std::numeric_limits<F>::digits < 24 ? 0x1p-9 : 0x1p-16;
    low = outwards(low - slack * std::abs(low), -infinity);
    high = outwards(high + slack * std::abs(high), infinity);
    T r = T::between(static_cast<F>(low), static_cast<F>(high));
    if (nan) {
      const T all = T::between(static_cast<F>(-infinity), static_cast<F>(infinity));
      r = r + (all - all);  // ∞ − ∞
    }
    return r;
  }
  static double outwards(double x, double to) {
    if (!std::isfinite(x)) return x;
    const double held = static_cast<double>(static_cast<F>(x));
    return T::after(held, to);
  }
  /// GLSL leaves the power of a negative number open, and 0⁰ and 0 to a negative power.
  static T power(const T& x, const T& y) {
    double low = infinity, high = -infinity;
    for (const double a : {std::max(x.low(), 0.0), std::max(x.high(), 0.0)})
      for (const double b : {y.low(), y.high()}) {
        const double v = std::pow(a, b);
        low = std::min(low, v);
        high = std::max(high, v);
      }
    const bool at_0 = x.low() <= 0 && y.low() <= 0;
    if (at_0) high = infinity;
    return between(std::max(low, 0.0), high,
                   x.may_be_nan() || y.may_be_nan() || x.low() < 0 || at_0);
  }
};

#ifdef GONIO_SHAKEN
template <class F>
struct Functions<Shaken<F>> {
  using T = Shaken<F>;
  static auto less_equal(const T& a, const T& b) { return !(b < a); }
  static auto equal(const T& a, const T& b) { return !(b < a) && !(a < b); }
  template <Call f>
  static T call(const T& x, const T& y) {
    return T(called<F>(f, x.value(), y.value()));
  }
};
#endif

}  // namespace gonio::foreign::inline GONIO_ARCH
