#pragma once
/// \file
/// Multiple scattering on Smith's microsurface by random walks [Heitz et al. 2016, Multiple-scattering
/// microfacet BSDFs with the Smith model]: what the compensations of single scattering approximate.

#include <cstdint>
#include <span>
#include <vector>

#include "brdf/model/model.h"
#include "geometry/direction.h"
#include "integrate/scattering/scattered.h"

namespace gonio {

struct WalkGoal {
  std::uint64_t seed = 1;
  std::size_t walks = 1'000'000;  ///< at most, by mu and lobe
  double error = 0;               ///< enough where every standard error is no larger
  std::size_t bounces = 1000;     ///< after which a walk is cut off
};

/// Share of the light arriving from each μ = NoV in (0, 1] that leaves again, by the number of bounces; in
/// parallel.  Every lobe has to be one of microsurfaces(), else it is wrong usage; diffuse terms are left out.
///
/// Light dives into the surface from its top until it meets a facet, is weighted with the facet's
/// Fresnel term, in all channels together, reflected, and so on until it gets out.  Depth is counted as τ =
/// −ln C₁(h), C₁ being the part of the surface that is lower than h: whatever the heights' distribution,
/// light that flies along w meets a facet every |w_z|/σ(−w) of τ on average,
///
///   σ(−w) = |w_z| Λ(w) upwards, |w_z| (1 + Λ(−w)) downwards      [after Heitz et al. 2016]
///
/// and upwards from τ it gets out with the probability e^(−τ Λ(w)).  Λ is what the catalogue's masking
/// has for l under a v along the normal: NoL (1 + Λ(l)) = 1/(4 V(l, n)).
///
/// `error` is the standard error of `albedo`.  Walks draw their numbers 2¹⁴ from a stream, by the seed, the
/// place in mu and of those 2¹⁴, and are summed in that order: threads change nothing.
///
/// In one thread with AVX-512 a bounce takes 60 ns on GGX and 130 on Beckmann, alpha = 0.8, one channel of
/// Schlick; three of the conductor add 12.
///
/// \param phi  azimuth of v from the tangent, for anisotropic models [rad]
std::vector<Scattered> walk(const BoundModel&,
                            std::span<const double> mu,
                            double phi = 0,
                            const WalkGoal& = {});

/// Its average over the hemisphere, 2 ∫ E(μ) μ dμ and over azimuths: each walk enters from a direction of
/// its own, drawn from the cosine, so that `error` is all that there is.
Scattered walk_average(const BoundModel&, const WalkGoal& = {});

/// f(l, v) [1/sr] by number of bounces, and the standard errors.
struct WalkValue {
  std::vector<double> value, error;                     ///< [channel], all orders
  std::vector<std::vector<double>> order, order_error;  ///< [channel][n − 1]
  std::vector<double> rest;                             ///< [channel], as of Scattered
};

/// By the same walks from v, which at each facet ask for the light that goes from there along l:
///
///   f NoL = E Σ weight · F D(h)/(4 σ(−w)) · e^(−τ Λ(l)),   h the half vector of −w and l
///
/// with the sum over bounces.  Order 1 is D V F, what models without multiple scattering have.  `goal.error` is
/// not read.
/// \param l, v  unit vectors above the surface: else wrong usage
WalkValue walk_value(const BoundModel&,
                     const Direction& l,
                     const Direction& v,
                     const WalkGoal& = {});

}  // namespace gonio
