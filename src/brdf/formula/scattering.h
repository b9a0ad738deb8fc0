#pragma once
/// \file
/// Maps that give back the light that single scattering loses between facets: compensations as shaders run
/// them, maps (brdf/term/map.h) from albedos to albedos.  E is the albedo of a lobe at F = 1, E_avg its
/// average over the hemisphere, F_avg = 2 ∫ F(μ) μ dμ that of a Fresnel term.

#include <array>
#include <span>
#include <string_view>

#include "brdf/formula/widths.h"
#include "brdf/term/map.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {

/// A map's albedo by name; of those that are divided by, none below 0.01: GGX's least is 0.307.
constexpr Parameter albedo_parameter(
    std::string_view name, double low, double start, bool per_channel, std::string_view meaning) {
  return {name, {low, 1}, {low, 1}, start, per_channel, meaning};
}
inline constexpr Parameter e_single_parameter =
    albedo_parameter("e_single", 0, 0.5, true, "albedo of single scattering, Fresnel included");
inline constexpr Parameter e_parameter = albedo_parameter("e", 0.01, 0.7, false, "albedo at F = 1");
inline constexpr Parameter e_average_parameter =
    albedo_parameter("e_average", 0.01, 0.7, false, "average of e over the hemisphere");
inline constexpr Parameter f_average_parameter =
    albedo_parameter("f_average", 0, 0.5, true, "average of the Fresnel term, 2 ∫ F mu dmu");

/// Albedos of a lobe that a shader has fitted, MaterialX's among them: its E reaches 1.0348, of a mirror at the horizon.
inline constexpr double most_fitted_albedo = 1.04;
inline constexpr Parameter fitted_e_single_parameter{
    "e_single", {0, most_fitted_albedo},
    {0, 1},     0.5,
    true,       "albedo of single scattering, Fresnel included"};
inline constexpr Parameter fitted_e_parameter{"e",   {0.01, most_fitted_albedo}, {0.01, 1}, 0.7,
                                              false, "albedo at F = 1"};

/// F_avg of Schlick's approximation,  F0 + (F90 − F0)/21
template <Real T>
T schlick_average(const T& f0, const T& f90) {
  return f0 + (f90 - f0) / 21;
}
template <Real T>
T schlick_average(const T& f0) {
  return schlick_average<T>(f0, T(1));
}

/// Share of the light that a first facet's shadowing took that comes out in the end, if each further bounce
/// takes F_avg and of what it leaves 1 − E_avg stays inside:
///
///   Σ_n≥2 F_avg^n E_avg (1 − E_avg)^(n−2) = F_avg² E_avg/(1 − F_avg (1 − E_avg))          [Hill 2018]
template <Real T>
T multiple_bounces(const T& f_average, const T& e_average) {
  return square(f_average) * e_average / (1 - f_average * (1 - e_average));
}

/// albedo = E_single + F_ms (1 − E), F_ms as multiple_bounces() has it.
template <Real T>
struct KullaConty {
  static constexpr About about{
      "scattering.kulla_conty", "Multiple scattering as a diffuse-like lobe",
      "albedo = e_single + F_ms (1 − e), F_ms = F_avg² E_avg/(1 − F_avg (1 − E_avg))",
      "Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks; F_avg² Hill 2018, A "
      "Multi-Faceted Exploration (Part 3)",
      "Sony Imageworks' Arnold"};
  static constexpr std::array parameters{e_single_parameter, e_parameter, e_average_parameter,
                                         f_average_parameter};
  static constexpr std::array<std::string_view, 1> outputs{"albedo"};

  static std::array<T, 1> apply(std::span<const T, 4> p) {
    return {p[0] + multiple_bounces<T>(p[3], p[2]) * (1 - p[1])};
  }
};

/// With the colour as first published, F_avg where F_avg² belongs: a second bounce taken for the first.
/// Right at F_avg = 1, too bright and too grey below.
template <Real T>
struct KullaContyLinear {
  static constexpr About about{
      "scattering.kulla_conty.linear",
      "Multiple scattering as a diffuse-like lobe, one bounce of colour too few",
      "albedo = e_single + F_ms (1 − e), F_ms = F_avg E_avg/(1 − F_avg (1 − E_avg))",
      "Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks",
      "",
      "scattering.kulla_conty"};
  static constexpr std::array parameters = KullaConty<T>::parameters;
  static constexpr std::array<std::string_view, 1> outputs{"albedo"};

  static std::array<T, 1> apply(std::span<const T, 4> p) {
    return {p[0] + p[3] * p[2] / (1 - p[3] * (1 - p[2])) * (1 - p[1])};
  }
};

