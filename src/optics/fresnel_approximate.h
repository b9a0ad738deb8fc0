#pragma once
/// \file
/// Forms shipped in place of exact Fresnel reflectance (fresnel.h), mistakes included.
///
/// c = VoH; f0 is the reflectance at normal incidence, one per channel.

#include <array>
#include <span>

#include "geometry/angles.h"
#include "number/parameter.h"
#include "number/real.h"
#include "optics/f0.h"
#include "optics/fresnel.h"

namespace gonio::inline GONIO_ARCH {

inline constexpr Parameter f0_parameter{"f0", {0, 1}, {0, 1},
                                        0.04, true,   "reflectance at normal incidence"};

/// (1 − c)⁵
template <Real B>
B schlick_weight(const B& c) {
  const B m = 1 - c;
  return square(square(m)) * m;
}

/// f0 (1 − w) + w, Schlick's approximation of the weight w: f0 + (1 − f0) w keeps less in few bits
template <Real T>
T schlick(const T& f0, const plain_t<T>& w) {
  return f0 * (1 - w) + w;
}

/// Reflectance that is f0 at every angle.
///
///   F = f0
template <Real T>
struct ConstantReflectance {
  static constexpr About about{"fresnel.constant",
                               "The same at every angle",
                               "F = f0",
                               "as shipped in mobile shaders",
                               "Unreal Engine 4's and Unity's mobile renderers, with the rest of F "
                               "in their visibility",
                               "fresnel.schlick"};
  static constexpr std::array parameters{f0_parameter};

  T f0;

  explicit ConstantReflectance(std::span<const T, 1> p) : f0(p[0]) {}

  T operator()(const Angles<plain_t<T>>&) const { return f0; }
};

/// Schlick's approximation.
///
///   F = f0 + (1 − f0)(1 − c)⁵                                          [Schlick 1994, Eq. 15]
///
/// \param f0  reflectance at normal incidence, in [0, 1]
template <Real T>
struct Schlick {
  static constexpr About about{"fresnel.schlick",
                               "Schlick's approximation",
                               "F = f0 (1 − w) + w, w = (1 − VoH)⁵",
                               "Schlick 1994, Eq. 15",
                               "glTF 2.0, Disney's principled BRDF, LearnOpenGL",
                               "fresnel.dielectric"};
  static constexpr std::array parameters{f0_parameter};

  T f0;

  explicit Schlick(std::span<const T, 1> p) : f0(p[0]) {}

  T operator()(const Angles<plain_t<T>>& a) const { return schlick<T>(f0, schlick_weight(a.voh)); }
};

/// Schlick's approximation with the reflectance at grazing incidence set too.
///
///   F = f0 + (f90 − f0)(1 − c)⁵
///
/// \param f90  one for all channels, as all who ship it have it: what occludes is grey
template <Real T>
struct SchlickF90 {
  static constexpr About about{"fresnel.schlick.f90",
                               "Schlick's approximation with F90",
                               "F = f0 (1 − w) + f90 w, w = (1 − VoH)⁵",
                               "Lagarde, de Rousiers 2014, course notes on Frostbite, section 3.1",
                               "Frostbite, Filament, glTF 2.0 (KHR_materials_specular)",
                               "fresnel.dielectric"};
  static constexpr std::array parameters{
      f0_parameter, Parameter{"f90", {0, 1}, {0, 1}, 1, false, "reflectance at grazing incidence"}};

  T f0, f90;

  explicit SchlickF90(std::span<const T, 2> p) : f0(p[0]), f90(p[1]) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    // 1 − m⁵ = (1 − m)((1 + m)(1 + m²) + m⁴): where f90 is small the rest decides at grazing too.
    const auto m = 1 - a.voh, m2 = square(m), rest = a.voh * ((1 + m) * (1 + m2) + square(m2));
    return f0 * rest + f90 * schlick_weight(a.voh);
  }
};

/// Parameters of a layer, and how much of it there is.
template <class Layer>
constexpr auto with_weight() {
  constexpr std::size_t n = Layer::parameters.size();
  std::array<Parameter, n + 1> all{};
  for (std::size_t i = 0; i < n; ++i) all[i] = Layer::parameters[i];
  all[n] = Parameter{"weight", {0, 1}, {0, 1}, 0.25, false, "how much of the layer there is"};
  return all;
}

