#pragma once
/// \file
/// Changes of a fit if the samples sat at the other place in their bins.

#include <optional>

#include "fitting/result/document.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

/// Changes between two fits that differ in the bin convention alone, on thinned tables: a ratio needs no
/// million bins.  None where one of them did not converge.
/// \param scanned    thinned, in the convention of the fit
/// \param in_use     the table in the convention of the fit   \param elsewhere  the table in the convention `other`
std::optional<BinSensitivity> bin_sensitivity(const Problem&,
                                              const FitData<double>& scanned,
                                              const Sampling& in_use,
                                              const Sampling& elsewhere,
                                              Bins other,
                                              const Fitted&);

}  // namespace gonio
