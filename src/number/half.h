#pragma once
/// \file
/// IEEE 754 binary16, as a GPU's 16-bit float: 11 significant bits, largest value 65504, normal down
/// to 2⁻¹⁴, subnormal down to 2⁻²⁴, ±∞ and NaN; every operation rounded to the nearest, ties to even.
///
/// The value is held as a float.  A sum, product, quotient or root rounded to float's 24 bits first
/// and to 11 then is the exact one rounded once, because 24 ≥ 2 · 11 + 2      [Figueroa 1995]
/// (and because below 2⁻¹⁴ sums and products are exact, and no quotient comes near a tie).  exp and
/// log are computed in double and rounded once.
///
/// An emulation, and not _Float16: clang before 15 has none on x86, later ones keep float between
/// operations unless told otherwise.
///
/// Drivers are free in two things, which HalfRules names.  A register full of halves (half_lanes.h) is
/// the same class over a register of floats.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "number/exact.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Raised by operations on one half, lowered by whoever asks, as IEEE 754 has them: a finite value became
/// infinite; a value below 2⁻¹⁴ was not exact.
struct HalfFlags {
  bool overflow = false, underflow = false;
};
inline thread_local HalfFlags half_flags;

/// Liberties that drivers take with halves.
struct HalfRules {
  /// Subnormal results become 0, their sign kept: what is below 2⁻¹⁴ after rounding.
  bool flush = false;
  /// a b + c, a b − c and c − a b are rounded once; of two products the first is not rounded.  A product
  /// keeps what it was before it was rounded until it is added, chosen by select or leaves the formula.
  bool contract = false;
};

/// Floats' bits as integers: of a float here, of a register of them in half_lanes.h.
template <class R>
struct BitsOf;
template <>
struct BitsOf<float> {
  using Type = std::uint32_t;
  static constexpr Type of(float x) { return std::bit_cast<Type>(x); }
  static constexpr float as_float(Type bits) { return std::bit_cast<float>(bits); }
  static constexpr Type select(bool m, Type a, Type b) { return m ? a : b; }
};

/// \tparam R  float, or a register of floats
template <class R, HalfRules rules = HalfRules{}>
class HalfOver {
 public:
  using One = HalfOver<float, rules>;
  static constexpr bool is_one = std::same_as<R, float>;

  constexpr HalfOver() = default;
  explicit constexpr HalfOver(std::same_as<int> auto x) : HalfOver(static_cast<float>(x)) {}
  explicit constexpr HalfOver(std::floating_point auto x) {
    if constexpr (is_one)
      v_ = rounded(to_odd(x));
    else
      v_ = R(static_cast<float>(One(x)));
  }
  explicit HalfOver(const std::same_as<One> auto& x) requires(!is_one)
      : v_(static_cast<float>(x)) {}
  explicit HalfOver(const std::same_as<R> auto& x) requires(!is_one) : v_(rounded(x)) {}
  explicit constexpr operator float() const requires is_one { return v_; }
  explicit constexpr operator double() const requires is_one { return static_cast<double>(v_); }
  /// Its values, which floats hold.
  constexpr const R& as_floats() const { return v_; }

  friend constexpr HalfOver operator+(const HalfOver& a, const HalfOver& b) {
    if constexpr (rules.contract) {
      if (a.product_.is) return rounded_once(a.product_.exact, b.v_);
      if (b.product_.is) return rounded_once(b.product_.exact, a.v_);
    }
    return raw(rounded(a.v_ + b.v_));
  }
  friend constexpr HalfOver operator-(const HalfOver& a, const HalfOver& b) {
    if constexpr (rules.contract)
      return a + (-b);
    else
      return raw(rounded(a.v_ - b.v_));
  }
  friend constexpr HalfOver operator*(const HalfOver& a, const HalfOver& b) {
    const R exact = a.v_ * b.v_;  // 22 bits, between 2⁻⁴⁸ and 2³²
    HalfOver p = raw(rounded(exact));
    if constexpr (rules.contract) p.product_ = {exact, true};
    return p;
  }
  friend constexpr HalfOver operator/(const HalfOver& a, const HalfOver& b) {
    return raw(rounded(a.v_ / b.v_));
  }
  friend constexpr HalfOver operator-(const HalfOver& a) {
    HalfOver n = raw(negated(a.v_));
    if constexpr (rules.contract) n.product_ = {negated(a.product_.exact), a.product_.is};
    return n;
  }
  friend constexpr HalfOver operator+(std::same_as<int> auto s, const HalfOver& a) {
    return HalfOver(s) + a;
  }
  friend constexpr HalfOver operator+(const HalfOver& a, std::same_as<int> auto s) {
    return a + HalfOver(s);
  }
  friend constexpr HalfOver operator-(std::same_as<int> auto s, const HalfOver& a) {
    return HalfOver(s) - a;
  }
  friend constexpr HalfOver operator-(const HalfOver& a, std::same_as<int> auto s) {
    return a - HalfOver(s);
  }
  friend constexpr HalfOver operator*(std::same_as<int> auto s, const HalfOver& a) {
    return HalfOver(s) * a;
  }
  friend constexpr HalfOver operator*(const HalfOver& a, std::same_as<int> auto s) {
    return a * HalfOver(s);
  }
  friend constexpr HalfOver operator/(std::same_as<int> auto s, const HalfOver& a) {
    return HalfOver(s) / a;
  }
  friend constexpr HalfOver operator/(const HalfOver& a, std::same_as<int> auto s) {
    return a / HalfOver(s);
  }
  friend constexpr mask_t<R> operator<(const HalfOver& a, const HalfOver& b) { return a.v_ < b.v_; }

