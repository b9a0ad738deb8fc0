#pragma once
/// \file
/// A number that computes as some machine does that keeps the thread's Rounding: where the rule leaves a choice, it
/// draws.  It knows nothing of intervals, so that an enclosure that it leaves is wrong.

#include <cmath>
#include <limits>
#include <random>

#include "number/enclosure.h"
#include "number/half.h"

namespace gonio::test {

/// Choices of this thread's machines.
inline thread_local std::mt19937_64 machine_choices;
inline bool chance() {
  return machine_choices() >> 63;
}

/// Values of F, by their order: k steps from x.
template <class F>
F stepped(F x, int steps) {
  if constexpr (std::same_as<F, Half>) {
    // From the definition: in units of the last digit of where it stands.
    double v = static_cast<double>(x);
    for (; steps != 0; steps -= steps > 0 ? 1 : -1) {
      const double up = steps > 0 ? 1 : -1;
      int exponent = v == 0 ? -14 : std::max(std::ilogb(v), -14);
      if (v != 0 && v * up < 0 && std::abs(v) == std::ldexp(1.0, exponent) && exponent > -14)
        --exponent;
      if (std::isinf(v)) {
        if (v * up < 0) v = std::copysign(65504.0, v);
        continue;
      }
      v += up * std::ldexp(1.0, exponent - 10);
      if (std::abs(v) >= 65536) v = std::copysign(std::numeric_limits<double>::infinity(), v);
    }
    return Half(v);
  } else {
    for (; steps > 0; --steps) x = std::nextafter(x, std::numeric_limits<F>::infinity());
    for (; steps < 0; ++steps) x = std::nextafter(x, -std::numeric_limits<F>::infinity());
    return x;
  }
}

template <class F>
class AnyMachine {
 public:
  using M = AnyMachine;
  AnyMachine() = default;
  explicit AnyMachine(std::same_as<int> auto x) : v_(static_cast<F>(x)) {}
  explicit AnyMachine(F x) : v_(x) {}
  F value() const { return v_; }
  double in_double() const { return static_cast<double>(v_); }

  friend M operator-(const M& a) {
    M r(-a.v_);
    r.product_ = a.product_;
    r.f_[0] = -a.f_[0];
    r.f_[1] = a.f_[1];
    return r;
  }
  friend M operator+(const M& a, const M& b) {
    const M x = a.read(), y = b.read();
    if (rounding_now.contracted) {
      if (x.product_ && chance()) return fused(x.f_[0], x.f_[1], y.v_);
      if (y.product_ && chance()) return fused(y.f_[0], y.f_[1], x.v_);
    }
    return chosen(x.v_ + y.v_, exact(x.v_) + exact(y.v_));
  }
  friend M operator-(const M& a, const M& b) { return a + -b; }
  friend M operator*(const M& a, const M& b) {
    const M x = a.read(), y = b.read();
    M r = chosen(x.v_ * y.v_, exact(x.v_) * exact(y.v_));
    r.product_ = true;
    r.f_[0] = x.v_;
    r.f_[1] = y.v_;
    return r;
  }
  friend M operator/(const M& a, const M& b) {
    const M x = a.read(), y = b.read();
    if (!rounding_now.any_gpu) return kept(x.v_ / y.v_);
    const Exact d = std::abs(exact(y.v_)), most = is_half ? 0x1p14L : 0x1p126L;
    if (!(1 / most <= d && d <= most)) return anything();
    return within(exact(x.v_) / exact(y.v_), 2.5L, 0, rounding_now.infinities);
  }
  friend M sqrt(const M& a) {
    using std::sqrt;
    const M x = a.read();
    if (!rounding_now.any_gpu) return kept(sqrt(x.v_));
    if (exact(x.v_) == 0) return kept(x.v_);
    if (!(exact(x.v_) > 0)) return anything();
    const M r = within(1 / sqrt(exact(x.v_)), 2, 0);
    return within(1 / exact(r.v_), 2.5L, 0);
  }
  friend M exp(const M& a) {
    using std::exp;
    const M x = a.read();
    if (!rounding_now.any_gpu) return kept(exp(x.v_));
    if (std::isnan(exact(x.v_))) return anything();
    return within(exp(exact(x.v_)), (is_half ? 1 : 3) + 2 * std::abs(exact(x.v_)), 0);
  }
  friend M log(const M& a) {
    using std::log;
    const M x = a.read();
    if (!rounding_now.any_gpu) return kept(log(x.v_));
    const Exact e = exact(x.v_);
    if (!(e > 0)) return anything();
    const bool about_1 = 0.5L <= e && e <= 2;
    return within(log(e), about_1 ? 0 : 3, about_1 ? (is_half ? 0x0.ffp-7L : 0x0.ffp-21L) : 0);
  }
  friend bool operator<(const M& a, const M& b) { return a.read().v_ < b.read().v_; }

