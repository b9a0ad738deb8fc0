#pragma once
/// \file
/// Maps as commands tell of them, and the joining of tiles for `gonio gather`.

#include <string>

#include "cli/line/command.h"
#include "fitting/map/gather.h"

namespace gonio::cli {

/// The map's document on standard output for --json, else for a person.  \param beside  further words, or ""
void print_map(const MapDocument&, const Common&, const std::string& beside);
/// not_converged where no texel did, else done.
Exit outcome_of(const MapDocument&);

/// What `gonio gather DIR -o maps.exr` does where has_tiles(DIR): joins the tiles.
Exit gather_map(const std::string& folder, const std::string& output, const Common&);

}  // namespace gonio::cli
