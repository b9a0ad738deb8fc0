#pragma once
/// \file
/// The fit: a table and a model in, parameters and how well they are known out.

#include <functional>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "fitting/sampling.h"
#include "fitting/result/document.h"
#include "table/table.h"

namespace gonio {

enum class Intervals {
  automatic,  ///< by_angle for measured tables with enough incident angles, else independent
  independent,
  by_angle  ///< values of one incident angle share their errors; needs two angles
};
inline constexpr std::array<const char*, 3> intervals_names{"automatic", "independent", "by_angle"};

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

struct FitResult {
  FitDocument document;
  BoundModel model;  ///< with the fitted values, also of parameters that are not identifiable
};

/// Throws wrong usage for options that no table could be fitted with.
void check(const FitOptions&);

/// Input path and hash are the caller's to fill in.  Throws wrong usage for options that do not fit
/// the model, bad_input for a table without a usable value.
FitResult fit(const Table&, const FitOptions&, const std::function<void(const char*)>& phase = {});

}  // namespace gonio
