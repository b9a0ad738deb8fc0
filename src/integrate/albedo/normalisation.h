#pragma once
/// \file
/// ∫ D(m) (n·m) dω over the hemisphere: 1 for a distribution of normals.

#include <cstddef>
#include <span>

#include "integrate/rule/cubature.h"

namespace gonio {

struct Normalisation {
  double value = 0;
  double error = 0;  ///< infinite, as the value is, where the integral diverges
  std::size_t evaluations = 0;
};

/// Normalisation of the ndf term `term` (an index into catalogue()).  Over slopes as directional_albedo() has them up
/// to 45°, over θ_h from there to the horizon, where a distribution that is still 1/NoH² or more
/// diverges.  An anisotropic one is taken to be its own mirror image by tangent and bitangent.
Normalisation normalisation(std::size_t term,
                            std::span<const double> parameters,
                            const Goal& = {1e-12, 1'000'000});

}  // namespace gonio
