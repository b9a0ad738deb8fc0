#include "fitting/map/fit_map.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include "base/earlier_file.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "fitting/map/survey.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace gonio {

template <>
inline constexpr auto description<TilesDocument> =
    FieldList{constant_text("schema", "gonio.map_tiles/1"),
              Field{"tiles", &TilesDocument::tiles, "paths of the tiles that were asked for"},
              Field{"kept", &TilesDocument::kept, "how many of them were there from before"},
              Field{"columns", &TilesDocument::columns, "of all tiles of the map"},
              Field{"rows", &TilesDocument::rows, "of all tiles of the map"}};
static_assert(describes_every_member<TilesDocument>());

std::string to_json(const TilesDocument& d) {
  return json_text(d);
}
std::string map_tiles_schema() {
  return schema_text<TilesDocument>("Tiles of a map");
}

namespace {

namespace fs = std::filesystem;

/// Fit of a texel without values: which columns there are.
TexelFit layout_of(const TexelOptions& options, std::size_t channels) {
  const std::vector<float> values(channels, std::numeric_limits<float>::quiet_NaN());
  const std::array<float, 3> z{0, 0, 1};
  return fit_texels({1, 1, channels, values, true, z, z, {}}, options);
}

/// Parts of a place that are read one after the other, each of at most so many bytes where what is stored as one
/// allows it.
std::vector<Rectangle> parts_of(const Rectangle& place, const StackReader& stack) {
  constexpr std::size_t most_bytes = std::size_t{1} << 26;
  const std::size_t most = std::max<std::size_t>(most_bytes / stack.bytes_of_texel(), 1);
  std::size_t width = place.width, height = std::min(stack.block_height(), place.height);
  if (width * height > most && stack.block_width() < stack.width())  // tiles: whole ones
    width = std::clamp(most / height / stack.block_width() * stack.block_width(),
                       std::min(stack.block_width(), place.width), place.width);
  if (width * height > most) height = std::max<std::size_t>(most / width, 1);
  if (width * height > most) width = std::max<std::size_t>(most / height, 1);
  if (width == place.width)
    height = std::min(place.height, std::max(height, most / width / height * height));
  std::vector<Rectangle> parts;
  for (std::size_t y = 0; y < place.height; y += height)
    for (std::size_t x = 0; x < place.width; x += width)
      parts.push_back({place.x + x, place.y + y, std::min(width, place.width - x),
                       std::min(height, place.height - y)});
  return parts;
}

/// Tiles of a row with what lies between them.
Rectangle place_of(std::span<const Tile> of_row, const TileGrid& grid) {
  Rectangle place = grid.place(of_row.front());
  for (const Tile& t : of_row) {
    const Rectangle p = grid.place(t);
    const std::size_t end = std::max(place.x + place.width, p.x + p.width);
    place.x = std::min(place.x, p.x);
    place.width = end - place.x;
  }
  return place;
}

/// Tiles of a row in groups that are fitted together: all of them where their results have room, for of images in scan lines a group
/// costs the reading of whole rows; else so many that their files may all be open.
std::vector<std::span<const Tile>> fitted_together(std::span<const Tile> of_row,
                                                   const TileGrid& grid,
                                                   std::size_t most_texels) {
  constexpr std::size_t most_open = 64;
  if (place_of(of_row, grid).size() <= most_texels) return {of_row};
  std::vector<std::span<const Tile>> groups;
  for (std::size_t k = 0; k < of_row.size(); k += most_open)
    groups.push_back(of_row.subspan(k, std::min(most_open, of_row.size() - k)));
  return groups;
}

/// Rows of a place whose results have room, of whole blocks where these are no higher.
std::vector<Rectangle> strips_of(const Rectangle& place,
                                 const StackReader& stack,
                                 std::size_t most_texels) {
  const std::size_t height = whole_blocks(most_texels / place.width, stack.block_height());
  std::vector<Rectangle> strips;
  for (std::size_t y = 0; y < place.height; y += height)
    strips.push_back({place.x, place.y + y, place.width, std::min(height, place.height - y)});
  return strips;
}

/// Tile that is being written, strip by strip.
struct TileFile {
  OutputFile out;
  ExrWriter writer;
  TileFile(const std::string& path,
           const Rectangle& place,
           std::vector<ExrChannel> channels,
           const MapAttributes& attributes)
      : out(path, NamedBy::gonio),
        writer(out,
               place.width,
               place.height,
               std::move(channels),
               attributes,
               ExrWriter::Packing::none) {}
};

/// Tiles to be fitted, by their rows; those that are there are looked at.
std::map<std::size_t, std::vector<Tile>> missing_of(std::span<const Tile> tiles,
                                                    const MapAttributes& map,
                                                    const TileGrid& grid,
                                                    const fs::path& folder,
                                                    MapCount& count) {
  std::map<std::size_t, std::vector<Tile>> missing;
  for (const Tile& t : tiles) {
    const std::string path = (folder / file_name(t)).string();
    std::error_code unknown;
    if (fs::exists(path, unknown)) {
      expect_of(attributes_of(map, grid, t), read_exr_header(path), path);
      ++count.kept;
    } else {
      missing[t.row].push_back(t);
      count.texels += grid.place(t).size();
    }
  }
  return missing;
}

/// Refuses a folder that holds a tile of another map, before work is put beside it.
void expect_no_other(const MapAttributes& map, const TileGrid& grid, const fs::path& folder) {
  std::error_code none;
  const auto there = tiles_in(folder.string(), none);
  if (there.empty()) return;
  const Tile first = *there.begin();
  const std::string path = (folder / file_name(first)).string();
  expect_of(attributes_of(map, grid, first), read_exr_header(path), path);
}

}  // namespace

