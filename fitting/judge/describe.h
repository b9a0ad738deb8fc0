#pragma once
/// \file
/// Parameters of a fit as its document shows them.

#include "fitting/judge/uncertainty.h"
#include "fitting/result/document.h"
#include "fitting/solve/problem.h"

namespace gonio {

/// Name of a parameter's value of a channel: "f0.r", or of one for all channels the parameter's.
std::string name_of(const ModelParameter&,
                    std::size_t channel,
                    const std::vector<std::string>& channels);

/// One document entry per parameter, alpha followed by roughness, and how they depend on each other.
/// \param values  of all slots, fitted
void describe(FitDocument&, const Problem&, std::span<const double> values, const Uncertainty&);

}  // namespace gonio
