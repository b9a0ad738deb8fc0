#pragma once
/// \file
/// The options of a fit: what is free, how values are compared, how intervals are made.

#include <array>
#include <string>
#include <vector>

#include "base/names.h"
#include "brdf/model/model.h"
#include "fitting/sample/sampling.h"

namespace gonio {

enum class Intervals {
  automatic,  ///< by_angle for measured tables with enough incident angles, else independent
  independent,
  by_angle  ///< values of one incident angle share their errors; needs two angles
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<Intervals>{"automatic", "independent",
                                                                     "by_angle"};

struct FitOptions {
  std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  std::vector<Setting> fixed;  ///< parameters held at a value
  std::vector<Setting>
      bounds;  ///< NAME=low,high instead of the parameter's own range; roughness too
  std::vector<std::string> grey;  ///< colour parameters with one value for all channels
  Metric metric = Metric::log;
  bool robust = false;  ///< Huber's loss beyond 1.345 robust standard deviations
  Intervals intervals = Intervals::automatic;
  bool bin_sensitivity = true;  ///< fit again under the other bin convention
};

}  // namespace gonio
