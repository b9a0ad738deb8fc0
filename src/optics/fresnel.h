#pragma once
/// \file
/// Fresnel reflectance of a smooth interface, exact, as a function of c = VoH = cos θ_d, the cosine
/// between the direction and the facet's normal.  The approximations are in fresnel_approximate.h.
///
/// Each is a term (brdf/term/term.h): the constructor takes the parameters, which may carry derivatives;
/// operator() takes the cosines of one sample, which never do.  Unpolarised light, from vacuum.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/angles.h"
#include "number/exact.h"
#include "number/known.h"
#include "number/parameter.h"
#include "number/quotient.h"
#include "number/real.h"
#include "optics/f0.h"

namespace gonio::inline GONIO_ARCH {

/// Re (N² − s²) = c² − q, q = 1 − η² + k², near c = √q, where for k = 0 total reflection begins.
///
/// F leaves 1 there as the root of this difference, so that its last digits are F's eighth ones.  √q
/// is therefore held in two parts, h and l, and the difference taken as ((c − h) − l)(c + h).
template <Real T>
struct NearCritical {
  T high, low;

  NearCritical(const T& eta, const T& k) : NearCritical(two_part_q(eta, k)) {}

  /// κ (c² − q) where that is less than a quarter of κ c², else `otherwise`, which is κ (c² − q) too
  T difference(const plain_t<T>& c, const auto& scale, const T& c2, const T& otherwise) const {
    const auto quarter = c2 * constant<plain_t<T>>(0.25L);
    const auto near = otherwise < quarter && -otherwise < quarter;
    return select<T>(near, scale * (((c - high) - low) * (c + high)), otherwise);
  }

 private:
  struct TwoPart {
    T high, low;
  };
  static TwoPart two_part_q(const T& eta, const T& k) {
    const T eta2 = square(eta), k2 = square(k);
    const T d = k2 - eta2, q = 1 + d;
    const T lost = sum_error<T>(T(1), d, q) + sum_error<T>(k2, -eta2, d) +
                   (product_error<T>(k, k, k2) - product_error<T>(eta, eta, eta2));
    const T high = q + lost;  // near η = 1 most of q is in what was lost
    return {high, sum_error<T>(q, lost, high)};
  }
  explicit NearCritical(const TwoPart& q)
      : NearCritical(q, sqrt(select<T>(T(0) < q.high, q.high, T(1)))) {}
  NearCritical(const TwoPart& q, const T& root) : NearCritical(q, root, square(root)) {}
  NearCritical(const TwoPart& q, const T& root, const T& root2)
      : high(root),
        low(((q.high - root2) - product_error<T>(root, root, root2) + q.low) / (2 * root)) {}
};

/// Exact Fresnel reflectance of a dielectric, from either side, with total internal reflection.
///
///   g² = η² − 1 + c²,   r_s = (g − c)/(g + c),   r_p = r_s (c (g + c) − 1)/(c (g − c) + 1)
///   F = (r_s² + r_p²)/2;   F = 1 where g² < 0                            [Walter 2007, Eq. 22]
///
/// Computed with e = (η − 1)(η + 1) and u = g + c, so that nothing cancels as η → 1 nor, seen from inside, in the
/// denominator c e + u:
///   r_s = e/u²,   r_p/r_s = u (c g − s²)/(c η² + g),   s² = (1 − c)(1 + c)
///
/// \param eta  refractive index, transmitted over incident side, > 0; below 1: seen from inside
template <Real T>
struct Dielectric {
  static constexpr About about{
      "fresnel.dielectric", "Dielectric, exact",
      "F = ½ ((g−c)/(g+c))² (1 + ((c(g+c)−1)/(c(g−c)+1))²), g² = η²−1+c², c = VoH",
      "Walter et al. 2007, Eq. 22", "pbrt, Mitsuba"};
  static constexpr std::array parameters{
      Parameter{"eta", {0.2, 10}, {1, 4}, 1.5, true, "refractive index, transmitted / incident"}};

  T e, eta2;
  NearCritical<T> critical;

  explicit Dielectric(std::span<const T, 1> p)
      : e((p[0] - 1) * (p[0] + 1)), eta2(square(p[0])), critical(p[0], T(0)) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto c = a.voh, s2 = (1 - c) * (1 + c), c2 = square(c);
    const T g2 = critical.difference(c, One{}, T(c2), e + c2);
    const auto refracts = T(0) < g2;  // else: total internal reflection, or η = 1 at c = 0
    const T g = sqrt(select<T>(refracts, g2, T(1)));
    const T u = g + c;
    const T rs = e / square(u);
    const T rp_over_rs = u * (c * g - s2) / (c * eta2 + g);
    const T f = square(rs) * (1 + square(rp_over_rs)) / 2;
    const T beyond = select<T>(e < T(0), T(1), T(0));
    return select<T>(refracts, f, beyond);
  }
};

