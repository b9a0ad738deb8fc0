#pragma once
/// \file
/// Parameters of which the table knows nothing, though their errors are finite numbers.

#include "fitting/judge/uncertainty.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

/// Takes the value from parameters that can be anything: moved over its whole range, the others as
/// they are, such a one lowers or raises the cost by no more than luck does.  A lobe that may be put
/// anywhere can always please one of N noisy values, which is worth 2 ln N [the largest of N squared
/// normal deviates].  Asked of the widths and exponents, which a vanished lobe leaves free, and of
/// what stands at a bound.
///
/// The lobe as a whole is asked too: where the diffuse terms alone, fitted anew, do as well or better,
/// nothing is known of it.  It may be unable to vanish: Schlick's F is 1 at 90° whatever f0 is.
/// Returns whether that is so.
/// \param thin  a thinned table   \param values_used  of the whole one
bool find_undetermined(const Problem&,
                       const FitData<double>& thin,
                       const Fitted&,
                       std::size_t values_used,
                       Uncertainty&);

}  // namespace gonio
