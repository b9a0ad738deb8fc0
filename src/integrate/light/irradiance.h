#pragma once
/// \file
/// Diffuse irradiance E(n) = ∫ L(ω) (n·ω) dω over the hemisphere of n: exactly, and by the sums that
/// renderers take.

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "image/environment.h"

namespace gonio {

/// Irradiance of a map: each column's part above the horizon in closed form over θ, by Gauss over φ.
///
///   ∫ (a sin θ + b cos θ) sin θ dθ = a (θ − sin θ cos θ)/2 + b sin² θ/2,   a = n_xy cos(φ − φ_n), b = n_z
///
/// Even light is off by at most 4e-6, in a map of one row.
Rgb irradiance(const Environment&, const Direction& n);

/// Radiance from a direction.
using Radiance = std::function<Rgb(const Direction&)>;

/// Choice of directions around n, and their weights.
enum class IrradianceRule {
  /// Equal steps in θ and φ from their low ends, as the usual shader has it; step_θ = step_φ.  Seed 003 says
  /// "the sum over the hemisphere, divided by the number of samples": without its π² that would be E/10.
  ///
  ///   E = π²/N Σ L cos θ sin θ
  riemann,
  riemann_midpoint,  ///< the same from the middle of each step
  cosine,            ///< points of Hammersley, drawn from cos θ/π:  E = π/N Σ L
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<IrradianceRule>{
    "riemann", "riemann_midpoint", "cosine"};

struct SampledIrradiance {
  Rgb value{};
  std::size_t samples = 0;  ///< those taken
};

/// By about so many samples: Riemann sums take n × 4n.
SampledIrradiance sampled_irradiance(const Radiance&,
                                     const Direction& n,
                                     IrradianceRule,
                                     std::size_t samples);

/// sampled/exact − 1, of luminance, over normals.
struct IrradianceError {
  IrradianceRule rule;
  std::size_t samples = 0;
  double rms = 0, max = 0, bias = 0;  ///< max: of |…|; bias: the mean; of no normal not a number
  std::size_t normals = 0;            ///< those to which light comes
};

/// Every rule with each count, over `normals` even over the sphere; those that light does not come to are left
/// out.
std::vector<IrradianceError> irradiance_errors(const Radiance&,
                                               const std::function<Rgb(const Direction&)>& exact,
                                               std::span<const std::size_t> counts,
                                               std::size_t normals = 32);

}  // namespace gonio
