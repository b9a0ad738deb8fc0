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

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Raised by operations, lowered by whoever asks, as IEEE 754 has them: a finite value became infinite;
/// a value below 2⁻¹⁴ was not exact.
struct HalfFlags {
  bool overflow = false, underflow = false;
};
inline thread_local HalfFlags half_flags;

class Half {
 public:
  constexpr Half() = default;
  explicit constexpr Half(std::same_as<int> auto x) : v_(rounded(static_cast<float>(x))) {}
  explicit constexpr Half(std::floating_point auto x) : v_(rounded(to_odd(x))) {}
  explicit constexpr operator float() const { return v_; }
  explicit constexpr operator double() const { return static_cast<double>(v_); }

  friend constexpr Half operator+(Half a, Half b) { return Half(a.v_ + b.v_); }
  friend constexpr Half operator-(Half a, Half b) { return Half(a.v_ - b.v_); }
  friend constexpr Half operator*(Half a, Half b) { return Half(a.v_ * b.v_); }
  friend constexpr Half operator/(Half a, Half b) { return Half(a.v_ / b.v_); }
  friend constexpr Half operator-(Half a) { return Half(-a.v_); }
  friend constexpr Half operator+(std::same_as<int> auto s, Half a) { return Half(s) + a; }
  friend constexpr Half operator+(Half a, std::same_as<int> auto s) { return a + Half(s); }
  friend constexpr Half operator-(std::same_as<int> auto s, Half a) { return Half(s) - a; }
  friend constexpr Half operator-(Half a, std::same_as<int> auto s) { return a - Half(s); }
  friend constexpr Half operator*(std::same_as<int> auto s, Half a) { return Half(s) * a; }
  friend constexpr Half operator*(Half a, std::same_as<int> auto s) { return a * Half(s); }
  friend constexpr Half operator/(std::same_as<int> auto s, Half a) { return Half(s) / a; }
  friend constexpr Half operator/(Half a, std::same_as<int> auto s) { return a / Half(s); }
  friend constexpr bool operator<(Half a, Half b) { return a.v_ < b.v_; }

  friend Half sqrt(Half a) { return Half(std::sqrt(a.v_)); }
  friend Half exp(Half a) {  // a double holds e^±100, so that the flags are raised
    return Half(std::exp(std::clamp(static_cast<double>(a.v_), -100.0, 100.0)));
  }
  friend Half log(Half a) { return Half(std::log(static_cast<double>(a.v_))); }

 private:
  /// To float without spoiling the rounding that follows: of the two floats around x the one whose
  /// last bit is set, so that it is no tie where x is none.           [Boldo & Melquiond 2008]
  template <class F>
  static constexpr float to_odd(F x) {
    const float f = static_cast<float>(x);
    const auto bits = std::bit_cast<std::uint32_t>(f);
    const F back = static_cast<F>(f);
    if (!(back < x || x < back) || (bits & 1)) return f;
    const bool outwards = (back < x) == (F(0) < x);
    return std::bit_cast<float>(outwards ? bits + 1 : bits - 1);
  }
  static constexpr float to_odd(float x) { return x; }

  static constexpr float rounded(float x) {
    constexpr std::uint32_t largest = std::bit_cast<std::uint32_t>(65504.0F);
    const auto bits = std::bit_cast<std::uint32_t>(x), sign = bits & 0x8000'0000,
               size = bits ^ sign;
    if (size > 0x7f80'0000) return x;  // NaN
    std::uint32_t to = 0;
    if (size < 0x3880'0000) {  // below 2⁻¹⁴: the last digit is 2⁻²⁴, which is that of a float at ½
      to = std::bit_cast<std::uint32_t>(std::bit_cast<float>(size) + 0.5F - 0.5F);
      if (to != size) half_flags.underflow = true;
    } else {
      to = (size + 0xfff + (size >> 13 & 1)) & ~0x1fffU;
      if (to > largest) {
        if (size < 0x7f80'0000) half_flags.overflow = true;
        to = 0x7f80'0000;
      }
    }
    return std::bit_cast<float>(to | sign);
  }

  float v_ = 0;
};

template <>
struct RealTraits<Half> {
  using Base = Half;  // constants are rounded once, from long double
  using Plain = Half;
  using Mask = bool;
  static constexpr Half select(bool m, Half a, Half b) { return m ? a : b; }
};

}  // namespace gonio::inline GONIO_ARCH

template <>
class std::numeric_limits<gonio::Half> {
 public:
  static constexpr bool is_specialized = true;
  static constexpr int digits = 11, min_exponent = -13, max_exponent = 16;
  static constexpr gonio::Half min() { return gonio::Half(0x1p-14F); }
  static constexpr gonio::Half max() { return gonio::Half(65504.0F); }
  static constexpr gonio::Half epsilon() { return gonio::Half(0x1p-10F); }
};
