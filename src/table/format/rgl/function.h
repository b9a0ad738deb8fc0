#pragma once
/// \file
/// An RGL file's function as it stands, for integrals.

#include "table/table.h"

namespace gonio {

using RglFunction = std::function<double(const DirectionPair&, std::size_t channel)>;

/// The format's own evaluation, anywhere above the horizon; empty for tables of other formats.  It
/// grows without bound towards the horizon, where what is interpolated does not vanish with the
/// cosine that it is divided by: fit for integrals over the cosine alone.  Table::between is the same,
/// but from θ_o = 70° on, or where one of the grid points around is not valid, within the span of the
/// valid ones, and NaN where these carry half of the weight or less, below least_cosine, and beyond
/// the last θ_i.
RglFunction rgl_function(const Table&);

}  // namespace gonio
