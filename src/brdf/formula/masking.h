#pragma once
/// \file
/// Smith's masking and shadowing as visibility V = G₂ / (4 NoL NoV) [1/sr]: the cosines cancel on
/// paper, so nothing divides by zero at grazing angles.  Defined for NoL, NoV in [0, 1], not both 0,
/// where the correlated V has no bound.
///
///   G₁ = 1/(1 + Λ),   G₂ = G₁(l) G₁(v)   or, correlated,   1/(1 + Λ(l) + Λ(v))     [Heitz 2014]
///
/// The code computes c Λ(c), c = NoL or NoV, which is finite at grazing angles:
///
///   V = 1/(4 (NoL + cΛ(l)) (NoV + cΛ(v)))   and   1/(4 (NoL NoV + NoV cΛ(l) + NoL cΛ(v)))
///
/// Squares of small widths and cosines, and products of two of them, have few digits in half.  They are computed of
/// 32 (16 for Beckmann's) times the widths and cosines, of which the largest square, (32 · 4)², still fits.

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"
#include "number/special.h"

namespace gonio::inline GONIO_ARCH {

/// Factor by which the roots r and R of GGX's and GTR's masking are larger than what they stand for.
inline constexpr int smith_scale = 32;

/// V of r(c) = c (1 + 2 Λ(c)) at l and v, light and view independent:  1/((NoL + r(l)) (NoV + r(v)))
///
/// \param r_l, r_v  smith_scale r
template <Real T>
Quotient<T> smith_separable(const Angles<plain_t<T>>& a, const T& r_l, const T& r_v) {
  return {T(smith_scale * smith_scale), (r_l + a.nol * smith_scale) * (r_v + a.nov * smith_scale)};
}
/// V correlated through the height of the facet:  1/(2 (NoL r(v) + NoV r(l)))
///
/// \param r_l, r_v  smith_scale r
template <Real T>
Quotient<T> smith_correlated(const Angles<plain_t<T>>& a, const T& r_l, const T& r_v) {
  return {T(smith_scale / 2), a.nol * r_v + a.nov * r_l};
}

/// smith_scale √(α² + (1 − α²) c²) = smith_scale c √(1 + α² tan²θ), with (1 − α) (1 + α) for 1 − α²
template <Real T>
struct SmithRoot {
  T alpha2, rest;
  explicit SmithRoot(const T& alpha)
      : alpha2(square(alpha * smith_scale)),
        rest((1 - alpha) * (1 + alpha) * (smith_scale * smith_scale)) {}
  T operator()(const plain_t<T>& c) const { return sqrt(alpha2 + rest * c * c); }
};

/// Smith masking for GGX, light and view independent.
///
///   V = 1 / ((NoL + r(NoL)) (NoV + r(NoV))),   G₁(c) = 2c / (c + r(c))  [Walter 2007, Eq. 34]
template <Real T>
struct SmithGgxSeparable {
  static constexpr About about{"masking.smith_ggx.separable", "Smith for GGX, separable",
                               "G2 = G1(NoL) G1(NoV), G1(c) = 2c / (c + √(α² + (1 − α²) c²))",
                               "Walter et al. 2007, Eq. 34",
                               "glTF 2.0, Mitsuba, Unreal Engine 4 (Vis_Smith)"};
  static constexpr std::array parameters{alpha_parameter};

  SmithRoot<T> root;

  explicit SmithGgxSeparable(std::span<const T, 1> p) : root(p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return smith_separable<T>(a, root(a.nol), root(a.nov));
  }
};

/// Smith masking for GGX, correlated through the height of the facet.
///
///   V = 1 / (2 (NoL r(NoV) + NoV r(NoL))),   G₂ = 1 / (1 + Λ(l) + Λ(v)) [Heitz 2014, Eq. 99]
template <Real T>
struct SmithGgxCorrelated {
  static constexpr About about{
      "masking.smith_ggx.correlated", "Smith for GGX, height-correlated",
      "G2 = 2 NoL NoV / (NoL √(α² + (1−α²) NoV²) + NoV √(α² + (1−α²) NoL²))", "Heitz 2014, Eq. 99",
      "Filament, Unity HDRP, Frostbite, pbrt, Unreal Engine 4 (Vis_SmithJoint)"};
  static constexpr std::array parameters{alpha_parameter};

