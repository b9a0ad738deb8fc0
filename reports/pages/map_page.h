#pragma once
/// \file
/// The page of a map: its parameters as pictures and as histograms, where the model fits, and what speaks against it.

#include <string>

#include "fitting/map/gather.h"

namespace gonio {

/// HTML of a map that lies at MapDocument::path.  Pictures have at most 96 × 96 cells, each the texel at its middle.
std::string map_page_html(const MapDocument&);

}  // namespace gonio
