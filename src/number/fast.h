#pragma once
/// \file
/// Floats whose divisions, roots, exponentials and logarithms are the fast ones that shaders are compiled to: estimates,
/// sharpened by Newton's steps, and polynomials.  The same formula evaluated with this number says what is lost.
///
/// \tparam R  float, or a register of floats

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "number/batch.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Floats' bits as signed integers.
template <class R>
struct FloatBits;
template <>
struct FloatBits<float> {
  using Type = std::int32_t;
  static Type of(float x) { return std::bit_cast<Type>(x); }
  static float as_float(Type bits) { return std::bit_cast<float>(bits); }
  static float value(Type x) { return static_cast<float>(x); }
};
template <class Arch>
struct FloatBits<xsimd::batch<float, Arch>> {
  using Register = xsimd::batch<float, Arch>;
  using Type = xsimd::batch<std::int32_t, Arch>;
  static Type of(const Register& x) { return xsimd::bitwise_cast<Type>(x); }
  static Register as_float(const Type& bits) { return xsimd::bitwise_cast<Register>(bits); }
  static Register value(const Type& x) { return xsimd::to_float(x); }
};

namespace fast {

/// Way to a reciprocal or a reciprocal root: exact; the processor's own estimate, of 12 bits or 14; or the float's
/// bits subtracted from a constant, which has no instruction of its own.
enum class Way { exact, estimate, bits };

/// a − b as registers subtract, which wrap: bits of a negative float are a negative number.
template <class I>
I difference_of_bits(const I& a, const I& b) {
  if constexpr (std::integral<I>)
    return static_cast<I>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
  else
    return a - b;
}
/// 1/√x to 0.034 from the bits alone.                                     [Lomont 2003]
template <class R>
R rsqrt_bits(const R& x) {
  using Bits = FloatBits<R>;
  using I = typename Bits::Type;
  return Bits::as_float(difference_of_bits(I(0x5f375a86), Bits::of(x) >> 1));
}
/// 1/x, to 0.051 from the bits alone; of a negative x the sign wraps with it.
template <class R>
R rcp_bits(const R& x) {
  using Bits = FloatBits<R>;
  using I = typename Bits::Type;
  return Bits::as_float(difference_of_bits(I(0x7ef311c3), Bits::of(x)));
}

#if defined(__SSE2__)
inline float rsqrt_estimate(float x) {
  return _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set_ss(x)));
}
inline float rcp_estimate(float x) {
  return _mm_cvtss_f32(_mm_rcp_ss(_mm_set_ss(x)));
}
inline __m128 rsqrt_estimate(__m128 x) {
  return _mm_rsqrt_ps(x);
}
inline __m128 rcp_estimate(__m128 x) {
  return _mm_rcp_ps(x);
}
#if defined(__AVX__)
inline __m256 rsqrt_estimate(__m256 x) {
  return _mm256_rsqrt_ps(x);
}
inline __m256 rcp_estimate(__m256 x) {
  return _mm256_rcp_ps(x);
}
#endif
#if defined(__AVX512F__)
inline __m512 rsqrt_estimate(__m512 x) {
  return _mm512_rsqrt14_ps(x);
}
inline __m512 rcp_estimate(__m512 x) {
  return _mm512_rcp14_ps(x);
}
#endif
template <class Arch>
xsimd::batch<float, Arch> rsqrt_estimate(const xsimd::batch<float, Arch>& x) {
  return rsqrt_estimate(x.data);
}
template <class Arch>
xsimd::batch<float, Arch> rcp_estimate(const xsimd::batch<float, Arch>& x) {
  return rcp_estimate(x.data);
}
#else  // a processor without such instructions
template <class R>
R rsqrt_estimate(const R& x) {
  return rsqrt_bits(x);
}
template <class R>
R rcp_estimate(const R& x) {
  return rcp_bits(x);
}
#endif

