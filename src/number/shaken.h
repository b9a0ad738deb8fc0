#pragma once
/// \file
/// A number that rounds every operation up or down at random: what moves with the seed was never known.
///
/// + − × ÷ √ give the exact result where it is a number, else one of the two around it, each as often as the other:
/// the result to nearest is on one side of it, and on which its error tells, which is found exactly. exp and log are
/// the library's, which may be the neighbour of either; as often as each of them they stay. [random rounding: Vignes 2004]
///
/// The choice is a hash of the seed, the operation and its operands, not of what was asked before: results are the same
/// whatever the threads, and a formula is still a function of its inputs.
///
/// sum_error and product_error (exact.h) take the same steps in it as in F, each of them shaken: they still find the
/// error to a few eps of it and to eps² of the result. With 0 in their place, as of a number that loses nothing, a
/// formula would lose digits here that no processor loses.
///
/// It has one lane and enters from a column as a register does (batch.h), so that where Batch stands in a loop, it can.

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "number/real.h"

namespace gonio {

/// Seed of all choices, one for all instruction sets: to be set where nothing is being computed.
inline std::atomic<std::uint64_t> shaken_seed = 0;

}  // namespace gonio

namespace gonio::inline GONIO_ARCH {
namespace shaking {

enum class Operation : std::uint64_t { sum = 1, product, quotient, root, exp, log };

/// Random bits, the same for the same operation on the same operands.        [finaliser of SplitMix64: Steele, Lea & Flood 2014]
template <class F>
std::uint64_t draw(Operation operation, F a, F b) {
  using Bits = std::conditional_t<sizeof(F) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
  const auto mix = [](std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  };
  const auto seed =
      shaken_seed.load(std::memory_order_relaxed) * 8 + static_cast<std::uint64_t>(operation);
  return mix(mix(mix(seed) ^ std::bit_cast<Bits>(a)) ^ std::bit_cast<Bits>(b));
}

template <class F>
F above(F x) {
  return std::nextafter(x, std::numeric_limits<F>::infinity());
}
template <class F>
F below(F x) {
  return std::nextafter(x, -std::numeric_limits<F>::infinity());
}

/// One of the two numbers around the exact result.
///
/// \param nearest  one of them
/// \param rest     exact − nearest, of which the sign is looked at alone; NaN where an operand is not finite
template <class F>
F one_of_both(Operation operation, F a, F b, F nearest, F rest) {
  if (!(rest < 0 || 0 < rest)) return nearest;
  const bool up = draw(operation, a, b) >> 63U;
  return rest < 0 ? (up ? nearest : below(nearest)) : (up ? above(nearest) : nearest);
}

/// The library's result or a neighbour of it, not outside the function's range.
template <class F>
F near_library(Operation operation, F x, F result, F low, F high) {
  const auto third = draw(operation, x, F(0)) % 3;
  return std::clamp(third == 0 ? below(result) : third == 1 ? result : above(result), low, high);
}

template <class F>
inline constexpr F eps = std::numeric_limits<F>::epsilon();
/// Magnitude below which an error may be too small to be a number, and the power of 2 by which it then becomes one.
template <class F>
inline constexpr F tiny = std::numeric_limits<F>::min() / eps<F> / eps<F>;
template <class F>
inline constexpr F lift = 1 / (eps<F> * eps<F> * eps<F>);

// Functions of their own: inlined into the loops that ask for them, they would be most of the
// program.

template <class F>
[[gnu::noinline]] F sum(F a, F b) {
  if (std::abs(a) < std::abs(b)) std::swap(a, b);
  const F s = a + b;
  const F rest = b - (s - a);  // exact, as |a| ≥ |b|        [Dekker 1971]
  return one_of_both(Operation::sum, a, b, s, rest);
}

template <class F>
[[gnu::noinline]] F product(F a, F b) {
  if (std::abs(a) < std::abs(b)) std::swap(a, b);
  const F p = a * b;
  const bool small = std::abs(p) < tiny<F>;
  const F rest = p == 0  ? (b == 0 ? F(0) : std::copysign(F(1), p))
                 : small ? std::fma(a, b * lift<F>, -p * lift<F>)
                         : std::fma(a, b, -p);
  return one_of_both(Operation::product, a, b, p, rest);
}

template <class F>
[[gnu::noinline]] F quotient(F a, F b) {
  const F q = a / b;
  const bool small = std::abs(a) < tiny<F>, lift_q = 1 < std::abs(b);
  const F rest = small ? std::fma(lift_q ? -q * lift<F> : -q, lift_q ? b : b * lift<F>, a * lift<F>)
                       : std::fma(-q, b, a);
  return one_of_both(Operation::quotient, a, b, q, std::copysign(F(1), b) * rest);
}

template <class F>
[[gnu::noinline]] F root(F a) {
  const F r = std::sqrt(a), up = a < tiny<F> ? 1 / (eps<F> * eps<F>) : F(1);
  return one_of_both(Operation::root, a, F(0), r, std::fma(-r * up, r * up, a * up * up));
}

template <class F>
[[gnu::noinline]] F exponential(F x) {
  const F y = std::exp(x);
  if (x == 0 || !std::isfinite(x) || std::isinf(y)) return y;
  return near_library(Operation::exp, x, y, F(0),
                      x < 0 ? F(1) : std::numeric_limits<F>::infinity());
}

template <class F>
[[gnu::noinline]] F logarithm(F x) {
  const F y = std::log(x);
  if (x == 1 || !std::isfinite(y)) return y;
  return near_library(Operation::log, x, y, std::numeric_limits<F>::lowest(),
                      std::numeric_limits<F>::max());
}

}  // namespace shaking

template <std::floating_point F>
class Shaken {
 public:
  static constexpr std::size_t size = 1;  ///< lanes

