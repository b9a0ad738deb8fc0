#pragma once
/// \file
/// Worth of a fit: how well the data determine each parameter, and what the model leaves over.
/// One pass over all samples, each on its own.

#include <vector>

#include "brdf/model/model.h"
#include "fitting/judge/influences.h"
#include "fitting/result/document.h"
#include "fitting/sample/sampling.h"
#include "fitting/solve/accumulate.h"

namespace gonio {

/// Values that share their errors.
struct Cluster {
  ArrowMatrix bread;          ///< their part of the whole bread
  std::vector<double> score;  ///< Σ s over them
};

/// Parts of the sandwich (bread)⁻¹ meat (bread)⁻¹.
struct Sandwich {
  ArrowMatrix bread;  ///< Σ j jᵀ over the residuals that the robust loss does not clip
  /// Σ s sᵀ/(1 − h)², s = ρ' r j, over values that are independent; h is 0 where no influences are
  /// given.  0 where there are clusters.  A value that counts as several samples is that often there.
  ArrowMatrix meat;
  std::vector<Cluster> clusters;  ///< of each incident angle
  /// Per unknown, of independent values and given influences: Σ β⁴, the part of Σ β² = 1 that comes
  /// from values which alone determine something, and Σ of the fourth powers of the moves B⁻¹ s/(1 − h)
  /// over the error (B⁻¹)_kk².
  std::vector<double> fourth, alone, moves;
};

struct Assessment {
  Sandwich sandwich;
  FitResiduals residuals;  ///< over all values, and per band of theta_i, theta_h and theta_d
  std::size_t incident_angles = 0;  ///< counted where scores are summed over them
  SampleCounts counts;
};

/// Sums over a table for one model, see IncidentKeys for its incident angles.
/// \param by_incident_angle  whether values of one incident angle make a cluster
/// \param influences         of independent values; null: leverages count as 0
/// \param in_float           where its six digits are enough
/// \param most               about how many groups are looked at
Assessment assess(const Sampling&,
                  const BoundModel&,
                  const FreeSlots&,
                  double huber,
                  bool by_incident_angle,
                  const Influences* influences = nullptr,
                  bool in_float = false,
                  std::size_t most = static_cast<std::size_t>(-1));

/// Residuals of a model against a table.
FitResiduals residual_statistics(const BoundModel&, const Sampling&, std::size_t most);

}  // namespace gonio
