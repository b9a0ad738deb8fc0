#pragma once
/// \file
/// Tiles of a map: where they lie, what their files are called, and what tells those of one map from all others.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "fitting/map/texels.h"
#include "image/exr_file.h"
#include "image/image_file.h"
#include "stack/stack_reader.h"

namespace gonio {

/// Tile by its column and row in the grid of tiles, from the left and from the top.
struct Tile {
  std::size_t column = 0, row = 0;
  auto operator<=>(const Tile&) const = default;
};

/// Map cut into tiles of one size; those on the right and at the bottom may be smaller.
struct TileGrid {
  std::size_t width = 0, height = 0;  ///< of the map
  std::size_t tile_width = 256, tile_height = 256;

  std::size_t columns() const { return (width + tile_width - 1) / tile_width; }
  std::size_t rows() const { return (height + tile_height - 1) / tile_height; }
  Rectangle place(const Tile&) const;
  std::vector<Tile> all() const;  ///< row by row
};

/// String attributes of a map, the same of all its tiles and wherever it is made: "gonio:version", "gonio:model", "gonio:options",
/// "gonio:stack" (StackReader::digest()) and "gonio:channels".
using MapAttributes = std::map<std::string, std::string>;
MapAttributes attributes_of(const StackReader&, const TexelOptions&);
/// The same of a tile's file.
MapAttributes map_attributes(const Image& header, const std::string& path);

/// Attributes of a tile's file: those of the map and the tile's place.
MapAttributes attributes_of(const MapAttributes& map, const TileGrid&, const Tile&);
/// "tile_COLUMN_ROW.exr", and back; no value of any other name
std::string file_name(const Tile&);
std::optional<Tile> tile_of_name(const std::string& file_name);
/// Tiles whose files lie in a folder, by their names alone; a link that leads nowhere is none.
/// \param failed  why the folder cannot be read
std::set<Tile> tiles_in(const std::string& folder, std::error_code& failed);
/// Grid that a tile's file says that it is of.
TileGrid grid_of(const Image& header, const std::string& path);
/// True of a tile's file, of whichever map.
bool is_tile(const std::string& path);
/// Refuses a tile of another stack, of other options, another version or another grid.
/// \param header  of its file, without planes
void expect_of(const MapAttributes& tile, const Image& header, const std::string& path);

/// Results of the texels of a part of a map, as the planes of its file.
class MapPlanes {
 public:
  /// \param layout    any fit of those options
  /// \param channels  of the stack
  MapPlanes(const Rectangle& part,
            const TexelFit& layout,
            const std::vector<std::string>& channels);

  /// Bytes that a texel takes.
  std::size_t bytes_of_texel() const;
  /// Takes texels' results over; from any thread, each texel once.
  /// \param of     part that the texels are of, within this one
  /// \param first  the first texel's number in that part, row by row
  void put(const TexelFit&, const Rectangle& of, std::size_t first);

  /// Channels of files: PARAMETER, PARAMETER.std_error and PARAMETER.status with the colour last (kd.status.R); normal.X, .Y, .Z
  /// where they are refined; rms, misfit, outcome.
  std::vector<ExrChannel> channels() const;
  /// All rows of a part within this one.
  void write(ExrWriter&, const Rectangle& part) const;

 private:
  struct Plane {
    ExrChannel channel;
    std::vector<float> numbers;
    std::vector<std::uint8_t> marks;  ///< in place of numbers: a status or an outcome
  };
  Rectangle part_;
  std::vector<Plane> planes_;  ///< three of each column, then those of the texel itself
};

}  // namespace gonio
