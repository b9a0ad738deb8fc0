#pragma once
/// \file
/// Diffuse terms [1/sr].  A coupled one reflects only what the first lobe's interface lets through:
/// the model multiplies it by 1 − F(VoH).

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"
#include "number/special.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {

/// Lambert:  kd/π
template <Real T>
struct Lambert {
  static constexpr About about{"diffuse.lambert", "Lambert, uncoupled", "f = kd/π", "Lambert 1760"};
  static constexpr std::array parameters{
      Parameter{"kd", {0, 1}, {0, 1}, 0.2, true, "diffuse albedo"}};
  static constexpr bool coupled = false, uniform = true;

  T value;

  explicit Lambert(std::span<const T, 1> p) : value(p[0] / pi<plain_t<T>>()) {}

  T operator()(const Angles<plain_t<T>>&) const { return value; }
};

/// Lambert under an interface:  (1 − F(VoH)) kd/π
template <Real T>
struct LambertCoupled : Lambert<T> {
  static constexpr About about{"diffuse.lambert.coupled",
                               "Lambert under the first lobe's interface", "f = (1 − F(VoH)) kd/π",
                               "Burley 2012; glTF 2.0, Appendix B"};
  static constexpr bool coupled = true;
  using Lambert<T>::Lambert;
};

/// Lambert under the metallic workflow, in its own parameters:  base_color (1 − metallic)/π
template <Real T>
struct LambertMetallic : Lambert<T> {
  static constexpr About about{"diffuse.lambert.metallic",
                               "Lambert, kd by the metallic workflow",
                               "f = base_color (1 − metallic)/π",
                               "Guy, Agopian, Physically Based Rendering in Filament, section 4",
                               "Filament",
                               "diffuse.lambert"};
  static constexpr std::array parameters = F0Metallic<T>::parameters;

  explicit LambertMetallic(std::span<const T, 2> p)
      : Lambert<T>(std::span<const T, 1>(&F0Metallic<T>::apply(p)[1], 1)) {}
};

/// Lambert under the metallic workflow and an interface:  (1 − F(VoH)) base_color (1 − metallic)/π
template <Real T>
struct LambertMetallicCoupled : LambertMetallic<T> {
  static constexpr About about{
      "diffuse.lambert.metallic.coupled",
      "Lambert, kd by the metallic workflow, under the first lobe's interface",
      "f = (1 − F(VoH)) base_color (1 − metallic)/π",
      "glTF 2.0, Appendix B",
      "glTF 2.0",
      "diffuse.lambert.coupled"};
  static constexpr bool coupled = true;
  using LambertMetallic<T>::LambertMetallic;
};

/// Disney's diffuse: darker at grazing angles where smooth, brighter where rough.
///
///   f = kd/π (1 + (F_D90 − 1)(1 − NoL)⁵)(1 + (F_D90 − 1)(1 − NoV)⁵),   F_D90 = 0.5 + 2 r VoH²
///                                                                         [Burley 2012, section 5.3]
///
/// with r = √alpha.  It reflects more than it receives: its albedo reaches 1.52 kd at r = 1 and
/// grazing angles.
template <Real T>
struct DisneyDiffuse {
  static constexpr About about{
      "diffuse.disney",
      "Disney's diffuse",
      "f = kd/π (1 + (F_D90−1)(1−NoL)⁵)(1 + (F_D90−1)(1−NoV)⁵), F_D90 = 0.5 + 2 r VoH², r = √alpha",
      "Burley 2012, section 5.3",
      "Disney's principled BRDF; Unreal Engine and Frostbite offer it, Frostbite renormalised",
      "diffuse.lambert"};
  static constexpr std::array parameters{Lambert<T>::parameters[0], any_alpha_parameter};
  static constexpr bool coupled = false;

  T value, two_r;

  explicit DisneyDiffuse(std::span<const T, 2> p)
      : value(p[0] / pi<plain_t<T>>()), two_r(2 * sqrt(p[1])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const T f_less_1 = two_r * square(a.voh) - constant<plain_t<T>>(0.5L);
    return value *
           ((f_less_1 * schlick_weight(a.nol) + 1) * (f_less_1 * schlick_weight(a.nov) + 1));
  }
};

