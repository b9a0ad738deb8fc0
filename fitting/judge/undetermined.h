#pragma once
/// \file
/// Limits of what is determined: a value with its interval, an upper or lower limit, or nothing.

#include <span>
#include <string>

#include "fitting/judge/uncertainty.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

enum class Lobes { whole, fresnel };
/// Takes the values of all lobes, or of their Fresnel terms, away.
void forget_lobes(const Problem&, Uncertainty&, Lobes, const std::string& why);

/// Takes the value from parameters that can be anything: moved over its whole range, the others as
/// they are, such a one lowers or raises the cost by no more than luck does.  A lobe that may be put
/// anywhere can always please one of N noisy values, which is worth 2 ln N [the largest of N squared
/// normal deviates].  Asked of the widths and exponents, which a vanished lobe leaves free, and of
/// what stands at a bound.
///
/// The lobe as a whole is asked too: where the diffuse terms alone, fitted anew, do as well or better,
/// nothing is known of it.  It may be unable to vanish: Schlick's F is 1 at 90° whatever f0 is.
/// Returns whether that is so; intervals of the diffuse terms then hold what is left of them beside any lobe.
///
/// A parameter that is left and stands at a bound of all values there are, or has an interval as wide as
/// its range, is held elsewhere, the others moved to where they are best.  Where only one end of the range costs
/// more than luck does it has a limit, the one-sided 95 % bound; where neither does, nothing is known;
/// else it has an interval.  What stands at a bound and is pushed against it, at_bound, has none of
/// these.  An interval that is wide for its value, and within which the cost is not a parabola, becomes
/// that of the values that cost less than t² variances of a value more [profile likelihood].
/// \param thin  a thinned table   \param counts  of the whole one
/// \param widened  whether the intervals allow for a misfit: a value whose whole range that leaves open
///                 stays, as the best one of this model, and so do the others of its lobe
/// \param lost_below  size of values that noise or digits took away from each channel [1/sr]: a diffuse term then has an upper limit
///
/// The interval of a known parameter includes how far it moves while the unknown ones take every value that they may have.
bool find_undetermined(const Problem&,
                       const FitData<double>& thin,
                       const Fitted&,
                       const SampleCounts&,
                       bool widened,
                       Uncertainty&,
                       std::span<const double> lost_below = {});

}  // namespace gonio
