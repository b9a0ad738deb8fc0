#pragma once
/// \file
/// Isotropic normal distributions D(h) [1/sr] but GGX (ndf_ggx.h), normalised as ∫ D(m) (n·m) dω = 1.
///
/// t = α² cos²θ_h + sin²θ_h is (NoH² (α² − 1) + 1) without its cancellation (ndf_ggx.h).  Where a formula has
/// tan θ_h, NoH² is kept off 0: h is at the horizon only for directions outside the domain.
///
/// 1/α² overflows in half below α = 0.004, and a tiny exponential times a huge peak loses the digits of a subnormal
/// in every number.  So 1/α is multiplied by twice, and D is the square of √peak times the root of the exponential.

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"
#include "number/special.h"

namespace gonio::inline GONIO_ARCH {

/// ln NoH², also near the peak, where NoH has lost its digits.
template <Real B>
B log_cos2_theta_h(const Angles<B>& a) {
  return log_near_one<B>(max<B>(square(a.noh), least<B>()), -a.sin2_theta_h);
}

/// Blinn–Phong with the exponent p that gives it the peak, and for smooth surfaces the shape, of
/// Beckmann's.
///
///   D = (p + 2)/(2π) NoH^p = NoH^p / (π α²),   p = 2/α² − 2                [Walter 2007, Eq. 30]
template <Real T>
struct BlinnPhong {
  static constexpr About about{
      "ndf.blinn_phong", "Blinn–Phong", "D = (p + 2)/(2π) NoH^p, p = 2/α² − 2",
      "Blinn 1977; Walter et al. 2007, Eq. 30 and after", "Unreal Engine 4 (D_Blinn)"};
  static constexpr std::array parameters{alpha_parameter};

  T per_alpha, quarter_p_alpha, root_peak;

  explicit BlinnPhong(std::span<const T, 1> p)
      : per_alpha(1 / p[0]),
        quarter_p_alpha((1 - p[0]) * (1 + p[0]) * per_alpha / 2),
        root_peak(per_alpha / sqrt(pi<plain_t<T>>())) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    return square(root_peak * exp(quarter_p_alpha * log_cos2_theta_h(a) * per_alpha));
  }
};

/// Beckmann: slopes are normally distributed, α √2 times their standard deviation along an axis.
///
///   D = e^(−tan²θ_h/α²) / (π α² NoH⁴)                                  [Walter 2007, Eq. 25]
template <Real T>
struct Beckmann {
  static constexpr About about{"ndf.beckmann", "Beckmann",
                               "D = exp((NoH² − 1) / (α² NoH²)) / (π α² NoH⁴)",
                               "Beckmann & Spizzichino 1963; Walter et al. 2007, Eq. 25",
                               "Unreal Engine 4 (D_Beckmann), Mitsuba, pbrt-v3"};
  static constexpr std::array parameters{alpha_parameter};

  T per_alpha, minus_half_per_alpha, root_norm;

  explicit Beckmann(std::span<const T, 1> p)
      : per_alpha(1 / p[0]),
        minus_half_per_alpha(-per_alpha / 2),
        root_norm(per_alpha / sqrt(pi<plain_t<T>>())) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto per_cos2 = 1 / max<plain_t<T>>(square(a.noh), small_square<plain_t<T>>());
    const T half_x2 = a.sin2_theta_h * per_cos2 * per_alpha * minus_half_per_alpha;
    return square(exp(half_x2) * per_cos2 * root_norm);
  }
};

/// Generalised Trowbridge–Reitz with its exact normalisation.
///
///   D = N / t^γ,   N = (γ − 1)(α² − 1) / (π (1 − α^(2(1−γ))))          [Burley 2012, App. B]
///
/// With L = ln α², E(z) = (eᶻ − 1)/z = eᶻ E(−z) and u = t/α² = cos²θ_h + sin²θ_h/α² the same is
///
///   D = E(L) / (π E(−|γ − 1| |L|)) · (t^−γ where γ < 1, else u^−γ/α²)
///
/// E has no hole: neither γ = 1 (Berry, GTR1) nor α = 1 (D = 1/π) is a special case, no digit is
/// lost near them; and nothing overflows on the way, as α^−2γ does in float.  γ = 2 is GGX.
///
/// A power's error is that of its exponent, γ ln t or γ ln u.  Where γ < 1 most of D, and least of what it
/// depends on, is far from the peak, where t is about 1; where γ > 1 it is at the peak, where u is.
template <Real T>
struct Gtr {
  static constexpr About about{
      "ndf.gtr", "Generalised Trowbridge–Reitz, exact normalisation",
      "D = N / (NoH² (α² − 1) + 1)^γ, N = (γ−1)(α²−1) / (π (1 − α^(2(1−γ)))), limits continued",
      "Burley 2012, Appendix B", ""};
  static constexpr std::array parameters{alpha_parameter, gamma_parameter};