/// Disney's diffuse under an interface:  (1 − F(VoH)) f
template <Real T>
struct DisneyDiffuseCoupled : DisneyDiffuse<T> {
  static constexpr About about{
      "diffuse.disney.coupled",
      "Disney's diffuse under the first lobe's interface",
      "f = (1 − F(VoH)) f of diffuse.disney",
      "Burley 2012, section 5.3; the interface as of diffuse.lambert.coupled",
      "",
      "diffuse.lambert.coupled"};
  static constexpr bool coupled = true;
  using DisneyDiffuse<T>::DisneyDiffuse;
};

/// 1 − (1 − c)⁵, of which small cosines keep their digits.
template <Real B>
B less_schlick_weight(const B& c) {
  const B m = 1 - c;
  return c * (1 + m * (1 + m * (1 + m * (1 + m))));
}

/// Disney's diffuse, scaled and less bright at the edge, so that under light from everywhere no more leaves than arrives.
///
///   f = kd/π E (1 + (F_D90 − 1)(1 − NoL)⁵)(1 + (F_D90 − 1)(1 − NoV)⁵)
///   F_D90 = r/2 + 2 r VoH²,   E = 1 + (1/1.51 − 1) r                [Lagarde & de Rousiers 2014, listing 1]
///
/// with r = √alpha.  At r = 1 and grazing angles it reflects 1.03 kd, 1.12 with a lobe of F0 = 0.04; Disney's 1.52 and 1.64.
template <Real T>
struct FrostbiteDiffuse {
  static constexpr About about{
      "diffuse.frostbite",
      "Disney's diffuse, renormalised by Frostbite",
      "f = kd/π E (1 + (F_D90−1)(1−NoL)⁵)(1 + (F_D90−1)(1−NoV)⁵), F_D90 = r/2 + 2 r VoH², "
      "E = lerp(1, 1/1.51, r), r = √alpha",
      "Lagarde, de Rousiers 2014, course notes on Frostbite, listing 1",
      "Frostbite",
      "diffuse.lambert"};
  static constexpr std::array parameters{Lambert<T>::parameters[0], any_alpha_parameter};
  static constexpr bool coupled = false;

  T value, half_r;

  explicit FrostbiteDiffuse(std::span<const T, 2> p) : FrostbiteDiffuse(p[0], sqrt(p[1])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const T f90 = half_r * (1 + 4 * square(a.voh));
    const auto scatter = [&](const plain_t<T>& c) {
      return f90 * schlick_weight(c) + less_schlick_weight(c);
    };
    return value * (scatter(a.nol) * scatter(a.nov));
  }

 private:
  FrostbiteDiffuse(const T& kd, const T& r)
      : value(kd * (1 + r * constant<plain_t<T>>(1 / 1.51L - 1)) / pi<plain_t<T>>()),
        half_r(r / 2) {}
};

/// Hammon's fit to light that facets of Lambert's below a dielectric's GGX send on, once or more often; their interface,
/// F0 = 0.04, is in it.
///
///   f = kd (lerp(smooth, rough, α)/π + 0.1159 α kd)                             [Hammon 2017]
///   smooth = 1.05 (1 − (1 − NoL)⁵)(1 − (1 − NoV)⁵)
///   rough  = VoH² (0.9 − 0.4 VoH²)(1 + 1/(2 NoH))
///
/// NoH is at least (NoL + NoV)/2 for any two directions, and taken to be.
template <Real T>
struct HammonDiffuse {
  static constexpr About about{
      "diffuse.hammon", "Hammon's diffuse for GGX and Smith",
      "f = kd (lerp(smooth, rough, α)/π + 0.1159 α kd), smooth = 1.05 (1−(1−NoL)⁵)(1−(1−NoV)⁵), "
      "rough = VoH² (0.9 − 0.4 VoH²)(0.5 + NoH)/NoH",
      "Hammon 2017, PBR Diffuse Lighting for GGX+Smith Microsurfaces", "Respawn (Titanfall 2)"};
  static constexpr std::array parameters{Lambert<T>::parameters[0], alpha_parameter};
  static constexpr bool coupled = false;

  T of_smooth, of_rough, multiple;