  SmithRoot<T> root;

  explicit SmithGgxCorrelated(std::span<const T, 1> p) : root(p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return smith_correlated<T>(a, root(a.nol), root(a.nov));
  }
};

/// Root of the anisotropic GGX:  c √(1 + α_x² tan²θ cos²φ + α_y² tan²θ sin²φ), which is the length of
/// (α_x x, α_y y, c), smith_scale times.                                       [Heitz 2014, section 5.4]
template <Real T>
struct SmithAnisoRoot {
  using P = plain_t<T>;
  T x2, y2;

  explicit SmithAnisoRoot(std::span<const T, 2> p)
      : x2(square(p[0] * smith_scale)), y2(square(p[1] * smith_scale)) {}

  T operator()(const auto& x, const auto& y, const P& c) const {
    return sqrt(x2 * x * x + y2 * y * y + square(c * smith_scale));
  }
};

/// Smith for the anisotropic GGX, light and view independent.
///
///   V = 1 / ((NoL + |(α_x XoL, α_y YoL, NoL)|) (NoV + |(α_x XoV, α_y YoV, NoV)|))
///                                                     [Heitz 2014, section 5.4; Walter 2007, Eq. 34]
template <Real T>
struct SmithGgxAnisoSeparable {
  static constexpr About about{
      "masking.smith_ggx_aniso.separable", "Smith for anisotropic GGX, separable",
      "G2 = G1(l) G1(v), G1(v) = 2 NoV / (NoV + |(αx XoV, αy YoV, NoV)|)",
      "Walter et al. 2007, Eq. 34; Heitz 2014, section 5.4", "Disney (since 2017), Mitsuba"};
  static constexpr std::array parameters{alpha_x_parameter, alpha_y_parameter};
  static constexpr bool anisotropic = true;

  SmithAnisoRoot<T> root;

  explicit SmithGgxAnisoSeparable(std::span<const T, 2> p) : root(p) {}

  template <class C>
  Quotient<T> operator()(const FrameAngles<plain_t<T>, C>& a) const {
    return smith_separable<T>(a, root(a.xol, a.yol, a.nol), root(a.xov, a.yov, a.nov));
  }
};

/// Smith for the anisotropic GGX, correlated.
///
///   V = 1 / (2 (NoL |(α_x XoV, α_y YoV, NoV)| + NoV |(α_x XoL, α_y YoL, NoL)|))
///                                                                 [Heitz 2014, sections 5.4 and 6.2]
template <Real T>
struct SmithGgxAnisoCorrelated {
  static constexpr About about{
      "masking.smith_ggx_aniso.correlated", "Smith for anisotropic GGX, height-correlated",
      "G2 = 2 NoL NoV / (NoL |(αx XoV, αy YoV, NoV)| + NoV |(αx XoL, αy YoL, NoL)|)",
      "Heitz 2014, section 5.4 and Eq. 99", "Filament, Unity HDRP, pbrt"};
  static constexpr std::array parameters{alpha_x_parameter, alpha_y_parameter};
  static constexpr bool anisotropic = true;

  SmithAnisoRoot<T> root;

  explicit SmithGgxAnisoCorrelated(std::span<const T, 2> p) : root(p) {}

