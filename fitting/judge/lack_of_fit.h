#pragma once
/// \file
/// Lack of fit: whether what a model leaves over follows the angles, which no noise does.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/judge/outliers.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/result/document.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"
#include "table/health/facts.h"

namespace gonio {

/// Incident angle whose values alone are another multiple of the model than those of all others.
struct OddAngle {
  double theta_i_deg;
  double factor;  ///< data over model, beside that of the others
};

/// Misfit of a model, and what it does to the intervals.
struct LackOfFit {
  Misfit misfit;
  double widening = 1;  ///< of the parameters' intervals, so that they include it
  std::optional<OddAngle> odd_angle = {};
  /// Gains that the values of an angle share, of angles other than the incident one, whose clusters know of theirs; none
  /// beside a misfit, which may look like them.
  struct SharedGains {
    std::string of;                 ///< as "outgoing angle"
    double freedom;                 ///< number of angles less 1
    std::vector<double> std_error;  ///< what they make of each free parameter's
  };
  std::vector<SharedGains> gains = {};
  std::optional<Outliers> outliers = {};  ///< or a highlight at wo = wi, which is a misfit
  /// Free parameters less those of a robust fit, which follows outliers less.
  std::vector<double> moved_by_outliers = {};
  /// By how much less the mean logarithm of the darker half of the values is than that of their mean; 0 where it is no more than 1 %.
  double dark_bias = 0;
  /// How far noise of dark values moves each free parameter.
  std::vector<double> moved_by_noise = {};
  /// How far each free parameter moves where the values' scale is free, see moved_by_scale().
  std::vector<double> moved_by_scale = {};
  /// How far each free parameter may be off by what the digits leave out of all values alike, see moved_by_rounding().
  std::vector<double> moved_by_rounding = {};
  /// Part of a parameter's error that is neither noise nor misfit.
  double moved(std::size_t i) const;
};

/// Residuals of the right model follow no angle, whatever the noise.  So these are regressed on smooth
/// functions of the angles, from which the Jacobian's columns have been projected out (what a parameter
/// could still take up is no misfit), and averaged over the cells of a coarse residual map, each against
/// the scatter within it.  A thinned table is enough: of millions of values everything is significant.
///
/// Of many samples only that their errors are independent is assumed [Hotelling's T² of the scores, as
/// the intervals' sandwich], of few that they are of one size in f or in proportion to it [an F test].
/// Where the angles of a measured table scatter more than the values within them, the scale of each angle is left
/// open: of incident angles, outgoing angles, azimuths or places of light and detector, and of two of these at most.
/// From 8 angles on their sums are judged, too.  A robust fit then clips beside those scales, and what they do to the
/// parameters is part of the intervals.  Where noise is in proportion to f, and the metric is another than log, a refit by
/// logarithms is judged: size and cell are that refit's.  Where a fit of logarithms meets noise that is larger beside dark values, or in
/// one channel, a refit that weighs values by it is judged.
///
/// A misfit is significant at 1 % and exceeds 1 % of f, or what noise does to a parameter.  What is left
/// is also compared with what neighbouring values differ by, and the scales of incident angles with what
/// an instrument may do.
/// Values that the model has within the noise of a table that lost values to it are left out: others of them are lifted.
/// Where a table has outliers, a robust fit is judged instead: else their pull would count as misfit.
///
/// Misfit that follows a parameter cannot be seen in what is left; it is taken to be up to four times as
/// large as what can be seen along one function.  Then 97 % of the intervals that allow for a misfit
/// hold the truth, of 3,000 of wrong models; with once 75 %.
LackOfFit lack_of_fit(
    const Sampling&, const Problem&, const Fitted&, double samples_used, TableFacts&);

/// Finds by how much noise of the darkest values moves a fit of logarithms; not where the lower ones of them are lost, which
/// lifts the rest.
/// \param judged  errors before they are widened, beside which little is none
void find_dark_bias(LackOfFit&,
                    const Sampling&,
                    const Problem&,
                    const Fitted&,
                    const Uncertainty& judged,
                    TableFacts&);

/// Adds to the error of a parameter what shared gains, outliers and dark noise make of it.
/// \param i        number of the parameter among the free ones
/// \param freedom  degrees of freedom of the error; becomes those of the sum [Welch, Satterthwaite]
double with_gains(const LackOfFit&, std::size_t i, double error, double& freedom);
/// Error as wide as a misfit asks.
/// \param widening      LackOfFit's
/// \param seen_against  error of the values that it was judged against: where the intervals are those of a
///                      few clusters they know of it already, and as much is added as it does to this; or NaN
double widened(double error, double widening, double seen_against);
/// Makes the intervals as wide as a misfit, shared gains, outliers and dark noise ask.
void widen(Uncertainty&, const LackOfFit&, std::span<const double> seen_against);

}  // namespace gonio