/// The lobe whose albedo is F_ms (1 − E):  f_ms = F_ms (1 − E_l)(1 − E_v)/(π (1 − E_avg)) [1/sr]; where
/// nothing is lost, 0.
template <Real T>
struct KullaContyLobe {
  static constexpr About about{
      "scattering.kulla_conty.lobe", "The lobe of multiple scattering",
      "f = F_ms (1 − e_light)(1 − e_view)/(π (1 − E_avg)), F_ms as scattering.kulla_conty",
      "Kelemen, Szirmay-Kalos 2001; Kulla, Conty 2017", "Sony Imageworks' Arnold"};
  static constexpr std::array parameters{
      albedo_parameter("e_light", 0.01, 0.7, false, "albedo at F = 1 of the light's direction"),
      albedo_parameter("e_view", 0.01, 0.7, false, "albedo at F = 1 of the viewer's direction"),
      e_average_parameter, f_average_parameter};
  static constexpr std::array<std::string_view, 1> outputs{"f"};

  static std::array<T, 1> apply(std::span<const T, 4> p) {
    const T lost = 1 - p[2];
    const auto some = T(0) < lost;
    const T lobe = multiple_bounces<T>(p[3], p[2]) * (1 - p[0]) * (1 - p[1]) /
                   (pi<T>() * select<T>(some, lost, T(1)));
    return {select<T>(some, lobe, T(0))};
  }
};

/// The lobe as it is, brighter:  albedo = E_single (1 + F0 (1/E − 1)),  less than E_single where a fitted E is above 1
template <Real T>
struct Turquin {
  static constexpr About about{
      "scattering.turquin", "Single scattering made brighter by what it lost",
      "albedo = e_single (1 + f0 (1/e − 1))",
      "Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models", "Filament"};
  static constexpr std::array parameters{fitted_e_single_parameter, fitted_e_parameter,
                                         f0_parameter};
  static constexpr std::array<std::string_view, 1> outputs{"albedo"};

  static std::array<T, 1> apply(std::span<const T, 3> p) {
    return {p[0] * (1 + p[2] * (1 - p[1]) / p[1])};
  }
};

/// Turquin's with the average of the Fresnel term in place of its least value, for what comes out was reflected at all
/// angles:  albedo = E_single (1 + F_avg (1/E − 1)),  F_avg = F0 + (F90 − F0)/21
template <Real T>
struct TurquinAverage {
  static constexpr About about{
      "scattering.turquin.f_avg",
      "Single scattering made brighter by what it lost, with the average Fresnel reflectance",
      "albedo = e_single (1 + F_avg (1/e − 1)), F_avg = f0 + (f90 − f0)/21",
      "MaterialX, mx_microfacet_specular.glsl, mx_ggx_energy_compensation, since June 2026",
      "MaterialX",
      "scattering.turquin"};
  static constexpr std::array parameters{fitted_e_single_parameter, fitted_e_parameter,
                                         SchlickF90<T>::parameters[0],
                                         SchlickF90<T>::parameters[1]};
  static constexpr std::array<std::string_view, 1> outputs{"albedo"};

  static std::array<T, 1> apply(std::span<const T, 4> p) {
    return Turquin<T>::apply(std::array{p[0], p[1], schlick_average<T>(p[2], p[3])});
  }
};

/// Multiple scattering of the split sum's A and B, no table beside theirs:
///
///   s = F0 A + B,   m = 1 − (A + B),   F_avg = F0 + (1 − F0)/21
///   albedo = s + m s F_avg/(1 − F_avg m) = s/(1 − F_avg m)
template <Real T>
struct FdezAguera {
  static constexpr About about{
      "scattering.fdez_aguera", "Multiple scattering of image-based light, from the split sum",
      "albedo = s + m s F_avg/(1 − F_avg m), s = f0 a + b, m = 1 − (a + b), "
      "F_avg = f0 + (1 − f0)/21",
      "Fdez-Agüera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based "
      "Lighting, JCGT 8(1)",
      "three.js"};
  static constexpr std::array parameters{
      albedo_parameter("a", 1e-6, 0.6, false, "split sum's factor of F0"),
      albedo_parameter("b", 0, 0.05, false, "split sum's rest"), f0_parameter};
  static constexpr std::array<std::string_view, 1> outputs{"albedo"};

  static std::array<T, 1> apply(std::span<const T, 3> p) {
    const T lost = 1 - (p[0] + p[1]);
    return {(p[2] * p[0] + p[1]) / (1 - schlick_average<T>(p[2]) * lost)};
  }
};

