#pragma once
/// \file
/// Smith masking for GTR at any γ.
///
/// 1. Smith: facets that v sees, at c = cos θ_v, have together the area c seen from v, and all that face it
///    A(c) = ∫ D(m) max(0, v·m) dω, so G₁ = c/A.
///
/// 2. max(0, x) = (x + |x|)/2, and ∫ D(m) v·m dω = c, for D is normalised.  So A = (c + r)/2 with
///
///       r(c) = ∫ D(m) |v·m| dω        over the hemisphere: even and smooth in c, r(1) = 1, r ≥ c
///
///    and G₁ = 2c/(c + r): both forms of masking.h hold for GTR if this r replaces GGX's root
///    √(α² + (1 − α²) c²).
///
/// 3. GTR is a mixture of GGX of widths β from α to 1, by Euler's integral of (1 − x)^−γ.  With E of ndf.h,
///    L = ln α² and 0 < γ < 2
///
///       D_GTR = ∫₀^∞ w(z) D_GGX(β) dz,   β² = α² (1 + z)/(1 + α² z)
///       w = C s z^(1−γ) / ((1 + z) (1 + α² z)),   C = E(L)/E((γ − 1) L),   s = sin π(γ−1) / π(γ−1)
///
///    and so r = ∫ w r_β dz.  With q = α² + (1 − α²) c² and Q = q/α²
///
///       r_β = √(β² + (1 − β²) c²) = α √(z + Q) / √(1 + α² z)
///
/// 4. √(z + Q) = √Q + z/(√(z + Q) + √Q) parts r into √q times a number without c, and the rest P.  As
///    r(1) = 1, where q = 1, that number is 1 − P(1):
///
///       P(q) = α C s ∫₀^∞ z^(2−γ) / ((1 + z) (1 + α² z)^(3/2) (√(z + Q) + √Q)) dz
///
///       ┌────────────────────────────────────┐
///       │  r = max(√q (1 − P(1)) + P(q), c)  │    SmithGtrRoot
///       └────────────────────────────────────┘
///
/// The new factor z makes P good for γ < 3; beyond, it is continued by a loop about the origin instead of
/// the ray.  s = 0 makes γ = 2 GGX to the last digit.  To a sample P is a polynomial of degree 23, whose
/// coefficients are found once from α and γ, in one of two ways on either side of γ = 3 (of_mixture,
/// of_table); where samples share α and γ, as in a block, only that one is computed.
///
/// Accuracy: see SmithGtrRoot.

#include <array>
#include <cstddef>
#include <utility>

#include "brdf/formula/masking.h"
#include "brdf/formula/widths.h"
#include "number/special.h"

namespace gonio::inline GONIO_ARCH {

namespace smith_gtr {

/// Σ cₙ Tₙ(w) by Clenshaw's recurrence, even and odd n apart: two short chains of operations do not
/// wait for each other.  With x = T₂(w):  T₂ₙ(w) = Tₙ(x),  T₂ₙ₊₁(w) = w Wₙ(x), where W is T's
/// recurrence from 1 and 2x − 1.
template <class T, std::size_t N>
T chebyshev_sum(const std::array<T, N>& c, const T& w) {
  static_assert(N % 2 == 0);
  const T x = 2 * (w * w) - 1, x2 = x + x;
  T even = c[N - 2], odd = c[N - 1], even_before(0), odd_before(0);
  for (std::size_t n = N - 4; n > 0; n -= 2) {
    const T e = x2 * even + (c[n] - even_before), o = x2 * odd + (c[n + 1] - odd_before);
    even_before = even;
    odd_before = odd;
    even = e;
    odd = o;
  }
  return (x * even + (c[0] - even_before)) + w * (x2 * odd + (c[1] - odd_before) - odd);
}

/// N zeros; a Real need not have a default constructor.
template <class T, std::size_t N>
std::array<T, N> zeros() {
  return []<std::size_t... K>(std::index_sequence<K...>) {
    return std::array<T, N>{T(static_cast<int>(0 * K))...};
  }
  (std::make_index_sequence<N>{});
}

/// T₀(x) … T_{N−1}(x)
template <std::size_t N, class T>
std::array<T, N> chebyshev(const T& x) {
  auto t = zeros<T, N>();
  t[0] = T(1);
  t[1] = x;
  for (std::size_t n = 2; n < N; ++n) t[n] = (x + x) * t[n - 1] - t[n - 2];
  return t;
}

/// Coefficients of P.
inline constexpr std::size_t terms = 24;

/// Numbers known when compiled.
namespace fixed {

constexpr long double power(long double x, int n) {
  long double y = 1;
  for (int k = 0; k < (n < 0 ? -n : n); ++k) y *= x;
  return n < 0 ? 1 / y : y;
}
constexpr long double sqrt(long double x) {
  long double y = 1;
  while (y * y < x) y *= 2;
  while (y * y > 2 * x) y /= 2;
  for (int k = 0; k < 8; ++k) y = (y + x / y) / 2;
  return y;
}
constexpr long double exp(long double x) {
  long double sum = 1;
  for (int k = 24; k > 0; --k) sum = 1 + sum * x / (32 * k);
  return power(sum, 32);
}
constexpr long double cos(long double x) {  // of [0, π]
  long double sum = 1;
  for (int k = 20; k > 0; --k) sum = 1 - sum * x * x / ((2 * k - 1) * (2 * k));
  return sum;
}
inline constexpr long double pi = 3.14159265358979323846264338327950288L;
inline constexpr long double ln_10_over_3 = 1.20397280432593599262274621776183850L;
inline constexpr long double ln10 = 2.30258509299404568401799145468436421L;

/// Interpolation at the Chebyshev nodes of λ = ln Q over [0, ln 10⁸]: Σᵢ at(n, i) f(Qᵢ) is the n-th
/// coefficient of f.
struct Nodes {
  std::array<long double, terms> q{}, root{};
  std::array<std::array<long double, terms>, terms> at{};

