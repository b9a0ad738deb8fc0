#pragma once
/// \file
/// Albedos with multiple scattering: of composed models under the compensations of brdf/formula/scattering.h, and
/// what walk.h and half_space.h solve, with diffuse terms and as averages.

#include <array>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/names.h"
#include "brdf/model/model.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/scattering/half_space.h"
#include "integrate/scattering/scattered.h"
#include "integrate/scattering/walk.h"
#include "number/parameter.h"

namespace gonio {

/// Entries of the catalogue, but no composition of terms: `gonio albedo --scattering` evaluates them.
inline constexpr About walk_about{
    "scattering.walk", "Multiple scattering by random walks on the microsurface",
    "order 1 is D V F; each further bounce meets a facet below, at the depth that the masking says",
    "Heitz, Hanika, d'Eon, Dachsbacher 2016, Multiple-Scattering Microfacet BSDFs with the Smith "
    "Model"};
inline constexpr About deterministic_about{
    "scattering.deterministic", "Multiple scattering as transport in a half space",
    "the same in τ = −ln C₁(h), integrated over azimuths; isotropic GGX and Beckmann",
    "the surface of Heitz et al. 2016, solved by quadrature"};

/// F_avg = 2 ∫ F(μ) μ dμ of one of the model's Fresnel terms.
Albedo fresnel_average(const BoundModel&, const TermUse& fresnel, const Goal& = {1e-12, 1'000'000});

/// Maps of the catalogue, "scattering." before each name.
enum class Compensation { kulla_conty, kulla_conty_linear, turquin, fdez_aguera };
template <>
inline constexpr std::array<std::string_view, 4> names_of<Compensation>{
    "kulla_conty", "kulla_conty.linear", "turquin", "fdez_aguera"};

/// Albedos of one model's lobes without compensation, which all its compensations share.
class LobeAlbedos {
 public:
  /// \param compute  finds it where it is not known yet
  Albedo at(
      std::size_t lobe, double mu, double phi, const Goal&, const std::function<Albedo()>& compute);

 private:
  std::mutex mutex_;
  std::map<std::tuple<std::size_t, double, double, double, std::size_t>, Albedo> known_;
};

/// Albedo of the model, each of its lobes compensated by itself, at each μ = NoV in (0, 1], in parallel.
/// E and E_avg of a lobe are its own at F = 1; F0 is its Fresnel term at normal incidence; F_avg the
/// integral above, but Fdez-Agüera's own, and A and B are only of fresnel.schlick: any other is wrong
/// usage there.  The bound is carried over from those of the integrals; their goals are chosen so
/// that it is about what was asked for.
///
/// \param lobes  filled and read where the same model is asked under several compensations
std::vector<Albedo> compensated_albedo(const BoundModel&,
                                       Compensation,
                                       std::span<const double> mu,
                                       double phi = 0,
                                       const Goal& = {},
                                       LobeAlbedos* lobes = nullptr);

/// Its average over the hemisphere, as hemispherical_albedo().
Albedo compensated_average(const BoundModel&,
                           Compensation,
                           const Goal& = {},
                           LobeAlbedos* lobes = nullptr);

/// Lobes' multiple scattering with the diffuse terms added: the error is the largest of all channels.
Albedo with_diffuse(const Scattered& lobes, const Albedo& diffuse);
/// The diffuse terms' own average over the hemisphere.
Albedo diffuse_average(const BoundModel&, const Goal& = {});

}  // namespace gonio