/// Reflectance of an interface whose root r = a + i b = √(N² − s²) is known, m = |r|² = a² + b².
///
/// 1. Fresnel's amplitudes, s² = 1 − c²:   R_s = |(r − c)/(r + c)|²,   R_p = R_s |(c r − s²)/(c r + s²)|²
///
/// 2. The numerator of R_s cancels where N is near 1 and at grazing angles.  But (r − c)(r + c) = r² − c² =
///    N² − 1, a number of the material alone, and |r + c|² = (a + c)² + b² = m + c² + 2 a c, so
///
///       R_s = |r − c|² |r + c|² / |r + c|⁴ = |N² − 1|² / (m + c² + 2 a c)²
///
/// 3. |c r ± s²|² = (c a ± s²)² + c² b² = (m c² + s⁴) ± 2 a c s²: an even part and an odd one, and
///
///       R_p / R_s = (even − odd)/(even + odd)
///
/// 4. In F = (R_s + R_p)/2 = R_s/2 · (1 + R_p/R_s) the odd parts of the numerator cancel on paper:
///
///       ┌──────────────────────────────────────────────────────────────────────────┐
///       │  F = |N² − 1|² (m c² + s⁴) / ((m + c² + 2 a c)² (m c² + s⁴ + 2 a c s²))  │
///       └──────────────────────────────────────────────────────────────────────────┘
///
/// a, c, m ≥ 0: sums of what is not negative, nothing cancels, and one division does.
///
/// All of it comes scaled by κ = 1/max(|N|², 1): in half |N² − s²|² would be too large beyond |N| = 16.
///
/// \param scale  κ   \param n4  κ² |N² − 1|²   \param m  κ m   \param a  κ a
template <Real T>
Quotient<T> reflectance_of_root(
    const plain_t<T>& c, const T& scale, const T& n4, const T& m, const T& a) {
  const auto s2 = (1 - c) * (1 + c), c2 = square(c);
  const T odd = 2 * a * c, s_den = m + scale * c2 + odd, p_even = m * c2 + scale * square(s2);
  return {n4 * p_even, square(s_den) * (p_even + odd * s2)};
}

/// Exact Fresnel reflectance of a conductor with refractive index N = η + i k.
///
///   (a + i b)² = N² − s²,   s² = 1 − c²
///   R_s = ((a − c)² + b²)/((a + c)² + b²)
///   R_p = R_s ((a c − s²)² + b² c²)/((a c + s²)² + b² c²),   F = (R_s + R_p)/2
///                                              [Born & Wolf, Principles of Optics, §14.2]
///
/// Computed so that nothing cancels.  With t = Re (N² − s²) = η² − k² − 1 + c², by NearCritical where it
/// is small beside c², and Im N² = 2 η k:
///
///   a² − b² = t,   a b = η k,   m = a² + b² = √(t² + 4 (η k)²),   so   a² = (m + t)/2,   b² = (m − t)/2
///
///   ┌────────────────────────────────────────────────────────────────────┐
///   │  the larger of a and b is √((m + |t|)/2), the smaller η k over it  │   a is the larger where t > 0
///   └────────────────────────────────────────────────────────────────────┘
///
/// and F from a, m and |N² − 1|² by reflectance_of_root, its four steps.  √κ comes first, from η and k as parts of
/// the largest of them and 1, and multiplies each: in half k² itself is too large beyond k = 255.
///
/// \param eta  real part, > 0   \param k  extinction coefficient, ≥ 0
template <Real T>
struct Conductor {
  static constexpr About about{
      "fresnel.conductor", "Conductor, exact",
      "F = (R_s + R_p)/2 for N = η + i k: (a+ib)² = N² − sin²θ, R_s = |(a+ib−c)/(a+ib+c)|², "
      "R_p = R_s |(c(a+ib)−s²)/(c(a+ib)+s²)|², c = VoH",
      "Born & Wolf, Principles of Optics, 14.2", "pbrt, Mitsuba"};
  static constexpr std::array parameters{
      Parameter{"eta", {0.001, 20}, {0.01, 10}, 1.5, true, "refractive index, real part"},
      Parameter{"k", {0, 1000}, {0, 20}, 3, true, "extinction coefficient"}};

  T root_scale, scale;  // √κ, κ
  T less_one;           // κ (Re N² − 1)
  T im, n4;             // κ η k = κ Im N²/2, κ² |N² − 1|²
  NearCritical<T> critical;

