#pragma once
/// \file
/// Order of what a model can say in two ways, so that one table has one answer.

#include <string>
#include <vector>

#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

/// Puts values of the problem's model in order.
/// \return  the slot that each slot's value comes from
std::vector<std::size_t> put_in_order(const Problem&, std::vector<double>& values);

/// Puts a fit's values in order, f being the same:
///
///   lobes of the same terms   by their widths, the narrowest first
///   alpha_x, alpha_y          the wider first, the tangent a quarter turn further where they change places
///   tangent                   from −45° to 135°, which is half a turn
///
/// Lobes and widths that differ in what is held or in their bounds stay where they are, and so does a tangent that is held or has
/// the user's bounds; else its bounds are now a quarter turn to both sides.
/// \return of the free unknowns: what was fixed by that; empty for others
std::vector<std::string> put_in_order(Problem&, Fitted&);

}  // namespace gonio
