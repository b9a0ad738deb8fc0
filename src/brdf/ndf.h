#pragma once
/// \file
/// Normal distributions D(h) [1/sr], normalised as ∫ D(m) (n·m) dω = 1.
///
/// t = α² cos²θ_h + sin²θ_h is (NoH² (α² − 1) + 1) without its cancellation.

#include "brdf/term.h"

namespace gonio::inline GONIO_ARCH {

inline constexpr Parameter alpha_parameter{"alpha", {1e-4, 1}, {1e-4, 1},
                                           0.3,     false,     "width, roughness²"};

/// GGX (Trowbridge–Reitz).
///
///   D = α² / (π t²)                                                    [Walter 2007, Eq. 33]
template <Real T>
struct Ggx {
  static constexpr About about{"ndf.ggx", "GGX (Trowbridge–Reitz)",
                               "D = α² / (π (NoH² (α² − 1) + 1)²)", "Walter et al. 2007, Eq. 33"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha2, num;

  explicit Ggx(std::span<const T, 1> p) : alpha2(square(p[0])), num(alpha2 / pi<plain_t<T>>()) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {num, square(alpha2 * square(a.noh) + a.sin2_theta_h)};
  }
};

/// E(z) = (eᶻ − 1)/z, continued through z = 0 by its series, where the difference would cancel.
template <Real T>
T expm1_over(const T& z) {
  T series(1);
  for (int k = 15; k >= 2; --k) series = 1 + series * z / constant<T>(k);
  const auto far = constant<T>(0.5L) < max<T>(z, -z);
  const T safe = select<T>(far, z, T(1));
  return select<T>(far, (exp(safe) - 1) / safe, series);
}

/// Generalised Trowbridge–Reitz with its exact normalisation.
///
///   D = N / t^γ,   N = (γ − 1)(α² − 1) / (π (1 − α^(2(1−γ))))          [Burley 2012, App. B]
///
/// With L = ln α², E(z) = (eᶻ − 1)/z = eᶻ E(−z) and u = t/α² = cos²θ_h + sin²θ_h/α² the same is
///
///   D = E(L) / (π α² E((γ − 1) L)) · u^−γ
///
/// E has no hole: neither γ = 1 (Berry, GTR1) nor α = 1 (D = 1/π) is a special case, no digit is
/// lost near them; and nothing overflows on the way, as α^−2γ does in float.  γ = 2 is GGX.
template <Real T>
struct Gtr {
  static constexpr About about{
      "ndf.gtr", "Generalised Trowbridge–Reitz, exact normalisation",
      "D = N / (NoH² (α² − 1) + 1)^γ, N = (γ−1)(α²−1) / (π (1 − α^(2(1−γ)))), limits continued",
      "Burley 2012, Appendix B"};
  static constexpr std::array parameters{
      alpha_parameter,
      Parameter{"gamma", {0.5, 10}, {0.5, 10}, 2, false, "tail exponent; 1 Berry, 2 GGX"}};

  T per_alpha2, gamma, peak;

  explicit Gtr(std::span<const T, 2> p)
      : per_alpha2(1 / square(p[0])), gamma(p[1]), peak(d_at_peak(-log(per_alpha2))) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    return peak * exp(-gamma * log(square(a.noh) + a.sin2_theta_h * per_alpha2));
  }

 private:
  T d_at_peak(const T& l) const {
    return expm1_over<T>(l) * per_alpha2 / (pi<plain_t<T>>() * expm1_over<T>((gamma - 1) * l));
  }
};

}  // namespace gonio::inline GONIO_ARCH