/// Reflectance of a layer that covers part of the surface, or of one of several lobes that share it.
///
///   F = w F_layer
///
/// \param weight  w, in [0, 1]: one for all channels
template <template <class> class Layer, Real T>
struct WeightedLayer {
  static constexpr auto parameters = with_weight<Layer<T>>();
  static constexpr std::size_t count = parameters.size();

  Layer<T> layer;
  T weight;

  explicit WeightedLayer(std::span<const T, count> p)
      : layer(p.template first<count - 1>()), weight(p[count - 1]) {}

  auto operator()(const Angles<plain_t<T>>& a) const { return weight * layer(a); }
};

/// Schlick's approximation of a layer that covers part of the surface.
///
///   F = w (f0 + (1 − f0)(1 − c)⁵)
///
/// \param weight  w, in [0, 1]; Disney's coat has 0.25 clearcoat [Burley 2012, Appendix B]
template <Real T>
struct SchlickWeighted : WeightedLayer<Schlick, T> {
  static constexpr About about{"fresnel.schlick.weighted",
                               "Schlick's approximation, of a partial layer",
                               "F = weight (f0 (1 − w) + w), w = (1 − VoH)⁵",
                               "Burley 2012, Appendix B",
                               "Disney's principled BRDF, its coat",
                               "fresnel.schlick"};
  using WeightedLayer<Schlick, T>::WeightedLayer;
};

/// Schlick's approximation with F90, of a layer that covers part of the surface.
///
///   F = w (f0 + (f90 − f0)(1 − c)⁵)
///
/// w and f90 tell a lobe's strength apart from how much of it is left at grazing angles.
template <Real T>
struct SchlickF90Weighted : WeightedLayer<SchlickF90, T> {
  static constexpr About about{"fresnel.schlick.f90.weighted",
                               "Schlick's approximation with F90, of a partial layer",
                               "F = weight (f0 (1 − w) + f90 w), w = (1 − VoH)⁵",
                               "fresnel.schlick.f90; the weight as of fresnel.schlick.weighted",
                               "",
                               "fresnel.schlick.f90"};
  using WeightedLayer<SchlickF90, T>::WeightedLayer;
};

/// Exact reflectance of a dielectric layer that covers part of the surface.
///
///   F = w F_dielectric(eta, c)
template <Real T>
struct DielectricWeighted : WeightedLayer<Dielectric, T> {
  static constexpr About about{"fresnel.dielectric.weighted",
                               "Dielectric, of a partial layer",
                               "F = weight F_dielectric(eta, VoH)",
                               "fresnel.dielectric; the weight as of fresnel.schlick.weighted",
                               "",
                               "fresnel.dielectric"};
  using WeightedLayer<Dielectric, T>::WeightedLayer;
};

/// Exact reflectance of a conductor that covers part of the surface.
///
///   F = w F_conductor(eta, k, c)
template <Real T>
struct ConductorWeighted : WeightedLayer<Conductor, T> {
  static constexpr About about{"fresnel.conductor.weighted",
                               "Conductor, of a partial layer",
                               "F = weight F_conductor(eta, k, VoH)",
                               "fresnel.conductor; the weight as of fresnel.schlick.weighted",
                               "",
                               "fresnel.conductor"};
  using WeightedLayer<Conductor, T>::WeightedLayer;
};

/// Schlick's approximation under the metallic workflow, in its own parameters.
///
///   F = f0 + (1 − f0)(1 − c)⁵,   f0 = lerp(0.04, base_color, metallic)       [glTF 2.0, Appendix B]
///
/// Shares both with diffuse.lambert.metallic: a fit's colours stay within what the workflow can say.
template <Real T>
struct SchlickMetallic : Schlick<T> {
  static constexpr About about{
      "fresnel.schlick.metallic",
      "Schlick's approximation, F0 by the metallic workflow",
      "F = f0 (1 − w) + w, w = (1 − VoH)⁵, f0 = lerp(0.04, base_color, metallic)",
      "glTF 2.0, Appendix B",
      "glTF 2.0",
      "fresnel.schlick"};
  static constexpr std::array parameters = F0Metallic<T>::parameters;

