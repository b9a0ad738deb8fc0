#pragma once
/// \file
/// Regression of residuals on functions of the angles.

#include <array>

#include "fitting/judge/left_over.h"
#include "fitting/result/document.h"

namespace gonio::misfit {

/// Errors that the values of one incident angle share.
enum class Errors {
  none,
  scale,  ///< a factor: the scale of each angle and channel is left open, where there is room
  any     ///< of any kind: only sums over an angle say something
};

/// Findings of the regressions, in units of the values' own variance.
struct Regression {
  bool tested = false;
  bool rounded = false;  ///< whether little else is left than rounding
  bool limited = false;  ///< whether more values would allow more functions
  double p = 1;
  double excess = 0;                           ///< squares of the misfit beyond noise
  double noise = 0;                            ///< squares that noise makes in as many directions
  double size = 0;                             ///< RMS of the misfit, of f
  double rounding = 0;                         ///< RMS of what rounding leaves, of f
  double left = 0;                             ///< mean square of what is left, of f
  std::array<double, names.size()> follows{};  ///< squares that each angle's functions explain

  double squares = 0, freedom = 0;  ///< of what is left
  double common = 1;                ///< values that say what one would if their errors were its own
  std::size_t scales = 0;           ///< of incident angles, that were left open
  /// Probability that chance makes what is left so much larger than what neighbours differ by, and how
  /// many times as large it is.  Of values with neighbours; 1 without.
  double p_beside_noise = 1, beside_noise = 1;
};

Regression regress(Left, Errors);

/// Probability that scales of incident angles scatter so by chance.
/// \param open  the same regression with the scales open
double luck_of_scales(const Regression&, const Regression& open);

}  // namespace gonio::misfit
