#pragma once
/// \file
/// Anisotropic normal distributions D(h) [1/sr] with widths α_x along the tangent and α_y along the
/// bitangent, normalised as those of ndf.h; and what makes one of any shape.

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"
#include "number/special.h"

namespace gonio::inline GONIO_ARCH {

/// Anisotropic GGX:  D = 1 / (π α_x α_y (XoH²/α_x² + YoH²/α_y² + NoH²)²)   [Burley 2012, Eq. 13]
///
/// Square as of GGX (ndf_ggx.h), with the widths' product in it:  D = (1/π) / u²,
///
///   u = XoH² √(α_y/α_x)/α_x + YoH² √(α_x/α_y)/α_y + NoH² √(α_x α_y)
///
/// of which the first two factors alone leave half, where one width is below a thousandth of the other.
template <Real T>
struct GgxAniso {
  static constexpr About about{"ndf.ggx_aniso", "Anisotropic GGX",
                               "D = 1 / (π αx αy (XoH²/αx² + YoH²/αy² + NoH²)²)",
                               "Burley 2012, Appendix B; Heitz 2014, section 5.4",
                               "Disney (GTR2 aniso), Unreal Engine 4, Unity HDRP, Filament, "
                               "Mitsuba, pbrt"};
  static constexpr std::array parameters{alpha_x_parameter, alpha_y_parameter};
  static constexpr bool anisotropic = true;

  T of_x, of_y, of_z, num;

  explicit GgxAniso(std::span<const T, 2> p) : GgxAniso(p, sqrt(p[1] / p[0])) {}

  template <class C>
  Quotient<T> operator()(const FrameAngles<plain_t<T>, C>& a) const {
    return {num, square(square(a.xoh) * of_x + square(a.yoh) * of_y + square(a.noh) * of_z)};
  }

 private:
  GgxAniso(std::span<const T, 2> p, const T& ratio)
      : of_x(min<T>(ratio / p[0], most<T>())),
        of_y(min<T>(1 / (ratio * p[1]), most<T>())),
        of_z(ratio * p[0]),
        num(1 / pi<plain_t<T>>()) {}
};

/// Anisotropic Beckmann:
///
///   D = e^(−(XoH²/α_x² + YoH²/α_y²)/NoH²) / (π α_x α_y NoH⁴)
template <Real T>
struct BeckmannAniso {
  static constexpr About about{"ndf.beckmann_aniso", "Anisotropic Beckmann",
                               "D = exp(−(XoH²/αx² + YoH²/αy²)/NoH²) / (π αx αy NoH⁴)",
                               "Ward 1992; Heitz 2014, section 5.4", "Mitsuba, pbrt-v3"};
  static constexpr std::array parameters{alpha_x_parameter, alpha_y_parameter};
  static constexpr bool anisotropic = true;

  T per_x, per_y;  // 1/(α √2), so that the exponential is the root
  T root_norm;     // 1/√(π α_x α_y)

  explicit BeckmannAniso(std::span<const T, 2> p)
      : per_x(constant<plain_t<T>>(0.70710678118654752440L) / p[0]),
        per_y(constant<plain_t<T>>(0.70710678118654752440L) / p[1]),
        root_norm(constant<plain_t<T>>(0.56418958354775628695L) / (sqrt(p[0]) * sqrt(p[1]))) {}