/// 1/√x of x > 0.  A Newton's step, y (3 − x y²)/2, doubles its digits.
template <Way way, int steps, class R>
R rsqrt(const R& x) {
  if constexpr (way == Way::exact) {
    return R(1.0F) / sqrt(x);
  } else {
    R y = way == Way::bits ? rsqrt_bits(x) : rsqrt_estimate(x);
    const R half = x * R(0.5F);
    for (int i = 0; i < steps; ++i) y = y * (R(1.5F) - half * y * y);
    return y;
  }
}
/// 1/x of x > 0.  A Newton's step, y (2 − x y), doubles its digits.
template <Way way, int steps, class R>
R rcp(const R& x) {
  if constexpr (way == Way::exact) {
    return R(1.0F) / x;
  } else {
    R y = way == Way::bits ? rcp_bits(x) : rcp_estimate(x);
    for (int i = 0; i < steps; ++i) y = y * (R(2.0F) - x * y);
    return y;
  }
}

template <class R, std::size_t n>
R polynomial(const R& x, const float (&c)[n]) {
  R sum(c[n - 1]);
  for (std::size_t i = n - 1; i-- > 0;) sum = sum * x + R(c[i]);
  return sum;
}

/// 2ˣ of x in [−126, 127]: the nearest whole number is the exponent, the rest a polynomial, by Chebyshev's nodes over
/// [−1/2, 1/2].  Degree 2: relative error 2.3e-3, 3: 1.0e-4, 4: 3.7e-6, 5: rounding.
template <int degree, class R>
R exp2(const R& wanted) {
  using Bits = FloatBits<R>;
  using I = typename Bits::Type;
  const R x = gonio::max<R>(R(-126.0F), gonio::min<R>(wanted, R(127.0F)));
  const R whole(12582912.0F);  // 1.5 · 2²³: what is added to it is rounded to a whole number
  const R shifted = x + whole, f = x - (shifted - whole);
  R p;
  if constexpr (degree == 2)
    p = polynomial(f, {1.0F, 0.703601177394F, 0.242035330191F});
  else if constexpr (degree == 3)
    p = polynomial(f, {0.999924556951F, 0.693136733884F, 0.242639478546F, 0.0558382829462F});
  else if constexpr (degree == 4)
    p = polynomial(f, {1.0F, 0.693121045203F, 0.24022349038F, 0.0559219758423F, 0.00966636851539F});
  else
    p = polynomial(f, {1.00000007545F, 0.693147188026F, 0.240221074853F, 0.0555035711422F,
                       0.00967603191832F, 0.00133908633647F});
  return p * Bits::as_float((Bits::of(shifted) << 23) + I(0x3f800000));
}

/// log₂ x of normal x > 0: the exponent, and t p(t) of t = m − 1, m in [√½, √2).  Degree 2 of p: right to 4.0e-3 of
/// t p(t), 4: 8.9e-5, 6: 2.1e-6.
template <int degree, class R>
R log2(const R& x) {
  using Bits = FloatBits<R>;
  using I = typename Bits::Type;
  const I bits = Bits::of(x), from_root = bits - I(0x3f3504f3);
  const I exponent = from_root >> 23;
  const R t = Bits::as_float(bits - (exponent << 23)) - R(1.0F);
  R p;
  if constexpr (degree == 2)
    p = polynomial(t, {1.44450753275F, -0.750233123878F, 0.443646870365F});
  else if constexpr (degree == 4)
    p = polynomial(
        t, {1.44264046428F, -0.72062921586F, 0.485737842443F, -0.389675223792F, 0.250287846961F});
  else
    p = polynomial(t, {1.44269652305F, -0.721360178576F, 0.480613125473F, -0.359524455463F,
                       0.296119557222F, -0.267963870516F, 0.168186591107F});
  return t * p + Bits::value(exponent);
}