  constexpr Nodes() {
    for (std::size_t i = 0; i < terms; ++i) {
      const long double t = cos(pi * (static_cast<long double>(i) + 0.5L) / terms);
      root[i] = exp(2 * ln10 * (1 + t));
      q[i] = root[i] * root[i];
      long double before = t, now = 1;
      for (std::size_t n = 0; n < terms; ++n) {
        at[n][i] = now * (n == 0 ? 1 : 2) / terms;
        const long double next = 2 * t * now - before;
        before = now;
        now = next;
      }
    }
  }
  constexpr double coefficient(std::size_t n, const std::array<long double, terms>& f) const {
    long double sum = 0;
    for (std::size_t i = 0; i < terms; ++i) sum += at[n][i] * f[i];
    return static_cast<double>(sum);
  }
};

/// The integral over z by the trapezoidal rule in ln z at z = e^k: there the integrand is analytic up
/// to ±iπ, where 1 + z = 0, so the rule errs by about 2e^(−2π²) = 5e-9 of that pole's part.
inline constexpr int first = -7, last = 30;
struct Mixture {
  static constexpr std::size_t count = last - first + 1;
  std::array<double, count> z{};
  std::array<std::array<double, terms>, count> of_node{};
  std::array<double, terms> of_first{}, of_second{};  // powers of the sum below the first node