  explicit SchlickMetallic(std::span<const T, 2> p)
      : Schlick<T>(std::span<const T, 1>(F0Metallic<T>::apply(p).data(), 1)) {}
};

/// Schlick's approximation under the metallic workflow, whose dielectric has a reflectance of its own.
///
///   F = f0 + (1 − f0)(1 − c)⁵,   f0 = lerp(0.16 reflectance², base_color, metallic)
///                                        [Guy & Agopian, Physically Based Rendering in Filament, 4.8.3.2]
///
/// Filament lowers F90 where 16.5 Σ f0 < 1; here it is 1, as it is at a reflectance of 0.36 or more.
template <Real T>
struct SchlickReflectance : Schlick<T> {
  static constexpr About about{
      "fresnel.schlick.reflectance",
      "Schlick's approximation, F0 by Filament's parameters",
      "F = f0 (1 − w) + w, w = (1 − VoH)⁵, f0 = lerp(0.16 reflectance², base_color, metallic)",
      "Guy, Agopian, Physically Based Rendering in Filament, section 4",
      "Filament",
      "fresnel.schlick"};
  static constexpr std::array parameters{
      F0Metallic<T>::parameters[0], F0Metallic<T>::parameters[1],
      Parameter{
          "reflectance", {0, 1}, {0.36, 1}, 0.5, false, "of a dielectric: F0 = 0.16 reflectance²"}};

  explicit SchlickReflectance(std::span<const T, 3> p)
      : Schlick<T>(std::span<const T, 1>(
            F0Metallic<T>::of(constant<T>(0.16L) * square(p[2]), p[0], p[1]).data(), 1)) {}
};

/// Unreal Engine's: what is darker than 2 % at normal incidence is taken for shadowed, and loses its
/// grazing reflection too.
///
///   F = min(50 f0_green, 1) (1 − c)⁵ + (1 − (1 − c)⁵) f0
///
/// The colour is `half`, VoH and what becomes of it `float` (number/mixed.h).
///
/// \param f0_green  f0 of the green channel, which decides for all channels
template <Real T>
struct SchlickUe {
  static constexpr About about{"fresnel.schlick.ue",
                               "Schlick's approximation, Unreal Engine's",
                               "F = saturate(50 f0_green)(1 − VoH)⁵ + (1 − (1 − VoH)⁵) f0",
                               "Unreal Engine 4, F_Schlick",
                               "Unreal Engine 4",
                               "fresnel.schlick"};
  static constexpr std::array parameters{
      f0_parameter, Parameter{"f0_green", {0, 1}, {0, 1}, 0.04, false, "f0 of the green channel"}};
  static constexpr bool as_shipped = true;  // 1 − (1 − c)⁵ cancels at grazing

  T f0, edge;

  explicit SchlickUe(std::span<const T, 2> p)
      : f0(in_half(p[0])), edge(min<T>(in_float(T(50)) * in_half(p[1]), T(1))) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto m5 = schlick_weight(in_float(a.voh));
    return edge * m5 + (1 - m5) * f0;
  }
};

/// Schlick's approximation by one exponential, which on the GPUs of its time cost less than four
/// products.
///
///   F = f0 + (1 − f0) 2^((−5.55473 c − 6.98316) c)                       [Karis 2013, section on F]
///
/// It misses f0 at normal incidence by (1 − f0) 2^−12.53789 = 1.68e-4 (1 − f0).
template <Real T>
struct SchlickSphericalGaussian {
  static constexpr About about{"fresnel.schlick.spherical_gaussian",
                               "Schlick's approximation, its power a spherical Gaussian",
                               "F = f0 (1 − w) + w, w = 2^((−5.55473 VoH − 6.98316) VoH)",
                               "Lagarde 2012; Karis 2013, Real Shading in Unreal Engine 4",
                               "Unreal Engine 4 (2013), three.js",
                               "fresnel.schlick"};
  static constexpr std::array parameters{f0_parameter};

