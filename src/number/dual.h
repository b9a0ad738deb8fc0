#pragma once
/// \file
/// Forward-mode dual number: a value and its N partial derivatives.
///
///   f(v + Σ dᵢ εᵢ) = f(v) + f'(v) Σ dᵢ εᵢ,   εᵢ εⱼ = 0
///
/// B is a plain number or a batch of them.  Mixing with B keeps zero derivatives out of the
/// arithmetic: no compiler may drop 0·x.
/// \tparam of_angles  a formula's angles are such numbers, too: some of the unknowns move them

#include <array>
#include <type_traits>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

template <class B, std::size_t N, bool of_angles = false>
struct Dual {
  static constexpr std::size_t count = N;
  B v{};
  std::array<B, N> d{};

  constexpr Dual() = default;
  constexpr Dual(B value) : v(value) {}  // NOLINT: a plain number is a dual with no derivatives
  // Exactly int or exactly the base type: a plain Dual(int) would take 0.5 for 0 when B is a batch.
  constexpr explicit Dual(std::same_as<int> auto value) : v(B(static_cast<base_t<B>>(value))) {}
  constexpr explicit Dual(std::same_as<base_t<B>> auto value) requires(!std::same_as<B, base_t<B>>)
      : v(B(value)) {}

  /// The i-th unknown: dᵢ = 1.
  static constexpr Dual variable(B value, std::size_t i) {
    Dual x(value);
    x.d[i] = B(1);
    return x;
  }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return make(a.v + b.v, [&](auto i) { return a.d[i] + b.d[i]; });
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return make(a.v - b.v, [&](auto i) { return a.d[i] - b.d[i]; });
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return make(a.v * b.v, [&](auto i) { return a.d[i] * b.v + a.v * b.d[i]; });
  }
  friend Dual operator/(const Dual& a, const Dual& b) {  // one division for all derivatives
    const B r = 1 / b.v, q = a.v / b.v;
    return make(q, [&](auto i) { return (a.d[i] - q * b.d[i]) * r; });
  }
  friend Dual operator-(const Dual& a) { return chain(-a.v, B(-1), a); }

  friend Dual operator+(const Dual& a, const B& s) {
    return make(a.v + s, [&](auto i) { return a.d[i]; });
  }
  friend Dual operator+(const B& s, const Dual& a) { return a + s; }
  friend Dual operator-(const Dual& a, const B& s) { return a + -s; }
  friend Dual operator-(const B& s, const Dual& a) {
    return make(s - a.v, [&](auto i) { return -a.d[i]; });
  }
  friend Dual operator*(const Dual& a, const B& s) { return chain(a.v * s, s, a); }
  friend Dual operator*(const B& s, const Dual& a) { return a * s; }
  friend Dual operator/(const Dual& a, const B& s) { return chain(a.v / s, 1 / s, a); }
  friend Dual operator/(const B& s, const Dual& a) {
    const B q = s / a.v;
    return chain(q, -(q / a.v), a);
  }

  friend mask_t<B> operator<(const Dual& a, const Dual& b) { return a.v < b.v; }

  /// √(a + ε) ≈ √a + ε / (2 √a)
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const B r = sqrt(a.v);
    return chain(r, 1 / (r + r), a);
  }
  /// exp(a + ε) ≈ exp(a) (1 + ε)
  friend Dual exp(const Dual& a) {
    using std::exp;
    const B r = exp(a.v);
    return chain(r, r, a);
  }
  /// ln(a + ε) ≈ ln a + ε / a
  friend Dual log(const Dual& a) {
    using std::log;
    return chain(log(a.v), 1 / a.v, a);
  }

 private:
  static Dual make(const B& value, auto derivative) {
    Dual r(value);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = derivative(i);
    return r;
  }
  static Dual chain(const B& value, const B& slope, const Dual& a) {
    return make(value, [&](auto i) { return slope * a.d[i]; });
  }
};

template <class B, std::size_t N, bool of_angles>
struct RealTraits<Dual<B, N, of_angles>> {
  using T = Dual<B, N, of_angles>;
  using Base = base_t<B>;
  using Plain = std::conditional_t<of_angles, T, B>;
  using Mask = mask_t<B>;
  static T select(const Mask& m, const T& a, const T& b) {
    T r(RealTraits<B>::select(m, a.v, b.v));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = RealTraits<B>::select(m, a.d[i], b.d[i]);
    return r;
  }
};

}  // namespace gonio::inline GONIO_ARCH
