#pragma once
/// \file
/// Masking terms that stand for Smith's in shaders: rational fits, remapped widths, joint forms, and
/// the mobile ones that stand for V·F or for nothing.  All as V [1/sr], which the exact ones of
/// masking.h are; r = √α is the perceptual roughness that shaders are given.

#include "brdf/formula/masking.h"
#include "brdf/formula/masking_classic.h"
#include "brdf/formula/parameter_maps.h"

namespace gonio::inline GONIO_ARCH {

// ---- Schlick's rational G₁ with its several k ---------------------------------------------------

/// V = 1 / (4 (NoL (1 − k) + k) (NoV (1 − k) + k)),   G₁(c) = c / (c (1 − k) + k)
template <Real T>
struct SchlickMasking {
  static constexpr std::array parameters{alpha_parameter};

  T k, rest;

  explicit SchlickMasking(const T& k_) : k(k_), rest(1 - k_) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {T(1), 4 * (a.nol * rest + k) * (a.nov * rest + k)};
  }
};

/// k = α/2: at α = 1 it is Smith's G₁ for GGX itself; for image-based light.
template <Real T>
struct SchlickGgxHalfAlpha : SchlickMasking<T> {
  static constexpr About about{"masking.schlick_ggx.half_alpha",
                               "Schlick's fit to Smith for GGX, k = α/2",
                               "G1 = c / (c (1 − k) + k), k = α/2",
                               "Schlick 1994; Karis 2013",
                               "Unreal Engine 4 (image-based light, 2013)",
                               "masking.smith_ggx.separable"};
  explicit SchlickGgxHalfAlpha(std::span<const T, 1> p) : SchlickMasking<T>(p[0] / 2) {}
};

/// k = (r + 1)²/8: α/2 of the roughness (r + 1)/2, for lights that are points.
template <Real T>
struct SchlickGgxDirect : SchlickMasking<T> {
  static constexpr About about{"masking.schlick_ggx.direct",
                               "Schlick's fit with Disney's remapping, k = (r + 1)²/8",
                               "G1 = c / (c (1 − k) + k), k = (√α + 1)²/8",
                               "Karis 2013",
                               "Unreal Engine 4 (analytic lights, 2013)",
                               "masking.smith_ggx.separable"};
  explicit SchlickGgxDirect(std::span<const T, 1> p)
      : SchlickMasking<T>(square(sqrt(p[0]) + 1) / 8) {}
};

/// k = r/2: α/2 with the perceptual roughness where α belongs.
template <Real T>
struct SchlickGgxHalfRoughness : SchlickMasking<T> {
  static constexpr About about{"masking.schlick_ggx.half_roughness",
                               "Schlick's fit with roughness for α, k = r/2",
                               "G1 = c / (c (1 − k) + k), k = √α/2",
                               "SchlickGGXGeometricShadowingFunction, in shaders for Unity",
                               "",
                               "masking.smith_ggx.separable"};
  explicit SchlickGgxHalfRoughness(std::span<const T, 1> p) : SchlickMasking<T>(sqrt(p[0]) / 2) {}
};

/// k = α √(2/π)
template <Real T>
struct SchlickBeckmann : SchlickMasking<T> {
  static constexpr About about{"masking.schlick_beckmann",
                               "Schlick's fit to Smith for Beckmann, k = α √(2/π)",
                               "G1 = c / (c (1 − k) + k), k = α √(2/π)",
                               "Schlick 1994, Eq. 19",
                               "Unity (SmithBeckmannVisibilityTerm)",
                               "masking.smith_beckmann.separable"};
  explicit SchlickBeckmann(std::span<const T, 1> p)
      : SchlickMasking<T>(p[0] * sqrt(2 / pi<plain_t<T>>())) {}
};

// ---- Joint forms without roots ------------------------------------------------------------------

