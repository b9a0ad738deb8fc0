#pragma once
/// \file
/// Next steps: what may help where a model misses its table, or where little is known.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fitting/judge/other_units.h"
#include "fitting/judge/warnings.h"
#include "fitting/result/document.h"
#include "fitting/solve/options.h"

namespace gonio {

/// Log RMS that a model leaves on a coarse sample of the table; NaN of one that cannot be fitted to it.
using TryModel = std::function<double(const std::string& spec)>;

/// The unit that values may have where a model misses them, see other_unit().
using TryUnits = std::function<std::optional<OtherUnit>(double here)>;

/// Sentences, the most promising first and five at most; none of a fit of which there is nothing to
/// beware.  Models are named as --model takes them.  Those for a
/// misfit were tried, and take up a third of it at least, in squares.
std::vector<std::string> next_steps(
    const FitOptions&, const FitDocument&, const FitFacts&, const TryModel&, const TryUnits& = {});

}  // namespace gonio
