#pragma once
/// \file
/// The split sum of image-based light [Karis 2013]: the prefiltered environment times F0 A + B.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "integrate/albedo/directional_albedo.h"
#include "number/parameter.h"

namespace gonio {

/// Entry of the catalogue, but no composition of terms: `gonio split_sum` evaluates it.
inline constexpr About split_sum_about{
    "model.split_sum", "Image-based light by two sums",
    "L = prefiltered(r) (F0 A + B) + kd (1 − F0) diffuse · irradiance/π",
    "Karis 2013, Real Shading in Unreal Engine 4 (SIGGRAPH course)",
    "Unreal Engine 4, Filament, glTF viewers"};

/// Sums of GGX under Schlick's Fresnel, with (1 − VoH)⁵ as c:
///
///   A = ∫ D V (1 − c) NoL dω_l,   B = ∫ D V c NoL dω_l:   E = F0 A + B
struct SplitSum {
  double a, b;
  double error;  ///< of A, of B and of A + B, at most; not a number where it is not known
};

/// By quadrature, at each NoV in (0, 1].
/// \param masking  "smith_ggx.correlated", with or without its prefix
std::vector<SplitSum> split_sum(std::string_view masking,
                                double roughness,
                                std::span<const double> nov,
                                const Goal& = {});

/// Sums as renderers tabulate them: n half vectors from the points of Hammersley, drawn from D NoH, of
/// which those with l below the horizon count for nothing.
///
///   A = 1/n Σ (1 − c) G₂ VoH / (NoH NoV)                                  [Karis 2013, p. 7]
///
/// Over a table of 64 × 64, correlated, 1024 are off by up to 0.011 in A and 0.0042 in B (RMS 2.5e-3 and
/// 2.8e-4), 65536 by 1.1e-3 and 1.7e-4.
std::vector<SplitSum> sampled_split_sum(std::string_view masking,
                                        double roughness,
                                        std::span<const double> nov,
                                        std::size_t samples);

/// Reflection of a white Lambertian under that interface, by which the environment's irradiance is
/// weighted: coupled Lambert reflects kd (1 − F0) · diffuse of an even environment.  It does not depend
/// on roughness.
///
///   diffuse = ∫ (1 − c) NoL dω_l / π
std::vector<Albedo> split_sum_diffuse(std::span<const double> nov, const Goal& = {});
/// Estimate of it from n directions drawn from the cosine.
std::vector<double> sampled_split_sum_diffuse(std::span<const double> nov, std::size_t samples);

/// GGX with that masking under Schlick's Fresnel; two channels, of F0 as given, by default 0 and 1, so that
/// one integral gives B and A + B.
BoundModel two_interfaces(std::string_view masking,
                          double roughness,
                          const std::array<double, 2>& f0 = {0, 1});

}  // namespace gonio
