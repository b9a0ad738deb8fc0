#pragma once
/// \file
/// Bootstrap: spread of the fitted values over tables that are drawn from the fitted one's own samples.

#include <cstddef>

#include "fitting/judge/lack_of_fit.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

/// Tables that are drawn.
inline constexpr std::size_t bootstrap_tables = 400;

/// Standard errors and the ends of 95 % intervals (percentiles) of the values that have one, from fits of
/// tables with as many values, or incident angles, as this one, each drawn from all of them at random
/// with return [Efron 1979].  Of a large table a thinned one is drawn from; the spread of independent
/// values is then smaller by the root of their number.
/// A row is drawn whole, however many samples it counts as.
/// \param by_angle      whether whole incident angles are drawn, as IncidentKeys tells them apart
/// \param seen_against  see widened()
/// \returns false, and leaves all as it is, where there are not two to draw from
bool bootstrap(const Sampling& unfolded,
               const Problem&,
               const Fitted&,
               bool by_angle,
               const LackOfFit&,
               std::span<const double> seen_against,
               Uncertainty&);

}  // namespace gonio