  template <class C>
  Quotient<T> operator()(const FrameAngles<plain_t<T>, C>& a) const {
    return smith_correlated<T>(a, root(a.xol, a.yol, a.nol), root(a.xov, a.yov, a.nov));
  }
};

/// c Λ of Beckmann for a direction of cosine c whose slopes have the width w/c, w = α sin θ.
///
///   Λ(a) = (erf(a) − 1)/2 + e^(−a²)/(2a√π) = ierfc(a)/(2a),   a = c/w    [Walter 2007, Eq. 26]
///
/// so that c Λ = w ierfc(c/w)/2, in which nothing cancels (number/special.h).  From a = 64 on, where nothing is left
/// of e^(−a²), a is 64.
template <Real T>
T beckmann_c_lambda(const plain_t<T>& c, const T& w) {
  return w * ierfc<T>(c / max<T>(w, T(c * constant<plain_t<T>>(0x1p-6L)))) / 2;
}

/// Factor by which what is multiplied for a V of c Λ is larger than what it stands for.
inline constexpr int lambda_scale = 16;

/// V light and view independent, of c + c Λ at l and v.
template <Real T>
Quotient<T> lambda_separable(const T& l, const T& v) {
  return {T(lambda_scale * lambda_scale / 4), (l * lambda_scale) * (v * lambda_scale)};
}
/// V correlated through the height of the facet, of c Λ at l and v.
template <Real T>
Quotient<T> lambda_correlated(const Angles<plain_t<T>>& a, const T& l, const T& v) {
  const auto nol = a.nol * lambda_scale, nov = a.nov * lambda_scale;
  return {T(lambda_scale / 4), nov * l + nol * v + nol * a.nov};
}

/// sin θ of a direction by its cosine.
template <Real B>
B sine_of(const B& c) {
  return sqrt((1 - c) * (1 + c));
}

/// Smith for Beckmann, light and view independent, with erf.
template <Real T>
struct SmithBeckmannSeparable {
  static constexpr About about{"masking.smith_beckmann.separable", "Smith for Beckmann, separable",
                               "G2 = G1(NoL) G1(NoV), G1 = 2/(1 + erf(a) + exp(−a²)/(a √π)), "
                               "a = 1/(α tan θ)",
                               "Smith 1967; Walter et al. 2007, Eq. 26"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha;

  explicit SmithBeckmannSeparable(std::span<const T, 1> p) : alpha(p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    const T l = beckmann_c_lambda<T>(a.nol, alpha * sine_of(a.nol)) + a.nol;
    const T v = beckmann_c_lambda<T>(a.nov, alpha * sine_of(a.nov)) + a.nov;
    return lambda_separable<T>(l, v);
  }
};

/// Smith for Beckmann, correlated through the height of the facet.
template <Real T>
struct SmithBeckmannCorrelated {
  static constexpr About about{"masking.smith_beckmann.correlated",
                               "Smith for Beckmann, height-correlated",
                               "G2 = 1/(1 + Λ(l) + Λ(v)), Λ = (erf(a) − 1)/2 + exp(−a²)/(2a √π), "
                               "a = 1/(α tan θ)",
                               "Smith 1967; Heitz 2014, section 5.3 and Eq. 99"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha;

  explicit SmithBeckmannCorrelated(std::span<const T, 1> p) : alpha(p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return lambda_correlated<T>(a, beckmann_c_lambda<T>(a.nol, alpha * sine_of(a.nol)),
                                beckmann_c_lambda<T>(a.nov, alpha * sine_of(a.nov)));
  }
};

/// Smith for the anisotropic Beckmann, correlated: w is the length of (α_x XoV, α_y YoV).
template <Real T>
struct SmithBeckmannAnisoCorrelated {
  static constexpr About about{"masking.smith_beckmann_aniso.correlated",
                               "Smith for anisotropic Beckmann, height-correlated",
                               "G2 = 1/(1 + Λ(l) + Λ(v)), Λ as of Beckmann with "
                               "a = NoV/|(αx XoV, αy YoV)|",
                               "Heitz 2014, section 5.4 and Eq. 99"};
  static constexpr std::array parameters{alpha_x_parameter, alpha_y_parameter};
  static constexpr bool anisotropic = true;

  T x2, y2;

  explicit SmithBeckmannAnisoCorrelated(std::span<const T, 2> p)
      : x2(square(p[0] * smith_scale)), y2(square(p[1] * smith_scale)) {}

  template <class C>
  Quotient<T> operator()(const FrameAngles<plain_t<T>, C>& a) const {
    return lambda_correlated<T>(a, beckmann_c_lambda<T>(a.nol, width(a.xol, a.yol)),
                                beckmann_c_lambda<T>(a.nov, width(a.xov, a.yov)));
  }

 private:
  using P = plain_t<T>;
  T width(const auto& x, const auto& y) const {
    const T length2 = x2 * x * x + y2 * y * y;
    const T some = min<T>(least<T>(), constant<T>(0x1p-24L));  // the root of 0 has no slope
    return sqrt(max<T>(length2, some)) * constant<P>(1.0L / smith_scale);
  }
};

}  // namespace gonio::inline GONIO_ARCH