  friend HalfOver sqrt(const HalfOver& a) { return raw(rounded(sqrt(a.v_))); }
  friend HalfOver exp(const HalfOver& a) { return function_of<Exp>(a); }
  friend HalfOver log(const HalfOver& a) { return function_of<Log>(a); }

 private:
  friend struct RealTraits<HalfOver>;
  struct Product {
    R exact = R(0.0F);
    bool is = false;  // known when compiled: it depends on the formula alone
  };
  struct Nothing {};

  static constexpr HalfOver raw(const R& value) {
    HalfOver h;
    h.v_ = value;
    return h;
  }
  static constexpr R negated(const R& x) {  // 0 too, which a register's minus may leave as it is
    using Integer = typename BitsOf<R>::Type;
    constexpr auto sign = std::numeric_limits<std::int32_t>::min();
    return BitsOf<R>::as_float(BitsOf<R>::of(x) ^ Integer(sign));
  }
  struct Exp {  // a double holds e^±100, so that the flags are raised
    static double at(float x) {
      return std::exp(std::clamp(static_cast<double>(x), -100.0, 100.0));
    }
  };
  struct Log {
    static double at(float x) { return std::log(static_cast<double>(x)); }
  };
  template <class Function>
  static HalfOver function_of(const HalfOver& a) {
    if constexpr (is_one)
      return HalfOver(Function::at(a.v_));
    else
      return raw(BitsOf<R>::template looked_up<One, Function>(a.v_));
  }

  /// Sum of a product of 22 bits and a half, rounded once: to the odd of the two floats around it first.
  static constexpr HalfOver rounded_once(const R& product, const R& b) {
    const R sum = product + b, rest = sum_error<R>(product, b, sum);
    const R side = rest * sum;  // at least 2⁻¹²⁰
    return raw(rounded(odd<R>(sum, R(0.0F) < side, side < R(0.0F))));
  }

  /// That of the two floats around an exact value, x the nearest of them, whose last bit is set, so
  /// that it is no tie where the exact value is none.                    [Boldo & Melquiond 2008]
  ///
  /// \param outwards, inwards  the exact value lies beyond x, or on this side of it
  template <class F>
  static constexpr F odd(const F& x, const mask_t<F>& outwards, const mask_t<F>& inwards) {
    using Bits = BitsOf<F>;
    using Integer = typename Bits::Type;
    const Integer bits = Bits::of(x);
    return gonio::select<F>(
        outwards, Bits::as_float(bits | Integer(1)),
        gonio::select<F>(inwards, Bits::as_float((bits - Integer(1)) | Integer(1)), x));
  }
  template <class F>
  static constexpr float to_odd(F x) {
    const float f = static_cast<float>(x);
    const F back = static_cast<F>(f);
    const bool less = back < x, more = x < back, positive = F(0) < x;
    return odd<float>(f, positive ? less : more, positive ? more : less);
  }
  static constexpr float to_odd(float x) { return x; }

  static constexpr R rounded(const R& x) {
    using Bits = BitsOf<R>;
    using Integer = typename Bits::Type;
    constexpr std::int32_t infinite = 0x7f80'0000, normal = 0x3880'0000;  // 2⁻¹⁴
    const Integer bits = Bits::of(x), size = bits & Integer(0x7fff'ffff), sign = bits ^ size;
    Integer to;
    if constexpr (requires { Bits::nearest_half(x); }) {
      to = Bits::of(Bits::nearest_half(x)) ^ sign;
    } else {
      constexpr std::int32_t largest = std::bit_cast<std::int32_t>(65504.0F);
      const Integer even = (size + Integer(0xfff) + (size >> 13 & Integer(1))) & Integer(~0x1fff);
      to = Bits::select(even > Integer(largest), Integer(infinite), even);
      // below 2⁻¹⁴ the last digit is 2⁻²⁴, which is that of a float at ½
      to = Bits::select(size < Integer(normal), Bits::of(Bits::as_float(size) + R(0.5F) - R(0.5F)),
                        to);
      to = Bits::select(size > Integer(infinite), size, to);  // NaN
    }
    if constexpr (rules.flush) to = Bits::select(to < Integer(normal), Integer(0), to);
    if constexpr (is_one) {
      if (size < Integer(normal) && to != size) half_flags.underflow = true;
      if (size < Integer(infinite) && to == Integer(infinite)) half_flags.overflow = true;
    }
    return Bits::as_float(to | sign);
  }

  R v_ = R(0.0F);
  [[no_unique_address]] std::conditional_t<rules.contract, Product, Nothing> product_;
};

using Half = HalfOver<float>;

template <class R, HalfRules rules>
struct RealTraits<HalfOver<R, rules>> {
  using Base = HalfOver<float, rules>;  // constants are rounded once, from long double
  using Plain = HalfOver<R, rules>;
  using Mask = mask_t<R>;
  static constexpr Plain select(const Mask& m, const Plain& a, const Plain& b) {
    return Plain::raw(gonio::select<R>(m, a.v_, b.v_));
  }
  /// x in a number with room for a block's constants, which T(…) takes back rounded.
  static constexpr R roomy(const Plain& x) { return x.as_floats(); }
};

template <HalfRules rules>
inline constexpr bool rounds_to_nearest<HalfOver<float, rules>> = true;

}  // namespace gonio::inline GONIO_ARCH

template <gonio::HalfRules rules>
class std::numeric_limits<gonio::HalfOver<float, rules>> {
  using Half = gonio::HalfOver<float, rules>;

 public:
  static constexpr bool is_specialized = true;
  static constexpr int digits = 11, min_exponent = -13, max_exponent = 16;
  static constexpr Half min() { return Half(0x1p-14F); }
  static constexpr Half max() { return Half(65504.0F); }
  static constexpr Half epsilon() { return Half(0x1p-10F); }
};
