#pragma once
/// \file
/// Agreement of a fit with what the table shows without a model, as `gonio inspect` tells it.

#include "fitting/judge/uncertainty.h"
#include "fitting/solve/problem.h"
#include "table/health/facts.h"

namespace gonio {

/// Why nothing is known of a channel that is dark.
inline constexpr const char* no_value_of_channel = "no value of its channel can be used";

/// Takes values and intervals away that the table cannot mean:
///   all of a channel without a value that can be used;
///   all of a lobe, where each incident angle holds one constant;
///   its F0 or indices, where the larger highlight is at wo = wi and the model misses it: they would scale
///   the other alone;
///   the width of a measured highlight that the samples do not resolve, which has an upper limit;
///   a width at the low end of all there are.
/// \param values  of all slots, fitted   \param misfit  of these
void keep_to_what_is_seen(TableFacts&,
                          const Problem&,
                          std::span<const double> values,
                          const Misfit& misfit,
                          Uncertainty&);

}  // namespace gonio
