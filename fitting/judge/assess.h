#pragma once
/// \file
/// Worth of a fit: how well the data determine each parameter, and what the model leaves over.
/// One pass over all samples, each on its own.

#include "brdf/model/model.h"
#include "fitting/result/document.h"
#include "fitting/sample/sampling.h"
#include "fitting/solve/accumulate.h"

namespace gonio {

/// Parts of the sandwich (bread)⁻¹ meat (bread)⁻¹.
struct Sandwich {
  ArrowMatrix bread;  ///< Σ j jᵀ over the residuals that the robust loss does not clip
  ArrowMatrix meat;   ///< Σ s sᵀ, s = ρ' r j, over values that are independent; else 0
  /// Scores of clusters: Σ s of each incident angle, whose squares are the meat.
  std::vector<std::vector<double>> scores;
};

struct Assessment {
  Sandwich sandwich;
  FitResiduals residuals;  ///< over all values, and per band of theta_i, theta_h and theta_d
  std::size_t incident_angles = 0;  ///< counted where scores are summed over them
  SampleCounts counts;
};

/// Incident angles are told apart as the rows of a theta_i axis that are no copies, to 0.001° in a
/// list, and by whole degrees on a half/difference grid, where every sample has its own.
/// \param by_incident_angle  whether scores are summed over each incident angle first
/// \param in_float           where its six digits are enough
/// \param most               about how many groups are looked at
Assessment assess(const Sampling&,
                  const BoundModel&,
                  const FreeSlots&,
                  double huber,
                  bool by_incident_angle,
                  bool in_float = false,
                  std::size_t most = static_cast<std::size_t>(-1));

/// Residuals of a model against a table.
FitResiduals residual_statistics(const BoundModel&, const Sampling&, std::size_t most);

}  // namespace gonio
