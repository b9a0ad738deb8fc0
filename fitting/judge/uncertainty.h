#pragma once
/// \file
/// Uncertainty of the parameters: how well the data determine them.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fitting/judge/assess.h"
#include "fitting/result/document.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// Value, error or end of an interval that the data do not give.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Unknowns that the bread tells apart.
struct Determined {
  std::vector<ParameterStatus> status;  ///< `free` of those
  std::vector<std::size_t> unknowns;    ///< those
  double condition = 1;  ///< largest over smallest eigenvalue of the bread, scaled to unit diagonal
};
/// A parameter at its bound is held there for the others.  Any other is not identifiable if moving it
/// over its whole range changes nothing, or if it belongs to a direction in which the bread is singular.
/// \param singular  eigenvalues of the scaled bread below it are rounding
Determined find_determined(const ArrowMatrix& bread,
                           std::span<const double> x,
                           const Bounds&,
                           double singular = 1e-11);

/// What the data say of one unknown.
///
/// Judges speak one after the other, and a later one has the last word:
/// 1. uncertainty(): at a bound, not identifiable beside the others, or a standard error and its interval;
/// 2. widen(): the interval allows for a misfit and for gains that angles share;
/// 3. find_undetermined(): what the cost itself leaves open takes the value, a limit or the ends of the interval;
/// 4. keep_to_what_is_seen(): so does what the table cannot show of any model;
/// 5. bootstrap(), where asked: ends of the intervals that are left.
/// A texel of a map stops after the first: its status is of find_determined() and of fills().
struct ParameterVerdict {
  ParameterStatus status = ParameterStatus::free;
  double std_error = not_known;
  double t = not_known;  ///< half width of the 95 % interval in standard errors
  double low = not_known,
         high = not_known;   ///< ends of an interval that is not ± t standard errors
  double limit = not_known;  ///< one-sided 95 % bound of an upper_limit or lower_limit
  /// Degrees of freedom, and the variance of one value's residual for which the bread alone would give that error.
  double freedom = not_known, variance = not_known;
  std::string reason = {};  ///< why there is no more than that; else empty

  /// Takes the value away: the data do not give it.
  void forget(std::string why);
  /// Leaves a one-sided 95 % bound.  \param side  upper_limit or lower_limit
  void keep_limit(ParameterStatus side, double bound, std::string why);
  /// Keeps the value, which nothing bounds.
  /// \param best    what it is the best value of   \param at_end  whether it stands at the end of its range
  void leave_unbounded(const char* best, bool at_end, const char* why);
  /// Ends of the 95 % interval about the unknown's value; NaN without a standard error.
  double low_end(double value) const { return std::isnan(low) ? value - t * std_error : low; }
  double high_end(double value) const { return std::isnan(high) ? value + t * std_error : high; }
};
/// True of a 95 % interval as wide as the range of its parameter, which is then not identifiable.
inline bool fills(double half_width, double range) {
  return 2 * half_width >= range;
}

/// Verdicts of all unknowns, by the number of the free slot.
struct Uncertainty {
  std::vector<ParameterVerdict> verdicts;
  ParameterVerdict& operator[](std::size_t i) { return verdicts[i]; }
  const ParameterVerdict& operator[](std::size_t i) const { return verdicts[i]; }
  std::vector<double> std_errors() const;
  /// Correlations of some of the unknowns, NaN for what has no error.  Of many unknowns they are those that all channels share and
  /// those of one channel, in which two are hardest to tell apart: others take place with the square of the channels.
  std::vector<std::size_t> correlated;
  std::vector<std::vector<double>> correlations;
  double condition = 1;  ///< see Determined

  Uncertainty() = default;
  /// Nothing is known of that many.
  explicit Uncertainty(std::size_t unknowns);
};

/// Standard errors by the sandwich B⁻¹ M B⁻¹, which holds whether or not the metric whitens the noise,
/// each value's (or each cluster's) residuals being those that a fit without it would leave: HC3 and its
/// form for clusters [MacKinnon, White 1985; Bell, McCaffrey 2002].  The interval's half width is
/// Student's t; its degrees of freedom are the number of values (clusters) that the parameter in truth
/// rests on.
///
/// An unknown that a single value or cluster determines alone has no error: none of the others knows it.
/// Nor has one whose interval would be as wide as its range, which is not identifiable.
///
/// \param stated  the residuals are in known standard errors: then the errors are those of B⁻¹, whose half width is 1.96
Uncertainty uncertainty(const Sandwich&,
                        std::span<const double> x,
                        const Bounds&,
                        double samples_used,
                        bool stated = false);

/// The one of two that has the wider interval, parameter by parameter; none where one has none.
Uncertainty wider(Uncertainty, const Uncertainty&);

}  // namespace gonio