/// What of a formula is fast.
struct Rules {
  Way root = Way::exact;
  int root_steps = 0;
  Way quotient = Way::exact;
  int quotient_steps = 0;
  int exp_degree = 0, log_degree = 0;  ///< 0: the library's
};

}  // namespace fast

template <class R, fast::Rules rules>
class Fast {
 public:
  Fast() = default;
  explicit Fast(std::same_as<int> auto x) : v_(static_cast<float>(x)) {}
  explicit Fast(std::same_as<float> auto x) : v_(x) {}
  explicit Fast(const std::same_as<R> auto& x) requires(!std::same_as<R, float>) : v_(x) {}
  const R& value() const { return v_; }

  friend Fast operator+(const Fast& a, const Fast& b) { return raw(a.v_ + b.v_); }
  friend Fast operator-(const Fast& a, const Fast& b) { return raw(a.v_ - b.v_); }
  friend Fast operator*(const Fast& a, const Fast& b) { return raw(a.v_ * b.v_); }
  friend Fast operator/(const Fast& a, const Fast& b) {
    if constexpr (rules.quotient == fast::Way::exact)
      return raw(a.v_ / b.v_);
    else
      return raw(a.v_ * fast::rcp<rules.quotient, rules.quotient_steps>(b.v_));
  }
  friend Fast operator-(const Fast& a) { return raw(-a.v_); }
  friend Fast operator+(std::same_as<int> auto s, const Fast& a) { return Fast(s) + a; }
  friend Fast operator+(const Fast& a, std::same_as<int> auto s) { return a + Fast(s); }
  friend Fast operator-(std::same_as<int> auto s, const Fast& a) { return Fast(s) - a; }
  friend Fast operator-(const Fast& a, std::same_as<int> auto s) { return a - Fast(s); }
  friend Fast operator*(std::same_as<int> auto s, const Fast& a) { return Fast(s) * a; }
  friend Fast operator*(const Fast& a, std::same_as<int> auto s) { return a * Fast(s); }
  friend Fast operator/(std::same_as<int> auto s, const Fast& a) { return Fast(s) / a; }
  friend Fast operator/(const Fast& a, std::same_as<int> auto s) { return raw(a.v_ / Fast(s).v_); }
  friend auto operator<(const Fast& a, const Fast& b) { return a.v_ < b.v_; }

  friend Fast sqrt(const Fast& a) {
    if constexpr (rules.root == fast::Way::exact)
      return raw(sqrt(a.v_));
    else  // 0 has no reciprocal
      return raw(a.v_ * fast::rsqrt<rules.root, rules.root_steps>(
                            gonio::max<R>(a.v_, R(std::numeric_limits<float>::min()))));
  }
  friend Fast rsqrt(const Fast& a) { return raw(fast::rsqrt<rules.root, rules.root_steps>(a.v_)); }
  friend Fast exp(const Fast& a) {
    if constexpr (rules.exp_degree == 0)
      return raw(exp(a.v_));
    else
      return raw(fast::exp2<rules.exp_degree>(a.v_ * R(1.44269504F)));
  }
  friend Fast log(const Fast& a) {
    if constexpr (rules.log_degree == 0)
      return raw(log(a.v_));
    else
      return raw(fast::log2<rules.log_degree>(a.v_) * R(0.693147181F));
  }

 private:
  static Fast raw(const R& v) {
    Fast f;
    f.v_ = v;
    return f;
  }
  R v_ = R(0.0F);
};

template <class R, fast::Rules rules>
struct RealTraits<Fast<R, rules>> {
  using Number = Fast<R, rules>;
  using Base = float;
  using Plain = Number;
  using Mask = mask_t<R>;
  static Number select(const Mask& m, const Number& a, const Number& b) {
    if constexpr (std::same_as<R, float>)
      return m ? a : b;
    else
      return Number(gonio::select<R>(m, a.value(), b.value()));
  }
};

}  // namespace gonio::inline GONIO_ARCH