  explicit HammonDiffuse(std::span<const T, 2> p)
      : of_smooth(p[0] * (1 - p[1]) * constant<plain_t<T>>(1.05L) / pi<plain_t<T>>()),
        of_rough(p[0] * p[1] / pi<plain_t<T>>()),
        multiple(square(p[0]) * p[1] * constant<plain_t<T>>(0.1159L)) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    using P = plain_t<T>;
    const auto c = [](long double x) { return constant<P>(x); };
    const P facing = square(a.voh);
    const P noh = max<P>(a.noh, max<P>((a.nol + a.nov) / 2, small_square<P>()));
    const P rough = facing * (c(0.9L) - c(0.4L) * facing) * (1 + 1 / (2 * noh));
    const P smooth = less_schlick_weight(a.nol) * less_schlick_weight(a.nov);
    return of_smooth * smooth + of_rough * rough + multiple;
  }
};

// ---- Oren–Nayar ---------------------------------------------------------------------------------

/// s = l·v − NoL NoV = sin θ_l sin θ_v cos φ, above 0 where light and view are on one side.
template <Real B>
B oren_nayar_s(const Angles<B>& a) {
  return (2 * square(least_voh(a)) - 1) - a.nol * a.nov;
}
/// s/max(NoL, NoV) = sin(larger θ) tan(smaller θ) cos φ where that is above 0, else `otherwise`.
template <Real B>
B oren_nayar_ratio(const Angles<B>& a, const B& s, const B& otherwise) {
  return select<B>(B(0) < s, s / max<B>(max<B>(a.nol, a.nov), least<B>()), otherwise);
}

/// Oren and Nayar's qualitative model: grooves of Lambert's facets, without light between them.
///
///   f = kd/π (A + B max(0, cos φ) sin max(θ_l, θ_v) tan min(θ_l, θ_v))            [Oren & Nayar 1994, Eq. 30]
///   A = 1 − σ²/(2 (σ² + 0.33)),   B = 0.45 σ²/(σ² + 0.09)
///
/// σ [rad] is the root mean square of the facets' tilt; that of Beckmann's slopes is α, so a smooth surface's
/// roughness r has σ ≈ r².  Loses light: its average albedo at σ = π/2 is 0.65 kd.
template <Real T>
struct OrenNayar {
  static constexpr About about{
      "diffuse.oren_nayar", "Oren–Nayar, qualitative",
      "f = kd/π (A + B max(0, cos φ) sin max(θi, θo) tan min(θi, θo)), A = 1 − σ²/(2(σ² + 0.33)), "
      "B = 0.45 σ²/(σ² + 0.09)",
      "Oren, Nayar 1994, Generalization of Lambert's Reflectance Model, Eq. 30",
      "Mitsuba, pbrt-v3, OSL"};
  static constexpr std::array parameters{Lambert<T>::parameters[0],
                                         Parameter{"sigma",
                                                   {0, 1.5707963267948966},
                                                   {0, 1.5707963267948966},
                                                   0.3,
                                                   false,
                                                   "root mean square of the facets' tilt [rad]"}};
  static constexpr bool coupled = false;

  T a, b;

  explicit OrenNayar(std::span<const T, 2> p) : OrenNayar(p[0] / pi<plain_t<T>>(), square(p[1])) {}

  T operator()(const Angles<plain_t<T>>& x) const {
    using P = plain_t<T>;
    return a + b * oren_nayar_ratio<P>(x, oren_nayar_s(x), P(0));
  }

 private:
  OrenNayar(const T& value, const T& s2)
      : a(value * (1 - s2 / (2 * s2 + constant<plain_t<T>>(0.66L)))),
        b(value * s2 * constant<plain_t<T>>(0.45L) / (s2 + constant<plain_t<T>>(0.09L))) {}
};

/// Parameter of Fujii's form and of what is made of it.
inline constexpr Parameter oren_nayar_r_parameter{
    "r", {0, 1}, {0, 1}, 0.3, false, "diffuse roughness, B/A of Oren–Nayar; 0 Lambert"};

/// A of Fujii's form:  1/(1 + (1/2 − 2/3π) r)
template <Real T>
T fujii_a(const T& r) {
  return 1 / (1 + r * constant<plain_t<T>>(0.2877934092108062189748216L));
}

