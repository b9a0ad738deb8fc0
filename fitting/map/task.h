#pragma once
/// \file
/// Task of a map's fit: all that is the same for all texels.

#include <utility>
#include <vector>

#include "fitting/lanes/lanes.h"
#include "fitting/map/texels.h"
#include "fitting/solve/problem.h"

namespace gonio {

struct TexelTask {
  TexelTask(const TexelOptions&, std::size_t channels);
  TexelTask(const TexelTask&) = delete;

  TexelOptions asked;
  FitOptions options;  ///< the problem's
  Problem problem;
  TexelUnknowns unknowns;
  std::vector<std::size_t>
      unknown_of;              ///< [slot], the two of the tilt last; unknowns.count: it is held
  std::vector<bool> is_shape;  ///< [slot]: D or V reads it
  /// Shape that is tried: some slots with their values; what else is unknown is then solved for.
  using Start = std::vector<std::pair<std::size_t, float>>;
  /// Groups of them.  The best of each is a way of its own, where the cost has several valleys: of tangents and of several lobes.
  std::vector<std::vector<Start>> starts;
  bool has_dull_group;  ///< the starts of a single lobe are two groups: dull, and the others
  bool is_linear;       ///< f in all that is no shape: that solution is exact

  const Model& model() const { return problem.start.model; }
  bool turns() const { return model().anisotropic; }
};

}  // namespace gonio
