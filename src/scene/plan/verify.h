#pragma once
/// \file
/// Verification of a plan: its forms on fresh points of its scene.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/plan/document.h"
#include "scene/plan/plan.h"

namespace gonio::scene {

struct VerifiedMaterial {
  std::string name;
  std::string reference;  ///< as of MaterialPlan
  bool bounded = false;   ///< its error is known; else nothing is claimed beyond these points
  Judgement found;
  bool holds = false;
};

struct Verification {
  Tolerance tolerance;
  std::vector<VerifiedMaterial> materials;

  bool holds() const;
};

/// Judgement of each material that an object has, by its exact surface in double.  The tolerance holds where the share of points
/// beyond its limit is proved, with its confidence, to be no more than its quantile leaves, and none is beyond its greatest.
/// \param seed     of the points, beside the scene's
/// \param samples  points; else as many as the tolerance needs
Verification verify(const Scene&,
                    const PlannedForms&,
                    std::uint64_t seed = 1,
                    std::optional<std::size_t> samples = {},
                    const std::function<void(double)>& done = {});

/// Document gonio.verification/1, and its schema.
std::string to_json(const Verification&);
std::string verification_schema();

}  // namespace gonio::scene