  T f0;

  explicit SchlickSphericalGaussian(std::span<const T, 1> p) : f0(p[0]) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    using B = plain_t<T>;
    const B& c = a.voh;
    const B power = (constant<B>(-5.55473L) * c - constant<B>(6.98316L)) * c;
    const B w = exp(power * constant<B>(0.693147180559945309417L));
    return schlick<T>(f0, w);
  }
};

/// Schlick's approximation as notes in circulation print it, its power lost.
///
///   F = f0 + (1 − f0)(1 − c)
template <Real T>
struct LinearAsWritten {
  static constexpr About about{"fresnel.linear.as_written",
                               "Schlick's approximation, its power missing",
                               "F = f0 VoH + (1 − VoH)",
                               "as printed in notes in circulation",
                               "",
                               "",
                               "fresnel.schlick"};
  static constexpr std::array parameters{f0_parameter};

  T f0;

  explicit LinearAsWritten(std::span<const T, 1> p) : f0(p[0]) {}

  T operator()(const Angles<plain_t<T>>& a) const { return f0 * a.voh + (1 - a.voh); }
};

/// Schlick's approximation with F0 from the index, but exact where that is near 1, or below it: there
/// F0 is about 0 and Schlick still reflects all at grazing.
///
///   F = Dielectric(η) for η < 1.3,   else Schlick(((η − 1)/(η + 1))²)
///
/// The notes say that Schlick is poor near 1 but name no bound; they switch, they do not blend.  1.3
/// lies below every common solid or liquid in air (ice 1.31): interfaces with air are Schlick's, those
/// within water or glass exact.  There Schlick is off by up to 0.068, so F jumps by that.
template <Real T>
struct Disney2015 {
  static constexpr About about{
      "fresnel.disney2015",
      "Exact for an index near 1, Schlick's elsewhere",
      "F = dielectric(eta) for eta < 1.3, else Schlick with "
      "f0 = ((eta−1)/(eta+1))²",
      "Burley 2015, Extending the Disney BRDF to a BSDF, course notes; the "
      "bound 1.3 is ours",
      "",
      "fresnel.dielectric"};
  static constexpr std::array parameters = Dielectric<T>::parameters;

  Dielectric<T> exact;
  T f0;
  mask_t<T> near_1;

  explicit Disney2015(std::span<const T, 1> p)
      : exact(p), f0(square((p[0] - 1) / (p[0] + 1))), near_1(p[0] < constant<T>(1.3L)) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    return select<T>(near_1, exact(a), schlick<T>(f0, schlick_weight(a.voh)));
  }
};

/// Metals: Schlick's approximation less a hump at 82° that is as high as the tint asks.
///
///   F = max(F_s(c) − b c (1 − c)⁶, 0),   b = (1 − tint) F_s(1/7) / (1/7 (6/7)⁶),   F_s: Schlick
///                                                      [Hoffman 2019; Kutz et al. 2021, section 3]
///
/// so that F(1/7) = tint · F_s(1/7); cos 82° = 1/7 is where c (1 − c)⁶ is largest.  It is kept above 0
/// as Blender does: for dark tints the formula would go below, at angles of less than 82°.
///
/// Computed as tint F_s + (1 − tint)(F_s − F_s(1/7) w), w = c (1 − c)⁶/(1/7 (6/7)⁶), where dark tints
/// leave little of large parts; with u = (7 c − 1)/6 and v = 1 − u = 7/6 (1 − c) nothing cancels in either:
///   1 − w = u² (1 + 2 v + 3 v² + 4 v³ + 5 v⁴ + 6 v⁵)
///   F_s − F_s(1/7) w = f0 (1 − w) − (1 − f0)(1 − c)⁵ u (6 − 7 c)
/// and (8 c − 1) − c and c − (8 c − 6) are exact where they are small.
///
/// \param f82_tint  what the edge reflects, as a part of what Schlick would; 1: Schlick
template <Real T>
struct F82Tint {
  static constexpr About about{
      "fresnel.f82",
      "F82-tint: Schlick's with an edge tint for metals",
      "F = max(F_s(VoH) − (1 − f82_tint) F_s(1/7) "
      "VoH (1−VoH)⁶/(1/7 (6/7)⁶), 0), F_s Schlick's",
      "Hoffman 2019, Fresnel Equations Considered Harmful; Kutz et al. 2021, "
      "Novel Aspects of the Adobe Standard Material",
      "OpenPBR, Blender",
      "fresnel.conductor"};
  static constexpr std::array parameters{
      Parameter{"f0", {0, 1}, {0, 1}, 0.8, true, "reflectance at normal incidence"},
      Parameter{"f82_tint", {0, 1}, {0, 1}, 1, true, "reflectance at 82°, relative to Schlick's"}};