/// Unreal Engine's linear form of Smith for GGX, correlated.
///
///   V = 0.5 / (NoL (NoV (1 − α) + α) + NoV (NoL (1 − α) + α))
template <Real T>
struct UeJoint {
  static constexpr About about{"masking.ue_joint",
                               "Unreal Engine's joint Smith approximation",
                               "V = 0.5 / (NoL (NoV (1−α) + α) + NoV (NoL (1−α) + α))",
                               "Vis_SmithJointApprox",
                               "Unreal Engine 4 and 5 (Vis_SmithJointApprox)",
                               "masking.smith_ggx.correlated"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha, rest;

  explicit UeJoint(std::span<const T, 1> p) : alpha(p[0]), rest(1 - p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {constant<T>(0.5L), a.nol * (a.nov * rest + alpha) + a.nov * (a.nol * rest + alpha)};
  }
};

/// UeJoint with the clamps of a mobile port, operation by operation:
///
///   NoV ← saturate(|NoV| + 1e-5),   V = 0.5 / max(…, 0.001)
///
/// The first makes it slightly irreciprocal; the second takes light from smooth surfaces at grazing
/// angles.
template <Real T>
struct UeJointClamped {
  static constexpr About about{
      "masking.ue_joint.clamped",
      "Unreal Engine's joint Smith approximation with a mobile port's clamps",
      "V = 0.5 / max(NoL (NoV (1−α) + α) + NoV (NoL (1−α) + α), 0.001), NoV ← min(NoV + 1e-5, 1)",
      "Vis_SmithJointApprox, as shipped",
      "a mobile game on Unreal Engine 4.27",
      "",
      "masking.ue_joint"};
  static constexpr std::array parameters{alpha_parameter};
  static constexpr bool as_shipped = true;

  T alpha;

  explicit UeJointClamped(std::span<const T, 1> p) : alpha(in_float(p[0])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    using P = plain_t<T>;
    const auto [nov] = mapped<ClampNov, P>(a.nov);
    const T vis_v = a.nol * (nov * (1 - alpha) + alpha);
    const T vis_l = nov * (a.nol * (1 - alpha) + alpha);
    const auto [d] = mapped<ClampVis, T>(vis_v + vis_l);
    return constant<T>(0.5L) * (1 / d);
  }
};

/// Hammon's linear form of Smith for GGX, correlated.
///
///   G₂ = 2 NoL NoV / lerp(2 NoL NoV, NoL + NoV, α)
///
/// Multiplied out it is Unreal Engine's (`masking.ue_joint`), found independently; this one costs a
/// multiplication less.
template <Real T>
struct Hammon {
  static constexpr About about{"masking.hammon",
                               "Hammon's linear Smith approximation",
                               "G2 = 2 NoL NoV / lerp(2 NoL NoV, NoL + NoV, α)",
                               "Hammon 2017, PBR Diffuse Lighting for GGX+Smith Microsurfaces",
                               "Respawn (Titanfall 2)",
                               "masking.smith_ggx.correlated"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha, rest;

  explicit Hammon(std::span<const T, 1> p) : alpha(p[0]), rest(1 - p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    const auto twice = 2 * a.nol * a.nov;
    return {constant<T>(0.5L), twice * rest + (a.nol + a.nov) * alpha};
  }
};

// ---- Disney -------------------------------------------------------------------------------------

/// Smith for GGX, separable, of a width that is never small: α_g = (0.5 + r/2)².
template <Real T>
struct DisneyRemap {
  static constexpr About about{"masking.disney_remap",
                               "Smith for GGX with Disney's remapped roughness",
                               "G2 = G1(NoL) G1(NoV) of GGX with α_g = (0.5 + √α/2)²",
                               "Burley 2012, Appendix B",
                               "Disney (2012)",
                               "masking.smith_ggx.separable"};
  static constexpr std::array parameters{any_alpha_parameter};

  SmithRoot<T> root;

  explicit DisneyRemap(std::span<const T, 1> p) : root(square((sqrt(p[0]) + 1) / 2)) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return smith_separable<T>(a, root(a.nol), root(a.nov));
  }
};

/// Smith for GGX, separable, of width 0.25 whatever the coat's is.
template <Real T>
struct DisneyCoat {
  static constexpr About about{"masking.disney_coat",
                               "Smith for GGX of width 0.25, for clear coats",
                               "G2 = G1(NoL) G1(NoV) of GGX with α_g = 0.25",
                               "Burley 2012, Appendix B",
                               "Disney",
                               "masking.smith_ggx.separable"};
  static constexpr std::array<Parameter, 0> parameters{};

  SmithRoot<T> root{constant<T>(0.25L)};