void remove_other_tiles(const StackReader& stack,
                        const TexelOptions& options,
                        const TileGrid& grid,
                        const std::string& folder) {
  const MapAttributes map = attributes_of(stack, options);
  std::error_code none;
  const auto there = tiles_in(folder, none);
  const auto path_of = [&](const Tile& t) { return (fs::path(folder) / file_name(t)).string(); };
  std::vector<std::string> others;
  for (const Tile& t : there) {  // before anything goes
    const std::string path = path_of(t);
    expect_no_input(path, NamedBy::gonio);
    may_replace(path);
    if (!is_tile(path))
      throw bad_input(path, "header", "no tile of a map",
                      "only tiles of gonio fit_map in this folder (move that file)");
    try {
      expect_of(attributes_of(map, grid, t), read_exr_header(path), path);
    } catch (const Error&) {
      others.push_back(path);
    }
  }
  for (const auto& path : others) remove_unless_input(path);
}

MapCount fit_tiles(const StackReader& stack,
                   const TexelOptions& options,
                   const TileGrid& grid,
                   std::span<const Tile> tiles,
                   const std::string& folder,
                   const std::function<void(const MapCount&)>& progress,
                   const TexelNoise& noise,
                   std::size_t most_results) {
  check(options, stack.channels().size());
  const TexelFit layout = layout_of(options, stack.channels().size());
  const MapAttributes map = attributes_of(stack, options);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed && !fs::is_directory(folder))
    throw bad_input(folder, "writing", failed.message(), "a folder that can be written");
  expect_no_other(map, grid, folder);

  MapCount count;
  count.tiles = tiles.size();
  const auto missing = missing_of(tiles, map, grid, folder, count);
  if (progress) progress(count);
  std::mutex one_at_a_time;
  const auto fit_part = [&](const StackPart& samples, const Rectangle& part, MapPlanes& to) {
    tbb::parallel_for(std::size_t{0}, samples.pieces(), [&](std::size_t k) {
      const auto p = samples.piece(k);
      TexelFit fit = fit_texels({p.texels, samples.images, samples.channels, p.values,
                                 samples.shared, p.light, p.view, p.normal},
                                options);
      fit.misfit = misfit_of(fit, noise);
      to.put(fit, part, p.first);
      if (!progress) return;
      const std::lock_guard lock(one_at_a_time);
      count.done = std::min(count.texels, count.done + p.texels);
      progress(count);
    });
  };

  const MapPlanes of_one({0, 0, 1, 1}, layout, stack.channels());
  const std::size_t most_texels = most_results / of_one.bytes_of_texel();
  for (const auto& [row, of_row] : missing)
    for (const auto& some : fitted_together(of_row, grid, most_texels)) {
      const Rectangle place = place_of(some, grid);
      std::vector<std::unique_ptr<TileFile>> files(some.size());
      for (const Rectangle& strip : strips_of(place, stack, most_texels)) {
        MapPlanes planes(strip, layout, stack.channels());
        const auto parts = parts_of(strip, stack);
        // The next part is read while this one is fitted.
        std::array<StackPart, 2> samples;
        stack.read(parts[0], samples[0]);
        for (std::size_t k = 0; k < parts.size(); ++k)
          tbb::parallel_invoke(
              [&] {
                if (k + 1 < parts.size()) stack.read(parts[k + 1], samples[(k + 1) % 2]);
              },
              [&] { fit_part(samples[k % 2], parts[k], planes); });
        tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t k) {
          const Tile& tile = some[k];
          const Rectangle p = grid.place(tile);
          if (!files[k])
            files[k] =
                std::make_unique<TileFile>((fs::path(folder) / file_name(tile)).string(), p,
                                           planes.channels(), attributes_of(map, grid, tile));
          planes.write(files[k]->writer, {p.x, strip.y, p.width, strip.height});
          if (strip.y + strip.height < p.y + p.height) return;
          files[k]->writer.finish();
          files[k]->out.commit();
          files[k].reset();
        });
      }
    }
  return count;
}

}  // namespace gonio
