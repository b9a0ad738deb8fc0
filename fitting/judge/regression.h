#pragma once
/// \file
/// Regression of residuals on functions of the angles.

#include <array>
#include <optional>

#include "fitting/judge/left_over.h"
#include "fitting/result/document.h"

namespace gonio::misfit {

/// Findings of the regressions, in units of the values' own variance.
struct Regression {
  bool tested = false;
  double p = 1;
  double excess = 0;                           ///< squares of the misfit beyond noise
  double noise = 0;                            ///< squares that noise makes in as many directions
  double functions = 0;                        ///< these directions
  double size = 0;                             ///< RMS of the misfit, of f
  double rounding = 0;                         ///< RMS of what rounding leaves, of f
  bool rounded = false;                        ///< whether little else is left
  std::array<double, names.size()> follows{};  ///< squares that each angle's functions explain
  std::optional<MisfitCell> worst;
};

/// \param shared  whether the values of one incident angle share their errors
/// \param gains   whether the scale of each incident angle is left open, where there is room
Regression regress(Left&, bool shared, bool gains);

}  // namespace gonio::misfit