  T f0, tint;

  explicit F82Tint(std::span<const T, 2> p) : f0(p[0]), tint(p[1]) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    using B = plain_t<T>;
    const B &c = a.voh, m5 = schlick_weight(c), eight = 8 * c;
    const B u = ((eight - 1) - c) * constant<B>(1.0L / 6), v = (1 - c) * constant<B>(7.0L / 6);
    const B sum = 1 + v * (2 + v * (3 + v * (4 + v * (5 + v * 6))));
    const T darkest = f0 * (square(u) * sum) - (1 - f0) * (m5 * u * (c - (eight - 6)));
    return max<T>(tint * schlick<T>(f0, m5) + (1 - tint) * darkest, T(0));
  }
};

/// Metals: Schlick's approximation rescaled to the F0 of n + i k, less a hump fitted to each metal.
///
///   F = max(((n − 1)² + 4 n (1 − c)⁵ + k²)/((n + 1)² + k²) − a c (1 − c)^α, 0)
///                                                                [Lazányi & Szirmay-Kalos 2005]
///
/// Its first part is exact at normal incidence and at grazing; with a = 0 it is all there is.  The
/// paper has a and α in a table, metal by metal; here they are parameters.  Kept above 0, which of
/// metals it never reaches.
template <Real T>
struct Lazanyi {
  static constexpr About about{
      "fresnel.lazanyi",
      "Schlick's rescaled to n + i k, with Lazányi's correction",
      "F = max(((n−1)² + 4n(1−VoH)⁵ + k²)/((n+1)² + k²) − a VoH (1−VoH)^alpha, 0), n = eta, "
      "a = correction, alpha = correction_exponent",
      "Lazányi, Szirmay-Kalos 2005, Fresnel Term Approximations for Metals",
      "",
      "fresnel.conductor"};
  static constexpr std::array parameters{
      Parameter{"eta", {0.001, 20}, {0.01, 10}, 1.5, true, "refractive index, real part"},
      Parameter{"k", {0, 1000}, {0, 20}, 3, true, "extinction coefficient"},
      Parameter{"correction", {0, 10}, {0, 5}, 0, true, "height of the correction"},
      Parameter{"correction_exponent",
                {1, 20},
                {2, 12},
                6,
                true,
                "how near grazing the correction lies"}};

  T f0, slope, height, exponent;

  explicit Lazanyi(std::span<const T, 4> p) : Lazanyi(p, 1 / max<T>(p[0] + 1, p[1])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto m = 1 - a.voh;
    const auto open = plain_t<T>(0) < m;  // at normal incidence the correction is 0
    const auto log_m = log(select<plain_t<T>>(open, m, plain_t<T>(1)));
    const T hump = height * (a.voh * exp(exponent * log_m));
    return max<T>(f0 + slope * schlick_weight(a.voh) - select<T>(open, hump, T(0)), T(0));
  }

 private:
  // of n + 1 and k as parts of the larger, s times as large: in half k² itself would be too large
  Lazanyi(std::span<const T, 4> p, const T& s)
      : Lazanyi(p, s, square(p[1] * s), 1 / (square((p[0] + 1) * s) + square(p[1] * s))) {}
  Lazanyi(std::span<const T, 4> p, const T& s, const T& k2, const T& per_den)
      : f0((square((p[0] - 1) * s) + k2) * per_den),
        slope(4 * (p[0] * s) * s * per_den),
        height(p[2]),
        exponent(p[3]) {}
};

}  // namespace gonio::inline GONIO_ARCH
