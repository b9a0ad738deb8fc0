#pragma once
/// \file
/// A shader's arithmetic with `half` and `float` in one expression: a number that knows which of
/// the two it is, or that it is a literal.
///
///   half ∘ half        half, rounded (half.h)
///   half ∘ float       float: the half is widened, which is exact
///   literal ∘ x        the literal is rounded to the precision of x first
///   literal ∘ literal  literal, in double, as a compiler folds it
///
/// These are HLSL's promotions, and for literals also GLSL's.  A variable's declared type rounds or
/// widens what is assigned to it; a formula that ships with such a variable says so by in_half or
/// in_float (real.h).

#include <algorithm>
#include <functional>

#include "number/exact.h"
#include "number/half.h"

namespace gonio::inline GONIO_ARCH {

class Mixed {
 public:
  enum class Precision { literal, half, single };

  Mixed() = default;
  explicit Mixed(std::same_as<int> auto literal) : v_(static_cast<double>(literal)) {}
  explicit Mixed(double literal) : v_(literal) {}
  explicit Mixed(long double literal) : v_(static_cast<double>(literal)) {}
  explicit Mixed(float x) : v_(static_cast<double>(x)), precision_(Precision::single) {}
  explicit Mixed(Half x) : v_(static_cast<double>(x)), precision_(Precision::half) {}
  double value() const { return v_; }
  Precision precision() const { return precision_; }

  /// f(a) in the precision of a; f(a, b) in the higher of theirs.
  template <class R = Mixed>
  static R apply(auto&& f, const Mixed& a) {
    if (a.precision_ == Precision::half) return R(f(Half(a.v_)));
    if (a.precision_ == Precision::single) return R(f(static_cast<float>(a.v_)));
    return R(f(a.v_));
  }
  template <class R = Mixed>
  static R apply(auto&& f, const Mixed& a, const Mixed& b) {
    return apply<R>([&]<class X>(X x) { return f(x, static_cast<X>(b.v_)); },
                    Mixed(a.v_, std::max(a.precision_, b.precision_)));
  }

  friend Mixed operator+(const Mixed& a, const Mixed& b) { return apply(std::plus<>(), a, b); }
  friend Mixed operator-(const Mixed& a, const Mixed& b) { return apply(std::minus<>(), a, b); }
  friend Mixed operator*(const Mixed& a, const Mixed& b) {
    return apply(std::multiplies<>(), a, b);
  }
  friend Mixed operator/(const Mixed& a, const Mixed& b) { return apply(std::divides<>(), a, b); }
  friend Mixed operator-(const Mixed& a) { return apply(std::negate<>(), a); }
  friend Mixed operator+(std::same_as<int> auto s, const Mixed& a) { return Mixed(s) + a; }
  friend Mixed operator+(const Mixed& a, std::same_as<int> auto s) { return a + Mixed(s); }
  friend Mixed operator-(std::same_as<int> auto s, const Mixed& a) { return Mixed(s) - a; }
  friend Mixed operator-(const Mixed& a, std::same_as<int> auto s) { return a - Mixed(s); }
  friend Mixed operator*(std::same_as<int> auto s, const Mixed& a) { return Mixed(s) * a; }
  friend Mixed operator*(const Mixed& a, std::same_as<int> auto s) { return a * Mixed(s); }
  friend Mixed operator/(std::same_as<int> auto s, const Mixed& a) { return Mixed(s) / a; }
  friend Mixed operator/(const Mixed& a, std::same_as<int> auto s) { return a / Mixed(s); }
  friend bool operator<(const Mixed& a, const Mixed& b) { return apply<bool>(std::less<>(), a, b); }

  friend Mixed sqrt(const Mixed& a) {
    return apply([](auto x) { return sqrt(x); }, a);
  }
  friend Mixed exp(const Mixed& a) {
    return apply([](auto x) { return exp(x); }, a);
  }
  friend Mixed log(const Mixed& a) {
    return apply([](auto x) { return log(x); }, a);
  }

  friend Mixed in_half(const Mixed& a) { return Mixed(Half(a.v_)); }
  friend Mixed in_float(const Mixed& a) { return Mixed(static_cast<float>(a.v_)); }

 private:
  Mixed(double v, Precision p) : v_(v), precision_(p) {}

  double v_ = 0;
  Precision precision_ = Precision::literal;
};

template <>
struct RealTraits<Mixed> {
  using Base = Mixed;
  using Plain = Mixed;
  using Mask = bool;
  static Mixed select(bool m, Mixed a, Mixed b) {
    return Mixed::apply([m](auto x, auto y) { return m ? x : y; }, a, b);
  }
};

template <>
inline constexpr bool computes_as_base<Mixed> = false;

}  // namespace gonio::inline GONIO_ARCH

/// A literal must serve as a float too.
template <>
class std::numeric_limits<gonio::Mixed> : public std::numeric_limits<float> {};
