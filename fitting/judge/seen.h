#pragma once
/// \file
/// Agreement of a fit with what the table shows without a model, as `gonio inspect` tells it.

#include "fitting/judge/uncertainty.h"
#include "fitting/solve/problem.h"
#include "table/table.h"

namespace gonio {

/// Takes values and intervals away that the table cannot mean:
///   all of a channel without a value that can be used;
///   all of a lobe, where each incident angle holds one constant;
///   its F0 or indices, where the larger highlight is at wo = wi: they would scale the other alone;
///   the width of a measured highlight that the samples do not resolve, which has an upper limit.
/// \param values  of all slots, fitted
void keep_to_what_is_seen(const Table&,
                          const Problem&,
                          std::span<const double> values,
                          Uncertainty&);

}  // namespace gonio
