#pragma once
/// \file
/// Zenith angles that are counted from the surface.

#include <string>
#include <vector>

#include "table/health/facts.h"

namespace gonio {

/// Says that angles are elevations: these put highlights elsewhere, or let them fall towards grazing.
bool warn_of_elevation(TableFacts&, std::vector<std::string>& all);

}  // namespace gonio
