#pragma once
/// \file
/// Plan of what to measure next: the directions that narrow the widest interval of a fit most.

#include <cstddef>
#include <functional>
#include <vector>

#include "fitting/solve/options.h"
#include "table/health/next_direction.h"
#include "table/table.h"

namespace gonio {

/// Directions that a plan may have at most.
inline constexpr std::size_t most_planned = 256;

/// The model is fitted to the table; what n more directions of candidates() would add to the fit's information follows from its derivatives
/// at the values found, and from the noise that its residuals have in the metric: √(2 cost/(N − p)) a value, in all channels of a
/// direction at once, relative under `log` (see Forecast).
///
/// Widths of different parameters are compared over the parameter's value, so that a width of 0.01 is much for an alpha of 0.02 and little for
/// an eta of 1.5; of a value below a hundredth of its range, over that hundredth: else the black channel of a red paint took all
/// directions.  A parameter of which the fit tells no interval is wider than all that have one; one that is pushed against the
/// end of its range is left there, and one that is known up to a limit is as wide as from there to the end.
///
/// Each direction is the one that narrows what is then widest most, judged by the interval that the fit will tell; then each is exchanged for whatever
/// narrows the widest of all in the end, until nothing does.  No two lie within 2° of each other, mirrored or with light and viewer
/// exchanged, while there are others: such values would share what is wrong there.  Rows come in the order in which they help: the
/// widest first.  `width_before` of the first row is that of the fit.  Of a table of more than four channels four are looked at, evenly spread.
///
/// The derivatives are those at the fit's values: where a table says nothing of a parameter they are a guess, and so is the plan for it.
/// Throws wrong usage without a free parameter, bad_input of a table with no more values than these, not_converged of a fit
/// that did not.
/// \param n  1 to most_planned
std::vector<NextDirection> plan_next(const Table&,
                                     const FitOptions&,
                                     std::size_t n,
                                     const std::function<void(const char*)>& phase = {});

}  // namespace gonio