  explicit DisneyCoat(std::span<const T, 0>) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return smith_separable<T>(a, root(a.nol), root(a.nov));
  }
};

// ---- Beckmann without erf -----------------------------------------------------------------------

/// Walter's rational fit to Smith for Beckmann, a = 1/(α tan θ):
///
///   G₁ = (3.535 a + 2.181 a²)/(1 + 2.276 a + 2.577 a²) where a < 1.6, else 1       [Eq. 27]
///
/// Within 0.35 % of the exact one; at a = 1.6 it is 1.00006 and jumps to 1.  With c = cos θ and
/// w = α sin θ, a = c/w,   G₁/c = (3.535 w + 2.181 c)/(w² + 2.276 w c + 2.577 c²).
///
/// Both are computed 16 times as large, from 4 w, so that in half the product of two denominators has its digits.
template <Real T>
struct SmithBeckmannRational {
  static constexpr About about{
      "masking.smith_beckmann.rational",
      "Walter's rational fit to Smith for Beckmann",
      "G1 = (3.535a + 2.181a²)/(1 + 2.276a + 2.577a²) for a < 1.6, else 1, a = 1/(α tan θ)",
      "Walter et al. 2007, Eq. 27",
      "Mitsuba, many shaders",
      "masking.smith_beckmann.separable"};
  static constexpr std::array parameters{alpha_parameter};

  T four_alpha;

  explicit SmithBeckmannRational(std::span<const T, 1> p) : four_alpha(4 * p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    const auto l = g1_over_c(a.nol), v = g1_over_c(a.nov);
    return {l.num * v.num, 4 * l.den * v.den};
  }

 private:
  Quotient<T> g1_over_c(const plain_t<T>& c) const {
    using P = plain_t<T>;
    const T w = four_alpha * sine_of(c);
    const auto masked = T(c) < constant<P>(1.6L / 4) * w;
    const P c2 = constant<P>(2.577L * 16) * c * c;
    return {select<T>(masked, constant<P>(3.535L * 4) * w + constant<P>(2.181L * 16) * c, T(1)),
            select<T>(masked, w * (w + constant<P>(2.276L * 4) * c) + c2, T(c))};
  }
};

// ---- In place of V·F, on phones -----------------------------------------------------------------

/// In place of V·F/F0, as published: with the roughness r that artists see.
///
///   V = 1 / (4 LoH² (r + 0.5))
///
/// The publication writes the product V F ≈ 1/(LoH² (r + 0.5)), without the 4 of D F G/(4 NoL NoV):
/// that belongs to V there and is divided by at the end.  Its D carries 1/π here; a Unity light carries
/// π, so that Unity's D has none: f of this V and an exact D is 1/π of what the shader multiplies by
/// its light.
///
/// VoH is at least (NoL + NoV)/2 for any two directions, and taken to be.
template <Real T>
struct UnityMobile {
  static constexpr About about{"masking.unity_mobile",
                               "In place of V·F on phones, as published",
                               "V = 1 / (4 LoH² (√α + 0.5))",
                               "Optimizing PBR for Mobile, SIGGRAPH 2015 course",
                               "",
                               "masking.smith_ggx.correlated"};
  static constexpr std::array parameters{alpha_parameter};

  T four_times;

  explicit UnityMobile(std::span<const T, 1> p) : four_times(4 * sqrt(p[0]) + 2) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {T(1), square(least_voh(a)) * four_times};
  }
};

/// UnityMobile as Unity ships it: with α where the publication has r, and LoH² no less than 0.1.
///
///   V = 1 / (max(LoH², 0.1) (4 α + 2))
///
/// (Unity's D adds 1e-5 to its root's base, and its result ends at 100 on phones.)
template <Real T>
struct UnityMobileUrp {
  static constexpr About about{"masking.unity_mobile.urp",
                               "In place of V·F on phones, as Unity ships it",
                               "V = 1 / (max(LoH², 0.1) (4 α + 2))",
                               "DirectBRDFSpecular in Unity's Lighting.hlsl; BRDF2_Unity_PBS",
                               "Unity (Universal Render Pipeline; built-in pipeline on phones)",
                               "masking.smith_ggx.correlated"};
  static constexpr std::array parameters{alpha_parameter};

  T normalization;

