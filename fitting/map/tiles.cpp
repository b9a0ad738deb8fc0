#include "fitting/map/tiles.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "base/json/describe.h"
#include "base/numbers.h"
#include "base/text.h"
#include "brdf/model/own_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

namespace {

constexpr std::string_view kPrefix = "tile_", kSuffix = ".exr", kSchema = "gonio.map_tile/1";

std::string pair(std::size_t a, std::size_t b) {
  return fmt::format("{},{}", a, b);
}
std::array<std::size_t, 2> pair_in(const Image& header,
                                   const std::string& name,
                                   const std::string& path) {
  const std::string text = attribute_of(header, name, path, "a tile of gonio fit_map");
  const auto parts = split(text, ',');
  std::array<std::size_t, 2> numbers{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto n = parts.size() == 2 ? number_from<std::size_t>(parts[k]) : std::nullopt;
    if (!n || *n == 0 || *n > longest_side) throw bad_input(path, name, text, "two sizes");
    numbers[k] = *n;
  }
  return numbers;
}

}  // namespace

Rectangle TileGrid::place(const Tile& t) const {
  const std::size_t x = t.column * tile_width, y = t.row * tile_height;
  return {x, y, std::min(tile_width, width - x), std::min(tile_height, height - y)};
}

std::vector<Tile> TileGrid::all() const {
  std::vector<Tile> tiles;
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t column = 0; column < columns(); ++column) tiles.push_back({column, row});
  return tiles;
}

MapAttributes attributes_of(const StackReader& stack, const TexelOptions& options) {
  // A tile of a file's function belongs to the bytes that the file had.
  std::string shaders;
  for (const auto& f : own_files({options.model}))
    shaders += fmt::format("{}{} {}", shaders.empty() ? "" : ", ", f.file, f.sha256);
  return {{"gonio:version", GONIO_VERSION},
          {"gonio:model", options.model},
          {"gonio:options", json_line(options)},
          {"gonio:stack", stack.digest()},
          {"gonio:shaders", shaders.empty() ? "none" : shaders},
          {"gonio:channels", fmt::format("{}", fmt::join(stack.channels(), ","))}};
}

MapAttributes map_attributes(const Image& header, const std::string& path) {
  MapAttributes all;
  for (const char* name : {"gonio:version", "gonio:model", "gonio:options", "gonio:stack",
                           "gonio:shaders", "gonio:channels"})
    all[name] = attribute_of(header, name, path, "a tile of gonio fit_map");
  return all;
}

MapAttributes attributes_of(const MapAttributes& map, const TileGrid& grid, const Tile& tile) {
  MapAttributes all = map;
  all["gonio:schema"] = kSchema;
  all["gonio:size"] = pair(grid.width, grid.height);
  all["gonio:tile_size"] = pair(grid.tile_width, grid.tile_height);
  all["gonio:tile"] = pair(tile.column, tile.row);
  return all;
}

std::string file_name(const Tile& t) {
  return fmt::format("{}{}_{}{}", kPrefix, t.column, t.row, kSuffix);
}

std::optional<Tile> tile_of_name(const std::string& name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix) ||
      name.size() < kPrefix.size() + kSuffix.size())
    return std::nullopt;
  const auto parts = split(
      std::string_view(name).substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size()),
      '_');
  if (parts.size() != 2) return std::nullopt;
  const auto column = number_from<std::size_t>(parts[0]), row = number_from<std::size_t>(parts[1]);
  if (!column || !row || file_name({*column, *row}) != name) return std::nullopt;
  return Tile{*column, *row};
}

std::set<Tile> tiles_in(const std::string& folder, std::error_code& failed) {
  std::set<Tile> there;
  std::error_code unknown;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    if (const auto t = tile_of_name(entry.path().filename().string()); t && entry.exists(unknown))
      there.insert(*t);
  return there;
}

TileGrid grid_of(const Image& header, const std::string& path) {
  const auto size = pair_in(header, "gonio:size", path);
  const auto tile_size = pair_in(header, "gonio:tile_size", path);
  return {size[0], size[1], tile_size[0], tile_size[1]};
}

bool is_tile(const std::string& path) {
  try {
    const auto attributes = read_exr_header(path).attributes;
    const auto schema = attributes.find("gonio:schema");
    return schema != attributes.end() && schema->second == kSchema;
  } catch (const Error&) {
    return false;
  }
}

namespace {

/// Of a text what tells it from another: some of it, from shortly before they part.
std::string where_it_parts(const std::string& text, const std::string& other) {
  constexpr std::size_t before = 24, most = 72;
  const auto same = static_cast<std::size_t>(std::ranges::mismatch(text, other).in1 - text.begin());
  const std::size_t begin = beginning(text, same > before ? same - before : 0).size();
  const auto shown = beginning(std::string_view(text).substr(begin), most);
  return (begin > 0 ? "…" : "") + std::string(shown) +
         (begin + shown.size() < text.size() ? "…" : "");
}

}  // namespace

