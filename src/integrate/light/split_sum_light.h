#pragma once
/// \file
/// Split sum of an environment, against the integral that it stands for.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "integrate/light/environment.h"
#include "integrate/light/split_sum.h"

namespace gonio {

/// Light that a GGX surface under Schlick's Fresnel sends to a viewer, exactly and by the split sum:
///
///   exact = ∫ L f NoL dω, which is linear in F0
///   split = P (F0 A + B),   P = ∫ L D NoL dω / ∫ D NoL dω  with n = v = r              [Karis 2013]
///
/// r being the mirror direction of v: lobes of one shape are all that a prefiltered environment can hold.
struct LitView {
  static constexpr std::array<double, 2> f0{0.02, 1};
  std::array<Rgb, 2> exact_at;  ///< at these F0
  Rgb prefiltered;              ///< P
  double a, b;
  double
      error;  ///< of exact and P, relative, summed: what a relative difference of the two is off by

  /// \param at_f0  0.02 to 1
  Rgb exact(double at_f0) const;
  Rgb split(double at_f0) const;
};

/// At one NoV, of `views` normals even over the sphere, the viewer around each by golden angles.
std::vector<LitView> lit_views(const SummedEnvironment&,
                               std::string_view masking,
                               double roughness,
                               double nov,
                               std::size_t views,
                               const RelativeGoal& = {1e-3});

/// split/exact − 1, of luminance, over views.
struct SplitSumLightError {
  double rms = 0, max = 0, bias = 0;  ///< max: of |…|; bias: the mean
  double of_mean = 0;                 ///< RMS of split − exact, over the mean of exact
  double truth = 0;                   ///< what each is off by itself, at most
  Rgb exact{}, split{};               ///< means
  std::size_t views = 0;              ///< those to which light comes
};
/// Views to which nothing comes are left out; of none, errors are not numbers.
SplitSumLightError split_sum_light_error(std::span<const LitView>, double f0);

/// ∫ D NoL dω/4 with n = v, by which P is divided: what GGX, drawn from D NoH, keeps above the horizon, each
/// weighted by NoL.  With u = tan² θ_h
///
///   ∫₀¹ α²/(α² + u)² (1 − u)/(1 + u) du = (1 − (1 − q) s)/(1 + α²),   q = (1 − α²)/(1 + α²),
///   s = −(ln(1 − q) + q)/q²
double prefilter_weight(double alpha);

}  // namespace gonio
