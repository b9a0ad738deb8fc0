#pragma once
/// \file
/// Smith masking for Student's t distribution of slopes (ndf.student_t), whose tail is τ.
///
/// 1. Along one direction the slopes q, in widths α, have the density p(q) = k (1 + τ q²)^−(1/2 + 1/τ), and with a = c/(α s),
///    c = cos θ and s = sin θ of a direction,
///
///       c Λ(c) = α s K(a),   K(a) = ∫ₐ^∞ (q − a) p(q) dq                            [Heitz 2014, Eq. 72 and 73]
///
///    Ribardière gives K by a hypergeometric function.
///
/// 2. Student's t is a mixture of normal distributions, whose K is ierfc(a)/2, an integral itself (number/special.h); the
///    order changed, the mixture is summed on paper:
///
///       K(a) = (1/2π) ∫ u²/(u² + a²) (1 + τ (a² + u²))^(−1/τ) du        over all u
///
/// 3. With 1 + τ a² for a factor, b² = a²/(1 + τ a²), and u = √(1 + τ a²) g(t), τ g² = e^(τt²) − 1, the power of u becomes e^(−t²)
///    whatever τ: the integrand falls off as e^(−(1 − τ/2) t²), and but for the pole at t = iA it is analytic up to √(π/τ) from
///    the axis.  The trapezoidal rule with the pole accounted for, as for ierfc, is
///
///       ┌─────────────────────────────────────────────────────────────────────────────┐
///       │  K = (h/π) √(1 + τa²) e^(−A²) Σₙ mₙ/(1 + b² qₙ) + a/(e^(2πA/h) − 1)          │
///       │  A² = ln(1 + τa²)/τ,   tₙ = n h, n ≥ 1                                        │
///       │  mₙ = e^(−(1 − τ/2) tₙ²)/√E(−τtₙ²),   qₙ = 1/g² = e^(−τtₙ²)/(tₙ² E(−τtₙ²))   │
///       └─────────────────────────────────────────────────────────────────────────────┘
///
///    with E(z) = (eᶻ − 1)/z.  Every part is positive, m and q depend on τ alone, and τ = 0 is Beckmann's.

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "brdf/formula/masking.h"
#include "brdf/formula/widths.h"
#include "number/special.h"

namespace gonio::inline GONIO_ARCH {

/// c Λ(c) of the file's head; 0 where c = 1.
///
/// K is off by at most 2e-11 of itself for τ ≤ 1 (4e-21 at τ = 0), and from there on by 2e-9.
template <Real T>
struct StudentCLambda {
  using P = plain_t<T>;
  static constexpr std::size_t n = 20;
  static constexpr long double step = 0.4375L;

  T alpha, tail;
  std::array<T, n> m, q;

  explicit StudentCLambda(std::span<const T, 2> p)
      : StudentCLambda(p, std::make_index_sequence<n>()) {}

  T operator()(const P& c) const {
    const T w = alpha * sine_of(c);
    const T a = c / max<T>(w, T(c * constant<P>(least_ratio)));
    const T a2 = square(a), x = tail * a2, grown = 1 + x, b2 = a2 / grown;
    T sum(0);
    for (std::size_t k = n; k-- > 0;) sum = sum + m[k] / (1 + b2 * q[k]);
    const T l = log1p_over<T>(x), root_l = sqrt(l);
    const P end = pi<P>() / constant<P>(step),
            far = constant<P>(5);  // there the pole is 1e-20 of K
    const T depth = min<T>(a * root_l, T(far));
    const T pole = 1 / root_l * (1 / (2 * end * expm1_over<T>(2 * end * depth)));
    return w * (sqrt(grown) * exp(-(a2 * l)) * sum / end + select<T>(depth < T(far), pole, T(0)));
  }

 private:
  /// a is not looked for beyond 2³⁰, where K is 0 to a digit; in half, of which that has no square, 2⁷.
  static constexpr long double least_ratio =
      std::numeric_limits<base_t<T>>::max_exponent < 100 ? 0x1p-7L : 0x1p-30L;

  template <std::size_t... k>
  StudentCLambda(std::span<const T, 2> p, std::index_sequence<k...>)
      : alpha(p[0]), tail(p[1]), m{weight(p[1], k + 1)...}, q{per_g2(p[1], k + 1)...} {}

  static constexpr long double t2(std::size_t k) {
    return step * step * static_cast<long double>(k * k);
  }
  static T weight(const T& tau, std::size_t k) {
    const P t = constant<P>(t2(k));
    return exp(-((1 - tau / 2) * t)) / sqrt(expm1_over<T>(-(tau * t)));
  }
  static T per_g2(const T& tau, std::size_t k) {
    const P t = constant<P>(t2(k));
    return exp(-(tau * t)) / (expm1_over<T>(-(tau * t)) * t);
  }
};

/// Smith masking for Student's t, light and view independent.
///
///   V = 1 / (4 (NoL + cΛ(NoL)) (NoV + cΛ(NoV)))
template <Real T>
struct SmithStudentSeparable {
  static constexpr About about{
      "masking.smith_student_t.separable", "Smith for Student's t, separable",
      "G2 = G1(NoL) G1(NoV), G1 = 1/(1 + Λ), Λ of the slopes of ndf.student_t",
      "Ribardière et al. 2017, STD; Heitz 2014, Eq. 72"};
  static constexpr std::array parameters{alpha_parameter, tail_parameter};

  StudentCLambda<T> c_lambda;

  explicit SmithStudentSeparable(std::span<const T, 2> p) : c_lambda(p) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return lambda_separable<T>(c_lambda(a.nol) + a.nol, c_lambda(a.nov) + a.nov);
  }
};

/// Smith masking for Student's t, correlated through the height of the facet.
///
///   V = 1 / (4 (NoL NoV + NoV cΛ(NoL) + NoL cΛ(NoV)))
template <Real T>
struct SmithStudentCorrelated {
  static constexpr About about{"masking.smith_student_t.correlated",
                               "Smith for Student's t, height-correlated",
                               "G2 = 1/(1 + Λ(l) + Λ(v)), Λ of the slopes of ndf.student_t",
                               "Ribardière et al. 2017, STD; Heitz 2014, Eq. 99"};
  static constexpr std::array parameters{alpha_parameter, tail_parameter};

  StudentCLambda<T> c_lambda;

  explicit SmithStudentCorrelated(std::span<const T, 2> p) : c_lambda(p) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return lambda_correlated<T>(a, c_lambda(a.nol), c_lambda(a.nov));
  }
};

}  // namespace gonio::inline GONIO_ARCH