  friend M operator+(std::same_as<int> auto s, const M& a) { return M(s) + a; }
  friend M operator+(const M& a, std::same_as<int> auto s) { return a + M(s); }
  friend M operator-(std::same_as<int> auto s, const M& a) { return M(s) - a; }
  friend M operator-(const M& a, std::same_as<int> auto s) { return a - M(s); }
  friend M operator*(std::same_as<int> auto s, const M& a) { return M(s) * a; }
  friend M operator*(const M& a, std::same_as<int> auto s) { return a * M(s); }
  friend M operator/(std::same_as<int> auto s, const M& a) { return M(s) / a; }
  friend M operator/(const M& a, std::same_as<int> auto s) { return a / M(s); }

 private:
  using Exact =
      long double;  // of sums of far floats not quite, but then rounded() is not asked for more
  static constexpr bool is_half = std::same_as<F, Half>;

  static Exact exact(F x) { return static_cast<Exact>(static_cast<double>(x)); }
  static bool is_subnormal(F x) {
    const Exact size = std::abs(exact(x));
    return 0 < size && size < exact(std::numeric_limits<F>::min());
  }
  M read() const {
    M r = *this;
    if (rounding_now.flushed && is_subnormal(v_) && chance())
      r.v_ = F(std::copysign(0.0, in_double()));
    return r;
  }
  /// A result, flushed where that may be.
  static M kept(F x) {
    M r(x);
    if (rounding_now.flushed && is_subnormal(x) && chance())
      r.v_ = F(std::copysign(0.0, static_cast<double>(x)));
    return r;
  }
  static M anything() {
    if (rounding_now.infinities) return M(F(std::nan("")));
    const unsigned k = machine_choices() % 4;
    return M(k == 0   ? F(std::nan(""))
             : k == 1 ? F(std::numeric_limits<float>::infinity())
             : k == 2 ? F(0.0F)
                      : F(-1000.0F));
  }
  /// To nearest; of any GPU that or the neighbour on the other side of what is exact.
  static M chosen(F nearest, Exact x) {
    if (!rounding_now.any_gpu) return kept(nearest);
    if (std::isnan(exact(nearest)) || (std::isinf(exact(nearest)) && !rounding_now.infinities))
      return anything();
    if (std::isinf(exact(nearest))) return M(nearest);
    if (exact(nearest) == x || chance()) return kept(nearest);
    return kept(stepped(nearest, exact(nearest) < x ? 1 : -1));
  }
  static M fused(F a, F b, F c) {
    if constexpr (is_half)
      return chosen(Half(exact(a) * exact(b) + exact(c)), exact(a) * exact(b) + exact(c));
    else
      return chosen(std::fma(a, b, c), std::fma(exact(a), exact(b), exact(c)));
  }
  /// Any value of F that is so near to x.
  static M within(Exact x, Exact ulps, Exact off, bool infinities = false) {
    if (std::isnan(x) || (std::isinf(x) && !infinities)) return anything();
    if (std::isinf(x)) return M(static_cast<F>(x));
    const F near = static_cast<F>(x);
    if (std::isinf(exact(near))) return infinities ? M(near) : anything();
    int exponent = std::numeric_limits<F>::min_exponent - 1;
    if (x != 0) exponent = std::max(exponent, std::ilogb(x));
    if (std::abs(x) == std::ldexp(1.0L, exponent) &&
        exponent >= std::numeric_limits<F>::min_exponent)
      --exponent;
    const Exact error =
        std::max(off, ulps * std::ldexp(1.0L, exponent - std::numeric_limits<F>::digits + 1));
    const Exact share = machine_choices() % 3 == 0
                            ? 1
                            : std::ldexp(static_cast<Exact>(machine_choices() % 1025), -10);
    F y = static_cast<F>(x + (chance() ? share : -share) * error);
    for (const int step : {1, -1})
      while (std::abs(exact(y) - x) > error && (exact(y) < x) == (step > 0) &&
             !std::isinf(exact(y)))
        y = stepped(y, step);
    if (std::abs(exact(y) - x) > error) y = near;
    if (std::isinf(exact(y))) return infinities ? M(y) : anything();
    return kept(y);
  }

  F v_{};
  bool product_ = false;
  F f_[2]{};
};

}  // namespace gonio::test

namespace gonio::inline GONIO_ARCH {

template <class F>
struct RealTraits<test::AnyMachine<F>> {
  using Base = F;
  using Plain = test::AnyMachine<F>;
  using Mask = bool;
  /// Chosen from others it is no product any more (Rounding::contracted).
  static Plain select(bool m, const Plain& a, const Plain& b) { return Plain((m ? a : b).value()); }
};

}  // namespace gonio::inline GONIO_ARCH

template <class F>
class std::numeric_limits<gonio::test::AnyMachine<F>> : public std::numeric_limits<F> {};