void expect_of(const MapAttributes& tile, const Image& header, const std::string& path) {
  for (const auto& [name, value] : tile) {
    const auto found = header.attributes.find(name);
    if (found == header.attributes.end()) throw bad_input(path, name, "none", value);
    if (found->second != value)
      throw bad_input(path, name, where_it_parts(found->second, value),
                      where_it_parts(value, found->second));
  }
}

MapPlanes::MapPlanes(const Rectangle& part,
                     const TexelFit& layout,
                     const std::vector<std::string>& channels)
    : part_(part) {
  const auto plane = [&](std::string name, Storage storage) -> Plane& {
    Plane& p = planes_.emplace_back();
    p.channel.name = std::move(name);
    p.channel.storage = storage;
    return p;
  };
  const auto numbers = [&](std::string name) {
    plane(std::move(name), Storage::single).numbers.resize(part.size());
  };
  const auto marks = [&](std::string name) {
    plane(std::move(name), Storage::half).marks.resize(part.size());
  };
  for (const auto& c : layout.columns) {
    const std::string colour = c.channel < 0 ? "" : channels[static_cast<std::size_t>(c.channel)];
    const std::string end = colour.empty() ? "" : "." + colour;
    numbers(c.parameter + end);
    numbers(c.parameter + ".std_error" + end);
    marks(c.parameter + ".status" + end);
  }
  if (!layout.normal.empty())
    for (const char* axis : {"X", "Y", "Z"}) numbers(fmt::format("normal.{}", axis));
  numbers("rms");
  numbers("misfit");
  marks("outcome");
}

std::size_t MapPlanes::bytes_of_texel() const {
  std::size_t bytes = 0;
  for (const auto& p : planes_)
    bytes += p.marks.empty() ? sizeof(p.numbers[0]) : sizeof(p.marks[0]);
  return bytes;
}

void MapPlanes::put(const TexelFit& fit, const Rectangle& of, std::size_t first) {
  std::size_t plane = 0;
  const std::size_t texels = fit.outcome.size();
  // do_run(texel of the fit, texel here, number) of each run of texels in one row
  const auto for_runs = [&](const auto& do_run) {
    for (std::size_t t = 0; t < texels;) {
      const std::size_t x = (first + t) % of.width, y = (first + t) / of.width;
      const std::size_t n = std::min(texels - t, of.width - x);
      do_run(t, (of.y + y - part_.y) * part_.width + (of.x + x - part_.x), n);
      t += n;
    }
  };
  const auto take = [&](const auto* from) {
    Plane& to = planes_[plane++];
    for_runs([&](std::size_t t, std::size_t at, std::size_t n) {
      if constexpr (std::is_same_v<decltype(from), const float*>)
        std::copy_n(from + t, n, to.numbers.data() + at);
      else
        std::copy_n(from + t, n, to.marks.data() + at);
    });
  };
  for (const auto& c : fit.columns) {
    take(c.value.data());
    take(c.std_error.data());
    take(c.status.data());
  }
  for (std::size_t k = 0; k * texels < fit.normal.size(); ++k) take(fit.normal.data() + k * texels);
  take(fit.rms.data());
  take(fit.misfit.data());
  take(fit.outcome.data());
}

std::vector<ExrChannel> MapPlanes::channels() const {
  std::vector<ExrChannel> all;
  for (const auto& p : planes_) all.push_back(p.channel);
  return all;
}

void MapPlanes::write(ExrWriter& to, const Rectangle& part) const {
  constexpr std::size_t at_once = 16;
  std::vector<std::vector<float>> rows(planes_.size());
  std::vector<const float*> planes;
  for (auto& r : rows) {
    r.resize(std::min(at_once, part.height) * part.width);
    planes.push_back(r.data());
  }
  for (std::size_t y = 0; y < part.height; y += at_once) {
    const std::size_t count = std::min(at_once, part.height - y);
    for (std::size_t k = 0; k < planes_.size(); ++k)
      for (std::size_t row = 0; row < count; ++row) {
        const std::size_t from = (part.y + y + row - part_.y) * part_.width + (part.x - part_.x);
        float* const out = rows[k].data() + row * part.width;
        if (planes_[k].marks.empty())
          std::copy_n(planes_[k].numbers.data() + from, part.width, out);
        else
          std::copy_n(planes_[k].marks.data() + from, part.width, out);
      }
    to.write(count, planes);
  }
}

}  // namespace gonio