  template <class C>
  T operator()(const FrameAngles<plain_t<T>, C>& a) const {
    const auto per_cos2 = 1 / max<plain_t<T>>(square(a.noh), small_square<plain_t<T>>());
    const T half_x2 = (square(per_x * a.xoh) + square(per_y * a.yoh)) * per_cos2;
    return square(exp(-half_x2) * per_cos2 * root_norm);
  }
};

/// Anisotropic Beckmann as a shader has it:
///
///   d = −(XoH²/α_x² + YoH²/α_y²) / NoH*NoH,   D = e^d / (π α_x α_y NoH⁴)
///
/// `/ NoH*NoH` divides by NoH and multiplies by it again, so that the exponent ends at −1/α² where it
/// should go to −∞: at the horizon D grows as NoH⁻⁴ and ∫ D cos θ dω diverges as NoH⁻² e^(−1/α²).
/// Smooth surfaces hide it (e^(−1/α²) is 4e-44 at α = 0.1); its author saw 'a strange effect
/// when roughness grows'.  No bound: the domain is NoH > 0.
template <Real T>
struct BeckmannAnisoAsWritten {
  static constexpr About about{"ndf.beckmann_aniso.as_written",
                               "Anisotropic Beckmann without its division by NoH²",
                               "D = exp(−(XoH²/αx² + YoH²/αy²)/NoH*NoH) / (π αx αy NoH⁴)",
                               "D_Beckmann_aniso, as printed in notes in circulation",
                               "",
                               "",
                               "ndf.beckmann_aniso"};
  static constexpr std::array parameters{alpha_x_parameter, alpha_y_parameter};
  static constexpr bool anisotropic = true;
  static constexpr bool as_shipped = true;

  T ax, ay;

  explicit BeckmannAnisoAsWritten(std::span<const T, 2> p) : ax(p[0]), ay(p[1]) {}

  template <class C>
  T operator()(const FrameAngles<plain_t<T>, C>& a) const {
    const auto xoh2 = a.xoh * a.xoh, yoh2 = a.yoh * a.yoh;
    const T d = -(xoh2 / (ax * ax) + yoh2 / (ay * ay)) / a.noh * a.noh;
    return exp(d) / (pi<plain_t<T>>() * ax * ay * a.noh * a.noh * a.noh * a.noh);
  }
};

// ---- Any shape ----------------------------------------------------------------------------------

/// The distribution that a one-dimensional shape g makes, if widths are only to stretch it:
///
///   D = g(x) / (α_x α_y NoH⁴),   x² = tan²θ_h (cos²φ_h/α_x² + sin²φ_h/α_y²)     [Heitz 2014, 5.4]
///
/// g is a density of slopes, so 2π ∫ g(x) x dx = 1 makes D normalised at all widths; and Smith's G₁ of
/// D is that of width 1 with the slope of the direction scaled.  (Seed 001 prints the anisotropic form
/// with one α too many, in the argument of g.)
///
/// Shape: `T log_g(const T& x2) const`, ln g by x².  In logarithms nothing overflows at the horizon, and of a root
/// nothing is lost as subnormal before 1/(α_x α_y) brings it back.
template <template <class> class Shape, Real T>
struct ShapeInvariant {
  using P = plain_t<T>;
  Shape<T> shape;
  T per_x, per_y, root_norm;

  ShapeInvariant(const Shape<T>& s, const T& alpha_x, const T& alpha_y)
      : shape(s),
        per_x(1 / alpha_x),
        per_y(1 / alpha_y),
        root_norm(1 / (sqrt(alpha_x) * sqrt(alpha_y))) {}
  ShapeInvariant(const Shape<T>& s, const T& alpha) : ShapeInvariant(s, alpha, alpha) {}

  /// Isotropic: reads α_x alone.
  T operator()(const Angles<P>& a) const {
    return density(a.sin2_theta_h * per_x * per_x * (1 / cos2(a)), a);
  }
  template <class C>
  T operator()(const FrameAngles<P, C>& a) const {
    return density((square(a.xoh * per_x) + square(a.yoh * per_y)) * (1 / cos2(a)), a);
  }

 private:
  static P cos2(const Angles<P>& a) { return max<P>(square(a.noh), small_square<P>()); }
  T density(const T& x2, const Angles<P>& a) const {
    const P log_cos2 = log_near_one<P>(cos2(a), -a.sin2_theta_h);
    return square(exp(shape.log_g(x2) * constant<P>(0.5L) - log_cos2) * root_norm);
  }
};

/// g(x) = (1 + x²/(γ − 1))^−γ / π:  Student's t as a shape of slopes.  γ = 2 is GGX, γ → ∞ Beckmann.
///                                                                             [Ribardière 2017]
template <Real T>
struct StudentShape {
  T gamma, per_gamma_1, log_pi;