/// E(μ) of GGX under Smith's correlated masking, for shaders that have no table.  With t = α/(α + μ),
/// which has the layer at the horizon that is as thin as α in it, 1 − E is
///
///   t² (1 − t) (t (a0 + a1 t + a2 t² + a3 t³) + α² (b0 + b1 t + b2 t² + b3 t⁴)
///               + α³ t² (c0 + c1 t + c2 t² + c3 t³))
///
/// Off by at most 0.0049 over roughness in [0.05, 1] and all of NoV, RMS 0.0024 (evenly in roughness and
/// √NoV); on smoother surfaces by no more.  In float 5e-6 are added, in half 0.018, for its terms cancel.
/// AlbedoFit.IsTheBestOfItsForm (albedo_fit_test.cpp) makes the numbers, and prints them where others are
/// better.
template <Real T>
struct AlbedoFit {
  static constexpr About about{
      "scattering.albedo_fit", "Albedo at F = 1 of GGX under correlated Smith, fitted",
      "e = 1 − t²(1−t) (t p(t) + alpha² q(t) + alpha³ t² r(t)), t = alpha/(alpha + NoV); p, r "
      "cubic, "
      "q = b0 + b1 t + b2 t² + b3 t⁴",
      "fitted here to quadrature: off by at most 0.0049, RMS 0.0024, from roughness 0.05 on"};
  static constexpr std::array parameters{alpha_parameter,
                                         Parameter{"nov", {0, 1}, {0, 1}, 0.5, false, "n·v"}};
  static constexpr std::array<std::string_view, 1> outputs{"e"};

  static std::array<T, 1> apply(std::span<const T, 2> p) {
    const auto c = [](long double x) { return constant<T>(x); };
    const T alpha = p[0], t = alpha / (alpha + p[1]), t2 = square(t);
    const T smooth = c(12.09157L) + t * (c(-38.80408L) + t * (c(44.94859L) + t * c(-18.20285L)));
    const T rough = c(37.44214L) + t * (c(-96.32622L) + t * (c(79.32841L) + t2 * c(-16.38829L)));
    const T rougher = c(-149.7673L) + t * (c(524.3519L) + t * (c(-631.772L) + t * c(257.7272L)));
    return {1 - t2 * (1 - t) * (t * smooth + square(alpha) * (rough + alpha * t2 * rougher))};
  }
};

/// MaterialX's fit of the split sum's A and B, each a quotient of biquadratics in μ and α; E is their sum.
/// Over the same roughnesses and NoV off by at most 0.127, RMS 0.018; A by 0.099, B by 0.045.
template <Real T>
struct AlbedoFitMaterialx {
  static constexpr About about{
      "scattering.albedo_fit.materialx", "The split sum's A and B, and their sum, MaterialX's fit",
      "a, b = clamp(num/den, 0, 1), each biquadratic in NoV and alpha; e = a + b",
      "MaterialX, mx_microfacet_specular.glsl, mx_ggx_dir_albedo_analytic", "MaterialX"};
  static constexpr std::array parameters = AlbedoFit<T>::parameters;
  static constexpr std::array<std::string_view, 3> outputs{"e", "a", "b"};

  static std::array<T, 3> apply(std::span<const T, 2> p) {
    const T &alpha = p[0], x2 = square(p[1]), alpha2 = square(alpha);
    // of 1, x, x²: times 1, α, α²
    const auto biquadratic = [&](const std::array<long double, 9>& k) {
      const auto along = [&](std::size_t i) {
        return constant<T>(k[i]) + constant<T>(k[i + 1]) * p[1] + constant<T>(k[i + 2]) * x2;
      };
      return along(0) + alpha * along(3) + alpha2 * along(6);
    };
    const auto quotient = [&](const std::array<long double, 9>& num,
                              const std::array<long double, 9>& den) {
      return min<T>(max<T>(biquadratic(num) / biquadratic(den), T(0)), T(1));
    };
    const T a =
        quotient({0.1003L, -0.6303L, 29.34L, 9.748L, -2.038L, -26.44L, -8.245L, 19.99L, -5.448L},
                 {1, -1.765L, 28.96L, 8.263L, 11.53L, -36.11L, -7.507L, 15.86L, 33.37L});
    const T b =
        quotient({0.9345L, -2.323L, 1.424L, 2.229L, -3.748L, 1.436L, -0.7684L, 0.2913L, 0.6286L},
                 {1, 0.2281L, 13.08L, 15.94L, -55.83L, 54.9L, 41.26L, 300.2L, -285.1L});
    return {a + b, a, b};
  }
};

}  // namespace gonio::inline GONIO_ARCH