  constexpr Mixture() {
    const Nodes nodes;
    std::array<long double, terms> f{};
    for (std::size_t k = 0; k < count; ++k) {
      const long double x = exp(first + static_cast<int>(k)), root = sqrt(x);
      z[k] = static_cast<double>(x);
      for (std::size_t i = 0; i < terms; ++i)
        f[i] = x / (1 + x) * root / (sqrt(x + nodes.q[i]) + nodes.root[i]);
      for (std::size_t n = 0; n < terms; ++n) of_node[k][n] = nodes.coefficient(n, f);
    }
    for (std::size_t i = 0; i < terms; ++i) f[i] = 1 / (2 * nodes.root[i]);
    for (std::size_t n = 0; n < terms; ++n) of_first[n] = nodes.coefficient(n, f);
    for (std::size_t i = 0; i < terms; ++i) f[i] /= 4 * nodes.q[i];
    for (std::size_t n = 0; n < terms; ++n) of_second[n] = nodes.coefficient(n, f);
  }
};
inline constexpr Mixture mixture;

#include "brdf/formula/smith_gtr_table.inc"

}  // namespace fixed

/// sin πε / πε = Π (1 − ε²/k²) without its first two factors, for |ε| ≤ 2: six factors, and the rest
/// as e^(−Σ t_m ε^2m / m), t_m = Σ k^−2m over k > 8.  No digit is lost near its zeros.
template <Real T>
T sinc_rest(const T& epsilon2) {
  constexpr long double t[] = {
      0.1175120146940314251345467L,        0.000539066007657517311325587L / 2,
      4.431219440802822487738719e-6L / 3,  4.317325486885005050655577e-8L / 4,
      4.560658116233189783005678e-10L / 5, 5.046924952108181363840771e-12L / 6};
  T sum(0), product(1);
  for (int m = 5; m >= 0; --m) sum = (sum + constant<plain_t<T>>(t[m])) * epsilon2;
  for (int k = 3; k <= 8; ++k) product = product * (1 - epsilon2 / constant<plain_t<T>>(k * k));
  return product * exp(-sum);
}

template <Real T>
using Coefficients = std::array<T, terms>;

/// γ < 3: the integral as it stands, in w = ln Q / ln 10⁴ − 1, where r has no singularity nearer than
/// ±2πi of the ends of ln Q.  The sum at the nodes is one matrix; what lies below the first node is
/// two terms of the integrand's series, summed on paper (the first has the pole at γ = 3 that s
/// cancels), what lies above the last is a constant.
template <Real T>
Coefficients<T> of_mixture(const T& alpha, const T& gamma) {
  using P = plain_t<T>;
  const auto c = [](long double x) { return constant<P>(x); };
  const T alpha2 = square(alpha), l = log(alpha2), epsilon = gamma - 1, to3 = 3 - gamma;
  const T without = alpha * expm1_over<T>(l) / expm1_over<T>(epsilon * l) * (2 - gamma) * gamma *
                    (gamma + 1) * sinc_rest<T>(square(epsilon)) / 4;
  const T step = without * to3;

  auto weight = zeros<T, fixed::Mixture::count>();
  const T half = c(1.5L) - gamma, ratio = exp(half);
  T power = step * exp(half * c(fixed::first));
  for (std::size_t k = 0; k < fixed::Mixture::count; ++k) {
    const T t = 1 / (1 + alpha2 * c(fixed::mixture.z[k]));
    weight[k] = power * (t * sqrt(t));
    power = power * ratio;
  }
  const T second = step * exp((to3 + 1) * c(fixed::first)) / (exp(to3 + 1) - 1);
  const T below =
      without * exp(to3 * c(fixed::first)) / expm1_over<T>(to3) - (1 + alpha2 * c(1.5L)) * second;
  auto r = zeros<T, terms>();
  constexpr std::size_t tile = 4;  // sums that do not wait for each other
  for (std::size_t at = 0; at < terms; at += tile) {
    auto sum = zeros<T, tile>();
    for (std::size_t n = 0; n < tile; ++n)
      sum[n] =
          below * c(fixed::mixture.of_first[at + n]) - second * c(fixed::mixture.of_second[at + n]);
    for (std::size_t k = 0; k < fixed::Mixture::count; ++k)
      for (std::size_t n = 0; n < tile; ++n)
        sum[n] = sum[n] + weight[k] * c(fixed::mixture.of_node[k][at + n]);
    for (std::size_t n = 0; n < tile; ++n) r[at + n] = sum[n];
  }
  r[0] = r[0] + step * exp(-(gamma * c(fixed::last) + l * c(1.5L))) / (exp(gamma) - 1);
  return r;
}

/// γ ≥ 3: in w = 2v − 1, v = α/√q, where P/α is nearly an odd polynomial in v, as it is for whole γ.
/// P/v's coefficients are a table in α and ln γ.
template <Real T>
Coefficients<T> of_table(const T& alpha, const T& gamma) {
  using P = plain_t<T>;
  const auto c = [](long double x) { return constant<P>(x); };
  const T l = log(square(alpha));
  const T scale = alpha * expm1_over<T>(l) / (expm1_over<T>((gamma - 1) * l) * (gamma - 1));
  const auto in_alpha = chebyshev<fixed::table_alpha>(2 * alpha - 1);
  const auto in_gamma =
      chebyshev<fixed::table_gamma>(log(gamma / 3) * c(2 / fixed::ln_10_over_3) - 1);
  auto p = zeros<T, fixed::table_v + 2>();
  const double* at = fixed::table;
  for (std::size_t n = 0; n < fixed::table_v; ++n)
    for (std::size_t j = 0; j < fixed::table_gamma; ++j) {
      T sum(0);
      for (std::size_t i = 0; i < fixed::table_counts[n][j]; ++i)
        sum = sum + in_alpha[i] * c(*at++);
      p[n] = p[n] + sum * in_gamma[j];
    }
  auto r = zeros<T, terms>();
  // v Σ pₙ Tₙ(w), v = (1 + w)/2
  r[0] = scale * (2 * p[0] + p[1]) / 4;
  r[1] = scale * (2 * p[1] + 2 * p[0] + p[2]) / 4;
  for (std::size_t n = 2; n <= fixed::table_v; ++n)
    r[n] = scale * (2 * p[n] + p[n - 1] + p[n + 1]) / 4;
  return r;
}

/// True where a mask is known to hold in every lane.
template <class Mask>
bool everywhere(const Mask& m) {
  if constexpr (std::same_as<Mask, bool>)
    return m;
  else if constexpr (requires {
                       { all(m) } -> std::same_as<bool>;
                     })
    return all(m);
  else
    return false;
}

/// The coefficients of P in the variable of its γ.
template <Real T>
Coefficients<T> coefficients_in(const T& alpha, const T& gamma) {
  const auto wide = gamma < T(3);
  if (everywhere(wide)) return of_mixture<T>(alpha, gamma);
  if (everywhere(!wide)) return of_table<T>(alpha, gamma);
  auto r = of_mixture<T>(alpha, min<T>(gamma, T(3)));
  const auto table = of_table<T>(alpha, max<T>(gamma, T(3)));
  for (std::size_t n = 0; n < terms; ++n) r[n] = select<T>(wide, r[n], table[n]);
  return r;
}

/// Coefficients in T where it has room for powers from e⁻²¹ to e³⁰; else found in a number that has, and rounded.
template <Real T>
Coefficients<T> coefficients(const T& alpha, const T& gamma) {
  if constexpr (requires { RealTraits<T>::roomy(alpha); }) {
    const auto roomy = coefficients_in(RealTraits<T>::roomy(alpha), RealTraits<T>::roomy(gamma));
    auto r = zeros<T, terms>();
    for (std::size_t n = 0; n < terms; ++n) r[n] = T(roomy[n]);
    return r;
  } else {
    return coefficients_in<T>(in_float(alpha), in_float(gamma));
  }
}

}  // namespace smith_gtr

/// smith_scale r, r of the file's head: 1 where c = 1, never below c.
///
/// Measured in double against the integral over the whole of what is legal: G₁ = 2c/(c + r) is off by
/// at most 4e-8 for γ < 3 and 5e-7 from there on, p ∂G₁/∂p by 2e-5; G₁ in float by another
/// 1e-6.  Where the true G₁ is all but flat, this one may fall by 3e-9 towards the normal.
template <Real T>
struct SmithGtrRoot {
  using P = plain_t<T>;