  explicit StudentShape(const T& g)
      : gamma(g), per_gamma_1(1 / (g - 1)), log_pi(log(pi<plain_t<T>>())) {}

  T log_g(const T& x2) const {
    const T q = x2 * per_gamma_1;
    return -gamma * log_near_one<T>(1 + q, q) - log_pi;
  }
};

/// The shape-invariant distribution with Student's t for its shape: a tail between those of GGX and
/// Beckmann for γ > 2, a longer one below.  Normalised as it stands.
///
///   D = (1 + x²/(γ − 1))^−γ / (π α_x α_y NoH⁴)
template <Real T>
struct StudentT {
  static constexpr About about{
      "ndf.shape_invariant", "Shape-invariant with Student's t for its shape",
      "D = g(x)/(αx αy NoH⁴), x² = (XoH²/αx² + YoH²/αy²)/NoH², g = (1 + x²/(γ−1))^−γ / π",
      "Heitz 2014, section 5.4; Ribardière et al. 2017 (STD)"};
  static constexpr std::array parameters{
      alpha_x_parameter, alpha_y_parameter,
      Parameter{"gamma", {1.5, 100}, {1.5, 40}, 2, false, "tail exponent; 2 GGX, ∞ Beckmann"}};
  static constexpr bool anisotropic = true;

  ShapeInvariant<StudentShape, T> d;

  explicit StudentT(std::span<const T, 3> p) : d(StudentShape<T>(p[2]), p[0], p[1]) {}

  template <class C>
  T operator()(const FrameAngles<plain_t<T>, C>& a) const {
    return d(a);
  }
};

/// g(x) = (1 + τ x²)^−(1 + 1/τ) / π:  Student's t by its tail, 1/τ + 1 = γ.  τ = 0 is Beckmann and τ = 1 GGX, both reached.
template <Real T>
struct TailShape {
  T tail, log_pi;

  explicit TailShape(const T& t) : tail(t), log_pi(log(pi<plain_t<T>>())) {}

  T log_g(const T& x2) const {
    // Where τ x² is small, nothing is left of g from x² = 4096 on: there a slope by τ, −x⁴/2, would
    // leave its number.
    // What is no number in half is taken for nothing.
    const auto held = x2 < most<T>() / 2;
    const T some = select<T>(held, x2, T(1));
    const T x = select<T>(constant<T>(0.5L) < tail * some, some, min<T>(some, T(4096)));
    return -select<T>(held, x * log1p_over<T>(tail * x) * (1 + tail) + log_pi, most<T>() / 4);
  }
};

/// Student's t distribution of slopes, between Beckmann's and GGX's and beyond, by its tail τ: 0 Beckmann, 1 GGX, above it
/// longer.  Ribardière's γ is 1 + 1/τ, and (1 + τ x²)^−γ/π is his distribution; of τ a fit reaches both ends, and γ = ∞ is
/// as near as any other.
///
///   D = (1 + τ x²)^−(1 + 1/τ) / (π α² NoH⁴),   x = tan θ_h/α
///
/// With an axis less, ndf.shape_invariant by γ.
template <Real T>
struct StudentTail {
  static constexpr About about{
      "ndf.student_t", "Student's t distribution of slopes",
      "D = (1 + τ tan²θ_h/α²)^−(1 + 1/τ) / (π α² NoH⁴), τ the tail, γ = 1 + 1/τ",
      "Ribardière, Bringier, Meneveaux, Simonot 2017, STD: Student's t-Distribution of Slopes for "
      "Microfacet Based BSDFs"};
  static constexpr std::array parameters{alpha_parameter, tail_parameter};

  ShapeInvariant<TailShape, T> d;

  explicit StudentTail(std::span<const T, 2> p) : d(TailShape<T>(p[1]), p[0]) {}

  T operator()(const Angles<plain_t<T>>& a) const { return d(a); }
};

}  // namespace gonio::inline GONIO_ARCH
