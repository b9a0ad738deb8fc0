#pragma once
/// \file
/// Albedo of a model as `gonio albedo` and `gonio.albedo` are asked for it, and the document of the answer.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "integrate/scattering/compensation.h"

namespace gonio {

/// What is asked; the defaults are those of the command.
struct AlbedoQuestion {
  std::vector<double> mu;  ///< cosines of the zenith angle, in (0, 1]
  double phi_deg = 0;      ///< azimuth from the tangent [°]
  std::string scattering = "single";
  std::optional<double> error;  ///< asked for; each way of scattering has its own default
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> walks;
  bool average = false, furnace = false;
};

/// Names of `scattering`.
std::vector<std::string> scatterings();

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