  T alpha;  // smith_scale α
  SmithRoot<T> root;
  P of_log, of_v;  // w = of_log ln v + of_v v − 1
  smith_gtr::Coefficients<T> coefficients;
  T of_root;

  explicit SmithGtrRoot(std::span<const T, 2> p)
      : SmithGtrRoot(p[0], p[1] < T(3), smith_gtr::coefficients<T>(p[0], p[1])) {}

  T operator()(const P& c) const {
    const T g = root(c);
    return max<T>(of_root * g + polynomial(alpha / g) * smith_scale, T(c * smith_scale));
  }

 private:
  SmithGtrRoot(const T& a, const mask_t<T>& wide, const smith_gtr::Coefficients<T>& of_p)
      : alpha(a * smith_scale),
        root(a),
        of_log(select<P>(wide, constant<P>(-1 / (2 * smith_gtr::fixed::ln10)), P(0))),
        of_v(select<P>(wide, P(0), P(2))),
        coefficients(of_p),
        of_root(1 - polynomial(a)) {}

  T polynomial(const T& v) const {
    return smith_gtr::chebyshev_sum(coefficients, of_log * log(v) + of_v * v - 1);
  }
};

/// Smith masking for GTR, light and view independent.
///
///   V = 1 / ((NoL + r(NoL)) (NoV + r(NoV))),   G₁(c) = 2c / (c + r(c))
template <Real T>
struct SmithGtrSeparable {
  static constexpr About about{
      "masking.smith_gtr.separable", "Smith for GTR, separable",
      "G2 = G1(NoL) G1(NoV), G1(c) = 2c / (c + ∫ D(m) |v·m| dω), D of ndf.gtr",
      "Heitz 2014, Eq. 23 with the D of Burley 2012, Appendix B"};
  static constexpr std::array parameters{alpha_parameter, gamma_parameter};

  SmithGtrRoot<T> root;

  explicit SmithGtrSeparable(std::span<const T, 2> p) : root(p) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return smith_separable<T>(a, root(a.nol), root(a.nov));
  }
};

/// Smith masking for GTR, correlated through the height of the facet.
///
///   V = 1 / (2 (NoL r(NoV) + NoV r(NoL))),   G₂ = 1 / (1 + Λ(l) + Λ(v)) [Heitz 2014, Eq. 99]
template <Real T>
struct SmithGtrCorrelated {
  static constexpr About about{
      "masking.smith_gtr.correlated", "Smith for GTR, height-correlated",
      "G2 = 2 NoL NoV / (NoL r(NoV) + NoV r(NoL)), r(c) = ∫ D(m) |v·m| dω, D of ndf.gtr",
      "Heitz 2014, Eq. 99 with the D of Burley 2012, Appendix B"};
  static constexpr std::array parameters{alpha_parameter, gamma_parameter};

  SmithGtrRoot<T> root;

  explicit SmithGtrCorrelated(std::span<const T, 2> p) : root(p) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return smith_correlated<T>(a, root(a.nol), root(a.nov));
  }
};

}  // namespace gonio::inline GONIO_ARCH
