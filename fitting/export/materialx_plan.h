#pragma once
/// \file
/// A plan in MaterialX: each material twice over one graph, with all its effects and as planned.  What the plan leaves out
/// stands in the graph under a constant weight, 1 or 0, of the material's node: renderers that prune lobes drop it, and so
/// does a compiler that folds constants.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brdf/model/model.h"

namespace gonio {

/// Surface below a coat of one lobe, if it has one.
struct CoatedModel {
  BoundModel base;
  std::optional<BoundModel> coat;
};
/// Material with all effects exact, and as planned.
struct PlannedModel {
  std::string name;
  CoatedModel exact, planned;
  double tangent_deg = 0;  ///< azimuth of the tangent, in which both models stand
};

struct MaterialxPlan {
  std::string file;
  /// What MaterialX computes otherwise than the plan says, in sentences.
  std::vector<std::string> differs;
};

/// Materials NAME and NAME_exact of each, with the plan in a comment.  A letter that no name of MaterialX has becomes "_".
/// \param plan  bytes of its document
MaterialxPlan materialx_of(std::span<const PlannedModel>, const std::string& plan);

}  // namespace gonio
