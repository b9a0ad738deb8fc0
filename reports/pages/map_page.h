#pragma once
/// \file
/// The page of a map: its parameters as pictures and as histograms, where the model fits, and what speaks against it.

#include <string>

#include "fitting/map/gather.h"

namespace gonio {

/// \param map  file that holds the map, which will lie at MapDocument::path.  Pictures have at most 96 × 96 cells, each the texel at its middle.
std::string map_page_html(const MapDocument&, const std::string& map);

}  // namespace gonio
