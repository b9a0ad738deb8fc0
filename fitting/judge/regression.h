#pragma once
/// \file
/// Regression of residuals on functions of the angles.

#include <array>
#include <optional>
#include <vector>

#include "fitting/judge/azimuths.h"
#include "fitting/judge/left_over.h"
#include "fitting/result/document.h"
#include "fitting/solve/matrix.h"

namespace gonio::misfit {

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
  std::size_t scales = 0;           ///< of angles, that were left open
  /// Probability that chance makes what is left so much larger than what neighbours differ by, and how
  /// many times as large it is.  Of values with neighbours; 1 without.
  double p_beside_noise = 1, beside_noise = 1;
};

/// True where values under each angle of an axis are enough to tell its scale.
bool has_room(const Left&, SharedAngle);

/// \param gains      axes whose angles each have a scale of their own, for each channel, which is left open
/// \param clustered  axis whose angles share errors of any kind: only sums over an angle say something
/// \param only_scatter  finds what is left and its freedom, and tests nothing
/// \param apart      channel whose residuals follow the functions otherwise than those of the others, as a width that depends on the
///                   channel makes them; none: all follow them alike
/// \param harmonics  the functions; none: the smooth ones, and cells
/// The variances are found before.
Regression regress(const Left&,
                   const std::vector<SharedAngle>& gains = {},
                   std::optional<SharedAngle> clustered = {},
                   bool only_scatter = false,
                   std::optional<std::size_t> apart = {},
                   const std::optional<Harmonics>& harmonics = {});

/// Probability that scales of angles scatter so by chance.
/// \param open  the same regression with the scales open
double luck_of_scales(const Regression&, const Regression& open);

/// True where the scales of neighbouring angles of the last axis are nearer to each other than chance lets them be [von
/// Neumann's ratio]: these are no gains, which know nothing of each other, but what a model misses.
/// \param gains  the axes whose scales are open
bool are_smooth(const Left&, const std::vector<SharedAngle>& gains);
/// Largest of the channels' mean logarithms of the last axis's factors, less what noise may do to it through unknowns that may take
/// a scale up, too: what is no gain of any angle, but a scale of the table that the model lacks.
double common_factor(const Left&, const std::vector<SharedAngle>& gains);

/// Squares that the scales leave, and what lessens them: steps of the unknowns, as Left::slots has them [Levenberg, Marquardt].
struct StepBeside {
  double squares;
  Columns products;  ///< of the derivatives
  VectorXd descent;
  std::vector<double> damped(double by) const;
};
StepBeside step_beside(const Left&, const std::vector<SharedAngle>& gains);

/// Standard errors of the unknowns by a gain for each angle, whose standard error is 1 in ln f.
std::vector<double> moved_by_gains(const Left&, SharedAngle);

/// Standard errors of the unknowns by what digits leave out of all values alike.  Residuals show what they leave out of each: where
/// these are smaller, the rest is shared.  Empty where nothing is.
std::vector<double> moved_by_rounding(const Left&);

}  // namespace gonio::misfit