/// Fujii's form of Oren–Nayar, without its dark ring where light and view part sides, and no brighter than kd.
///
///   f = kd/π A (1 + r s/t),   s = l·v − NoL NoV,   t = max(NoL, NoV) where s > 0, else 1   [Fujii]
///
/// Its B/A is r: what Oren and Nayar's is 0.25 of at σ = 0.3 and 0.78 at π/2.  Its albedo at kd = 1 is 1 at grazing
/// angles and A at the normal.
template <Real T>
struct OrenNayarFujii {
  static constexpr About about{
      "diffuse.oren_nayar.fujii", "Oren–Nayar, improved by Fujii",
      "f = kd/π A (1 + r s/t), s = l·v − NoL NoV, t = max(NoL, NoV) for s > 0, "
      "else 1, A = 1/(1 + (1/2 − 2/(3π)) r)",
      "Fujii, A tiny improvement of Oren-Nayar reflectance model", "Blender's Cycles"};
  static constexpr std::array parameters{Lambert<T>::parameters[0], oren_nayar_r_parameter};
  static constexpr bool coupled = false;

  T value, r;

  explicit OrenNayarFujii(std::span<const T, 2> p)
      : value(p[0] * fujii_a<T>(p[1]) / pi<plain_t<T>>()), r(p[1]) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto s = oren_nayar_s(a);
    return value * (1 + r * oren_nayar_ratio(a, s, s));
  }
};

/// Energy-preserving Oren–Nayar: Fujii's form, and what it loses as a lobe of Kulla and Conty's kind, coloured by its
/// further bounces.  White reflects all light, at all angles.
///
///   f = ρ/π A (1 + r s/t) + ρ_ms/π (1 − E(NoL)) (1 − E(NoV))/(1 − E_avg)           [Portsmouth et al. 2025, Listing 1]
///   ρ_ms = ρ² E_avg/(1 − ρ (1 − E_avg)),   E_avg = A (1 + (2/3 − 28/15π) r)
///
/// E, the albedo of Fujii's form at ρ = 1, is in closed form  A (1 + r G/π)  with
///
///   G(c) = s (arccos c − s c) + 2/3 ((s/c)(1 − s³) − s),   s = √(1 − c²)
///
/// At c = 0, G is 0/0 and 1 − E a difference that cancels; at r = 0 f_ms is 0/0.  The code has
///
///   1 − E = A r H/π,   H = (π/2 − 2/3) − G = c²/(1 + s) (π/2 − 2/3) + s (arcsin c + c (s − 2/3 (1 + s + s²)/(1 + s)))
///   f_ms = ρ_ms/π A r H(NoL) H(NoV)/(π² (1/2 − 2/3π − 2/3 + 28/15π))
///
/// The sum in H keeps a third of what is added at the least.  `kd` is ρ: the albedo of a facet, and of the surface
/// where ρ is 0 or 1; between, the surface's is less.
template <Real T>
struct Eon {
  static constexpr About about{"diffuse.eon", "Energy-preserving Oren–Nayar (EON)",
                               "f = kd/π A (1 + r s/t) + ρ_ms/π (1−E(NoL))(1−E(NoV))/(1−E_avg), "
                               "ρ_ms = kd² E_avg/(1 − kd (1 − E_avg))",
                               "Portsmouth, Kutz, Hill 2025, EON: A Practical Energy-Preserving "
                               "Rough Diffuse BRDF, JCGT 14(1)",
                               "OpenPBR, MaterialX, Babylon.js"};
  static constexpr std::array parameters{Lambert<T>::parameters[0], oren_nayar_r_parameter};
  static constexpr bool coupled = false;

  OrenNayarFujii<T> single;
  T multiple;

  explicit Eon(std::span<const T, 2> p) : Eon(p, p[1] * fujii_a<T>(p[1])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    return single(a) + multiple * (lost(a.nol) * lost(a.nov));
  }

 private:
  using P = plain_t<T>;

  Eon(std::span<const T, 2> p, const T& r_a) : single(p), multiple(r_a * further(p[0], r_a)) {}

  /// ρ_ms/π³ over 6/5π − 1/6, by r A:  1 − E_avg = r A (6/5π − 1/6)
  static T further(const T& rho, const T& r_a) {
    const P part = constant<P>(0.215305196753882139178654365L);
    const T lost = r_a * part;
    return square(rho) * (1 - lost) / ((1 - rho * lost) * (part * square(pi<P>()) * pi<P>()));
  }
  /// H
  static P lost(const P& c) {
    const auto k = [](long double x) { return constant<P>(x); };
    const P s = sqrt((1 - c) * (1 + c));
    const P bracket = s - k(2.0L / 3) * (1 + s + square(s)) / (1 + s);
    return square(c) / (1 + s) * k(0.904129660128229952564550250L) +
           s * (arcsin<P>(c, s) + c * bracket);
  }
};

}  // namespace gonio::inline GONIO_ARCH
