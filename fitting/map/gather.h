#pragma once
/// \file
/// Tiles of a folder joined into their map, and what the map says as a whole.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/file.h"
#include "fitting/map/arrangement.h"
#include "fitting/map/choose.h"
#include "fitting/map/tiles.h"

namespace gonio {

/// What the texels of a map have for a parameter; of one with channels for one of them.
struct MapParameter {
  std::string name;  ///< of the channel in the file
  std::uint64_t free = 0, fixed = 0, at_bound = 0, not_identifiable = 0;  ///< texels
  double mean = 0, mean_std_error = 0;  ///< of those that have one; NaN of none
};
struct MapDocument {
  std::string path, model, options, stack;  ///< stack: StackReader::digest()
  std::size_t width = 0, height = 0, tiles = 0;
  std::uint64_t converged = 0, not_converged = 0, no_data = 0;  ///< texels
  std::uint64_t judged = 0;                                     ///< texels whose noise is known
  std::uint64_t misfit = 0;  ///< of these, texels that are off by more than noise leaves
  double left_out = std::numeric_limits<double>::quiet_NaN();  ///< part of a sample's values; of
                                                               ///< tiles that were joined unknown
  double rms = 0;                       ///< of the metric's residuals, on average; NaN of none
  std::optional<AzimuthCheck> azimuth;  ///< of a survey; of tiles that were joined unknown
  std::vector<std::string> warnings;    ///< of a survey; of tiles that were joined none
  std::optional<std::vector<TriedModel>> models;  ///< that this one was chosen from, the best first
  std::vector<MapParameter> parameters;
};
/// Whether more of the judged texels are off than chance makes.
inline bool misfits(const MapDocument& d) {
  return 50 * d.misfit > d.judged;
}
/// "gonio.map/1"
std::string to_json(const MapDocument&);
std::string map_schema();

/// True of a folder that holds the file of a tile.
bool has_tiles(const std::string& folder);

/// Writes the map of a folder's tiles: the same bytes whatever the tiles' size and whoever fitted them.  One row of tiles is
/// read 64 rows of texels at a time.
/// \param threads  that pack
/// \throws Error  bad_input: tiles are missing, which are named; one is of another map, or cannot be read
MapDocument gather_tiles(const std::string& folder, OutputFile& out, int threads);

}  // namespace gonio
