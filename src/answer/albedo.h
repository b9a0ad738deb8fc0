#pragma once
/// \file
/// Albedo of a model as `gonio albedo` and `gonio.albedo` are asked for it, and the document of the answer.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/names.h"
#include "brdf/model/model.h"
#include "integrate/scattering/compensation.h"

namespace gonio {

/// Light that meets one facet; all of it by walks or by quadrature; or as shaders compensate, the values of Compensation.
enum class Scattering {
  single,
  walk,
  deterministic,
  kulla_conty,
  kulla_conty_linear,
  turquin,
  fdez_aguera
};
template <>
inline constexpr std::array<std::string_view, 7> names_of<Scattering>{
    "single",  "walk",       "deterministic", "kulla_conty", "kulla_conty.linear",
    "turquin", "fdez_aguera"};

/// What is asked: the options of `gonio albedo`, and the keywords of Python's `albedo`.
struct AlbedoQuestion {
  std::vector<double> mu = {};
  double phi_deg = 0;
  bool average = false, furnace = false;
  Scattering scattering = Scattering::single;
  std::optional<double> error = {};  ///< each way of scattering has its own default
  std::optional<std::size_t> walks = {};
  std::optional<std::uint64_t> seed = {};
};
template <>
inline constexpr auto description<AlbedoQuestion> = FieldList{
    Field{"mu", &AlbedoQuestion::mu, "cosines of the zenith angle, in (0, 1]"},
    Field{"phi", "degrees", &AlbedoQuestion::phi_deg,
          "azimuth from the tangent, of anisotropic models"},
    Field{"average", &AlbedoQuestion::average,
          "also the average over the hemisphere, 2 ∫ E mu dmu"},
    Field{"furnace", &AlbedoQuestion::furnace,
          "with F = 1: what is then lost, masking has taken away"},
    Field{"scattering", &AlbedoQuestion::scattering,
          "single: light that meets one facet; all of it by random walks (walk) or by quadrature "
          "(deterministic); or as shaders compensate: kulla_conty, turquin, fdez_aguera"},
    Field{"error", &AlbedoQuestion::error,
          "absolute error asked for (1e-8; deterministic 1e-5; of a walk the standard error at "
          "which it may stop)"},
    Field{"walks", &AlbedoQuestion::walks, "random walks at most, at each mu and lobe (1000000)",
          Numbers{2, 0x1p40}},
    Field{"seed", &AlbedoQuestion::seed, "seed of the random walks (1)"}};
static_assert(describes_every_member<AlbedoQuestion>());

/// At each mu, and on average; of a walk or a half space also by number of bounces.
struct AlbedoAnswer {
  std::string model;  ///< its spec
  std::vector<Albedo> at;
  std::optional<Albedo> average;
  std::vector<Scattered> scattered;
  std::optional<Scattered> scattered_average;
  bool grey = true;  ///< whether all channels are the same
  double error = 0;  ///< the greatest of all
};

/// Listener to the work: what is done, and how many walks of how many.
using AlbedoStep = std::function<void(const std::string& what, std::size_t done, std::size_t all)>;

/// Answer by integrals, walks or transport.
/// \param name  of the model, in errors
/// \throws Error  wrong_usage of a question that cannot be answered, bad_input of a model whose albedo is not finite
AlbedoAnswer albedo_of(const BoundModel&,
                       const std::string& name,
                       const AlbedoQuestion&,
                       const AlbedoStep& step = {});

/// {"model", "scattering", "mu", "albedo", "average", "error_bound", …}
std::string to_json(const AlbedoAnswer&, const AlbedoQuestion&);

}  // namespace gonio