  T of_cos2, of_sin2;  // t or u
  T minus_half_gamma, root_norm;

  explicit Gtr(std::span<const T, 2> p) : Gtr(p, p[1] < T(1), log(p[0])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const T base = square(a.noh) * of_cos2 + a.sin2_theta_h * of_sin2;
    return square(root_norm * exp(minus_half_gamma * log(base)));
  }

 private:
  Gtr(std::span<const T, 2> p, const mask_t<T>& wide, const T& log_alpha)
      : of_cos2(select<T>(wide, square(p[0]), T(1))),
        of_sin2(select<T>(wide, T(1), min<T>(square(1 / p[0]), most<T>()))),
        minus_half_gamma(-p[1] / 2),
        root_norm(select<T>(wide, T(1), 1 / p[0]) *
                  norm(select<T>(wide, 1 - p[1], p[1] - 1), 2 * log_alpha)) {}

  static T norm(const T& apart, const T& l) {
    return sqrt(expm1_over<T>(l) / (pi<plain_t<T>>() * expm1_over<T>(apart * l)));
  }
};

/// Berry's distribution, GTR of γ = 1: neither its power nor its normalisation needs a function there.
///
///   D = (α² − 1)/(π ln α² t)                                           [Burley 2012, App. B]
template <Real T>
struct Gtr1 {
  static constexpr About about{"ndf.gtr1", "Berry (generalised Trowbridge–Reitz, γ = 1)",
                               "D = (α² − 1) / (π ln α² (NoH² (α² − 1) + 1))",
                               "Berry 1923; Burley 2012, Appendix B", "Disney (clear coat)"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha, per_alpha, num;

  explicit Gtr1(std::span<const T, 1> p)
      : alpha(p[0]),
        per_alpha(1 / p[0]),
        num(expm1_over<T>(2 * log(p[0])) * per_alpha / pi<plain_t<T>>()) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {num, alpha * square(a.noh) + per_alpha * a.sin2_theta_h};
  }
};

/// Sheen: facets that stand up as fibres do, the more the smaller α.  No highlight: 0 at the normal, greatest at the horizon.
///
///   D = (2 + 1/α)/(2π) sin^(1/α) θ_h                                    [Estevez & Kulla 2017, Eq. 2]
///
/// The published r is α here, as in glTF and Filament, whose roughness is √α.
template <Real T>
struct Charlie {
  static constexpr About about{
      "ndf.charlie", "Charlie, for sheen", "D = (2 + 1/α)/(2π) sin^(1/α) θ_h",
      "Estevez, Kulla 2017, Production Friendly Microfacet Sheen BRDF, Eq. 2",
      "Sony Imageworks' Arnold, glTF 2.0 (KHR_materials_sheen), Filament"};
  static constexpr std::array parameters{alpha_parameter};

  T quarter_per_alpha, root_peak;

  explicit Charlie(std::span<const T, 1> p)
      : quarter_per_alpha(min<T>(1 / (4 * p[0]), most<T>())),
        root_peak(sqrt((1 + 2 * quarter_per_alpha) / pi<plain_t<T>>())) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    using P = plain_t<T>;
    const P sin2 = select<P>(P(0) < a.sin2_theta_h, a.sin2_theta_h, P(1));
    const T root = root_peak * exp(quarter_per_alpha * log_near_one<P>(sin2, -square(a.noh)));
    return square(select<T>(T(0) < T(a.sin2_theta_h), root, T(0)));
  }
};

}  // namespace gonio::inline GONIO_ARCH
