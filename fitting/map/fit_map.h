#pragma once
/// \file
/// Fits of the tiles of a map, each into a file of its own in a folder, and the document that names them.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fitting/map/texels.h"
#include "fitting/map/tiles.h"
#include "stack/stack_reader.h"

namespace gonio {

/// What a run that was asked for some tiles has made.
struct TilesDocument {
  std::vector<std::string> tiles;     ///< paths of those that were asked for
  std::size_t kept = 0;               ///< of these there from before
  std::size_t columns = 0, rows = 0;  ///< of all tiles of the map
};
/// "gonio.map_tiles/1"
std::string to_json(const TilesDocument&);
std::string map_tiles_schema();

/// State of a map while it is being fitted.
struct MapCount {
  std::size_t tiles = 0, kept = 0;   ///< asked for; of these there from before
  std::size_t texels = 0, done = 0;  ///< of the tiles that are not kept
};

/// Removes tiles of any other map from a folder: those that a run left which ended early.  None goes where one is an input, or
/// where a file of a tile's name is none that gonio made.
void remove_other_tiles(const StackReader&,
                        const TexelOptions&,
                        const TileGrid&,
                        const std::string& folder);

/// Fits tiles of a stack into a folder, which is made where it is missing; one that is there already, of the same stack, options, version and
/// grid, is kept.  A tile is the same to the bit whatever the threads, the other tiles and the runs that were killed before; so are its
/// texels whatever the grid.  Memory: that of results, and 128 MB of samples, whatever the tiles' size.
///
/// \param tiles     of the grid
/// \param progress  called by one thread at a time
/// \param noise     of a survey of the whole stack, by which texels are judged; none: their misfit is not known
/// \param most_results  memory of results that wait to be written [bytes]: tiles that need more are written strip by strip
/// \throws Error  bad_input for a tile in the folder that is of anything else: it is not overwritten
MapCount fit_tiles(const StackReader&,
                   const TexelOptions&,
                   const TileGrid&,
                   std::span<const Tile> tiles,
                   const std::string& folder,
                   const std::function<void(const MapCount&)>& progress = {},
                   const TexelNoise& noise = {},
                   std::size_t most_results = std::size_t{1} << 28);

}  // namespace gonio