  explicit UnityMobileUrp(std::span<const T, 1> p) : normalization(p[0] * 4 + 2) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    using P = plain_t<T>;
    return {T(1), max<P>(square(a.voh), constant<P>(0.1L)) * normalization};
  }
};

/// In place of V·F/F0 at Unreal Engine's lowest quality: V = 0.25 r + 0.25, the angles left out.
template <Real T>
struct UeMobileSimple {
  static constexpr About about{"masking.ue_mobile_simple",
                               "In place of V·F at the lowest quality, without angles",
                               "V = 0.25 √α + 0.25",
                               "SpecularGGXSimple, as shipped",
                               "Unreal Engine 4 (mobile renderer)",
                               "masking.smith_ggx.correlated"};
  static constexpr std::array parameters{alpha_parameter};

  T value;

  explicit UeMobileSimple(std::span<const T, 1> p)
      : value(in_half(sqrt(p[0])) * constant<T>(0.25L) + constant<T>(0.25L)) {}

  T operator()(const Angles<plain_t<T>>&) const { return value; }
};

// ---- Sheen --------------------------------------------------------------------------------------

/// Estevez and Kulla's fit to Smith for Charlie, correlated:
///
///   G₂ = 1/(1 + Λ(l) + Λ(v)),   Λ(c) = e^(L(c)) where c < 1/2, else e^(2 L(1/2) − L(1 − c))       [2017, Eq. 3]
///   L(x) = a/(1 + b x^k) + d x + e,   each of a … e a mean of two by (1 − α)²
///
/// Without the exponent 1 + 2 (1 − NoL)⁸ that softens the light's Λ for pictures: that is not reciprocal, and glTF has none.
/// Where Λ should grow as 1/c at the horizon, the fit ends at up to 7e8: V has no bound there, so that its domain is
/// NoL, NoV > 0; at 0 it is finite and huge.  What Charlie's facets show is met to 12 % (α from 0.1, NoL and NoV from 0.05 on).
template <Real T>
struct SmithCharlie {
  static constexpr About about{
      "masking.smith_charlie.correlated", "Smith for Charlie, fitted, height-correlated",
      "G2 = 1/(1 + Λ(l) + Λ(v)), Λ(c) = exp(L(c)) for c < 1/2, else exp(2L(1/2) − L(1−c)), "
      "L(x) = a/(1 + b x^k) + d x + e",
      "Estevez, Kulla 2017, Production Friendly Microfacet Sheen BRDF, Eq. 3 and Table 1",
      "Sony Imageworks' Arnold, glTF 2.0 (KHR_materials_sheen)"};
  static constexpr std::array parameters{alpha_parameter};

  T a, b, k, d, e, twice_middle;

  explicit SmithCharlie(std::span<const T, 1> p) : SmithCharlie(square(1 - p[0])) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& x) const {
    const T l = c_lambda(x.nol), v = c_lambda(x.nov);
    return {constant<T>(0.25L), x.nov * l + x.nol * v + x.nol * x.nov};
  }

 private:
  using P = plain_t<T>;

  explicit SmithCharlie(const T& smooth)
      : a(mean(smooth, 25.3245L, 21.5473L)),
        b(mean(smooth, 3.32435L, 3.82987L)),
        k(mean(smooth, 0.16801L, 0.19823L)),
        d(mean(smooth, -1.27393L, -1.97760L)),
        e(mean(smooth, -4.85967L, -4.32054L)),
        twice_middle(2 * log_lambda(constant<P>(0.5L))) {}

  static T mean(const T& smooth, long double at_0, long double at_1) {
    return smooth * constant<P>(at_0) + (1 - smooth) * constant<P>(at_1);
  }
  T log_lambda(const P& x) const {
    return a / (1 + b * exp(k * log(max<P>(x, least<P>())))) + d * x + e;
  }
  /// c Λ(c), of the logarithm of both: Λ alone leaves half.
  T c_lambda(const P& c) const {
    const auto low = c < constant<P>(0.5L);
    const T l = log_lambda(select<P>(low, c, 1 - c));
    return exp(select<T>(T(c) < constant<T>(0.5L), l, twice_middle - l) +
               log(max<P>(c, least<P>())));
  }
};

}  // namespace gonio::inline GONIO_ARCH
