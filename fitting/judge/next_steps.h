#pragma once
/// \file
/// Next steps: what may help where a model misses its table, or where little is known.

#include <string>
#include <vector>

#include "fitting/judge/warnings.h"
#include "fitting/result/document.h"
#include "fitting/solve/options.h"

namespace gonio {

/// Sentences, the most promising first and five at most; none of a fit of which there is nothing to
/// beware.  Models are named as --model takes them.  What is said without a "may" is known from this fit.
std::vector<std::string> next_steps(const FitOptions&, const FitDocument&, const FitFacts&);

}  // namespace gonio