  explicit Conductor(std::span<const T, 2> p)
      : root_scale(of_largest(p, 1 / max<T>(max<T>(p[0], p[1]), T(1)))),
        scale(square(root_scale)),
        less_one((p[0] - 1) * root_scale * ((p[0] + 1) * root_scale) - square(p[1] * root_scale)),
        im(p[0] * root_scale * (p[1] * root_scale)),
        n4(square(less_one) + 4 * square(im)),
        critical(p[0], p[1]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& x) const {
    const auto c = x.voh;
    const T c2 = scale * square(c);
    const T t = critical.difference(c, scale, c2, less_one + c2);  // κ Re (N² − s²)
    const auto a_larger = T(0) < t;
    const T abs_t = select<T>(a_larger, t, -t);
    const T t2 = square(t) + 4 * square(im);  // (κ m)²; where it is too small to hold, m is about
    const auto held = T(0) < t2;
    const T m = select<T>(held, sqrt(select<T>(held, t2, T(1))), max<T>(abs_t, 2 * im));
    const auto off = T(0) < m;  // N = s, where total reflection begins: the root 0 has no slope
    const T larger = sqrt(select<T>(off, (m + abs_t) / 2, T(1)));
    const T a = root_scale * select<T>(a_larger, larger, im / larger);
    const auto f = reflectance_of_root<T>(c, scale, n4, m, a);
    return {f.num, select<T>(T(0) < n4, f.den, T(1))};  // N = 1: there is nothing
  }

 private:
  /// √κ = s/√max(s² |N|², s²)
  static T of_largest(std::span<const T, 2> p, const T& s) {
    return s / sqrt(max<T>(square(p[0] * s) + square(p[1] * s), square(s)));
  }
};

/// Exact Fresnel reflectance of a conductor in an artist's terms: its reflectance at normal incidence
/// and its tint at the edge, from which f0.h has N = n + i k.              [Gulbrandsen 2014]
///
/// It needs k's square alone: at g = 0, where k is 0, the root would have no slope.  f0 = 1 has
/// no finite index and √f0 no slope at 0, so below 2⁻²⁰ and above 1 − 2⁻¹⁶ (in half 1 − 2⁻⁸, of which 1 can be told)
/// F runs straight to 0 and to 1; at normal incidence that is still exact.
///
/// \param f0  reflectance at normal incidence, r in the paper
/// \param g   edge tint: 0 the index that is real, 1 the lowest real part that the paper allows
template <Real T>
struct Gulbrandsen {
  static constexpr About about{
      "fresnel.gulbrandsen", "Conductor, exact, by reflectance and edge tint",
      "F of a conductor with n = g (1−f0)/(1+f0) + (1−g) (1+√f0)/(1−√f0), "
      "k² = (f0 (n+1)² − (n−1)²)/(1−f0)",
      "Gulbrandsen 2014, Artist Friendly Metallic Fresnel", "MaterialX (artistic_ior)"};
  static constexpr std::array parameters{
      Parameter{"f0", {0, 1}, {0.01, 0.99}, 0.8, true, "reflectance at normal incidence"},
      Parameter{"g", {0, 1}, {0, 1}, 0.5, true, "edge tint"}};

  T root_scale, scale;  // √κ, κ
  T k2;                 // κ k²
  T re, less_one;       // κ Re N², κ (Re N² − 1)
  T im2;                // κ² (n k)²
  T n4;                 // κ² |N² − 1|²
  T low, high;          // how far f0 is on the straight runs

  explicit Gulbrandsen(std::span<const T, 2> p)
      : Gulbrandsen(p[0], tinted_index<T>(min<T>(max<T>(p[0], least()), most()), p[1])) {}

  T operator()(const Angles<plain_t<T>>& x) const {
    const auto c = x.voh, c2 = square(c), s2 = (1 - c) * (1 + c);
    const T t = select<T>(s2 < c2, re - scale * s2, less_one + scale * c2);  // by what lies closest
    const auto a_larger = T(0) < t;
    const T m = sqrt(square(t) + 4 * im2);
    const T larger2 = (m + select<T>(a_larger, t, -t)) / 2;
    const T a = root_scale * sqrt(select<T>(a_larger, larger2, im2 / larger2));
    const T f = reflectance_of_root<T>(c, scale, n4, m, a).value();
    return f * low + (1 - f) * high;
  }

 private:
  static T least() { return constant<T>(0x1p-20L); }
  static T most() {
    constexpr int bits = std::min(16, std::numeric_limits<base_t<T>>::digits - 3);
    return constant<T>(1 - std::ldexp(1.0L, -bits));
  }

  Gulbrandsen(const T& f0, const TintedIndex<T>& i)
      : root_scale(of_largest(i, 1 / max<T>(i.n, T(1)))),
        scale(square(root_scale)),
        k2(i.above * root_scale * (i.below * root_scale)),
        re(square(i.n * root_scale) - k2),
        less_one(i.n_less_one * root_scale * ((i.n + 1) * root_scale) - k2),
        im2(square(i.n * root_scale) * k2),
        n4(square(less_one) + 4 * im2),
        low(min<T>(f0 / least(), T(1))),
        high(max<T>((f0 - most()) / (1 - most()), T(0))) {}

  /// √κ, as Conductor has it
  static T of_largest(const TintedIndex<T>& i, const T& s) {
    return s / sqrt(max<T>(square(i.n * s) + i.above * s * (i.below * s), square(s)));
  }
};

}  // namespace gonio::inline GONIO_ARCH