  constexpr Shaken() = default;
  constexpr Shaken(std::same_as<int> auto x)
      : v_(static_cast<F>(x)) {}  // NOLINT: Dual's 1 − x is a register's, too
  explicit constexpr Shaken(std::same_as<F> auto x) : v_(x) {}
  constexpr F value() const { return v_; }
  static constexpr Shaken load_aligned(const F* p) { return Shaken(*p); }
  constexpr void store_aligned(F* p) const { *p = v_; }

  friend Shaken operator+(const Shaken& a, const Shaken& b) {
    return Shaken(shaking::sum(a.v_, b.v_));
  }
  friend Shaken operator-(const Shaken& a, const Shaken& b) {
    return Shaken(shaking::sum(a.v_, -b.v_));
  }
  friend Shaken operator*(const Shaken& a, const Shaken& b) {
    return Shaken(shaking::product(a.v_, b.v_));
  }
  friend Shaken operator/(const Shaken& a, const Shaken& b) {
    return Shaken(shaking::quotient(a.v_, b.v_));
  }
  friend constexpr Shaken operator-(const Shaken& a) { return Shaken(-a.v_); }
  friend Shaken operator+(std::same_as<int> auto s, const Shaken& a) { return Shaken(s) + a; }
  friend Shaken operator+(const Shaken& a, std::same_as<int> auto s) { return a + Shaken(s); }
  friend Shaken operator-(std::same_as<int> auto s, const Shaken& a) { return Shaken(s) - a; }
  friend Shaken operator-(const Shaken& a, std::same_as<int> auto s) { return a - Shaken(s); }
  friend Shaken operator*(std::same_as<int> auto s, const Shaken& a) { return Shaken(s) * a; }
  friend Shaken operator*(const Shaken& a, std::same_as<int> auto s) { return a * Shaken(s); }
  friend Shaken operator/(std::same_as<int> auto s, const Shaken& a) { return Shaken(s) / a; }
  friend Shaken operator/(const Shaken& a, std::same_as<int> auto s) { return a / Shaken(s); }
  friend constexpr bool operator<(const Shaken& a, const Shaken& b) { return a.v_ < b.v_; }
  friend constexpr bool operator<=(const Shaken& a, const Shaken& b) { return a.v_ <= b.v_; }

  friend Shaken sqrt(const Shaken& a) { return Shaken(shaking::root(a.v_)); }
  friend Shaken exp(const Shaken& a) { return Shaken(shaking::exponential(a.v_)); }
  friend Shaken log(const Shaken& a) { return Shaken(shaking::logarithm(a.v_)); }

 private:
  F v_ = 0;
};

template <class F>
struct RealTraits<Shaken<F>> {
  using Base = F;
  using Plain = Shaken<F>;
  using Mask = bool;
  static constexpr Shaken<F> select(bool m, const Shaken<F>& a, const Shaken<F>& b) {
    return m ? a : b;
  }
};

}  // namespace gonio::inline GONIO_ARCH
