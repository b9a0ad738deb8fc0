#include "fitting/map/gather.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/json/describe.h"
#include "brdf/model/own_files.h"
#include "image/exr_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {

template <>
inline constexpr auto description<MapParameter> = FieldList{
    Field{"name", &MapParameter::name, "of the channel in the file"},
    Group{"texels", "how many have which status", Field{"free", &MapParameter::free, "found"},
          Field{"fixed", &MapParameter::fixed, "held"},
          Field{"at_bound", &MapParameter::at_bound, "at the end of its range"},
          Field{"not_identifiable", &MapParameter::not_identifiable, "not known"}},
    Field{"mean", &MapParameter::mean, "of the texels that have a value"},
    Field{"mean_std_error", &MapParameter::mean_std_error, "of the texels that have one"}};
template <>
inline constexpr auto description<TriedModel> =
    FieldList{Field{"model", &TriedModel::model, ""},
              Field{"unseen_rms", &TriedModel::unseen_rms,
                    "median over a sample's texels, in the metric's unit"}};
template <>
inline constexpr auto description<MapDocument> = FieldList{
    constant_text("schema", "gonio.map/1"),
    Field{"path", &MapDocument::path, "of the map"},
    Field{"model", &MapDocument::model, ""},
    Field{"options", [](const MapDocument& d) { return Json::parse(d.options); },
          "what is fitted and how values are compared"},
    Field{"stack", &MapDocument::stack, "name of the stack: a digest of its files"},
    Field{"width", "texels", &MapDocument::width, ""},
    Field{"height", "texels", &MapDocument::height, ""},
    Field{"tiles", &MapDocument::tiles, "that it was made of"},
    Group{
        "texels", "how their fits ended", Field{"converged", &MapDocument::converged, ""},
        Field{"not_converged", &MapDocument::not_converged, "the best seen is kept"},
        Field{"no_data", &MapDocument::no_data, "no value that can be compared"},
        Field{"judged", &MapDocument::judged, "whose noise is known"},
        Field{"misfit", &MapDocument::misfit, "off by more than noise leaves, however they ended"}},
    Field{"left_out", &MapDocument::left_out,
          "part of a sample's values that is not compared: no number, below 0, clipped or dark"},
    Field{"rms", &MapDocument::rms, "of the metric's residuals, on average over the texels"},
    Field{"azimuth", &MapDocument::azimuth,
          "whether the azimuths of the lights were checked, by a sample of the texels"},
    Field{"warnings", &MapDocument::warnings,
          "what a sample of the texels says of the stack and the model"},
    Field{"models", if_there(&MapDocument::models),
          "that this one was chosen from, by images that their fits have not seen; the best first"},
    Field{"parameters", &MapDocument::parameters, "by their names"},
    Field{own_files_key, if_there([](const MapDocument& d) { return own_files({d.model}); }),
          own_files_meaning}};

std::string to_json(const MapDocument& d) {
  return json_text(d);
}
std::string map_schema() {
  return schema_text<MapDocument>("Map of a stack");
}

namespace {

namespace fs = std::filesystem;

struct Tiles {
  TileGrid grid;
  Image header;  ///< of the first
  MapAttributes map;
  std::vector<std::string> paths;  ///< row by row
};

/// Tiles of a folder, all there and of one map.
Tiles sound_tiles(const std::string& folder) {
  std::error_code failed;
  const auto there = tiles_in(folder, failed);
  if (failed) throw bad_input(folder, "opening", failed.message(), "a folder of tiles");
  if (there.empty())
    throw bad_input(folder, "tiles", "none", "files tile_COLUMN_ROW.exr of gonio fit_map --tile");
  const auto path_of = [&](const Tile& t) { return (fs::path(folder) / file_name(t)).string(); };
  Tiles all;
  const std::string first = path_of(*there.begin());
  all.header = read_exr_header(first);
  all.grid = grid_of(all.header, first);
  all.map = map_attributes(all.header, first);

  // Without a list of the grid's tiles: a file that lies may name billions.
  const TileGrid& grid = all.grid;
  const std::size_t wanted = grid.columns() * grid.rows();
  const auto of_grid = static_cast<std::size_t>(std::ranges::count_if(
      there, [&](const Tile& t) { return t.column < grid.columns() && t.row < grid.rows(); }));
  constexpr std::size_t named = 8;
  std::string missing;
  const std::size_t count = wanted - of_grid;
  for (std::size_t k = 0, told = 0; told < std::min(count, named); ++k) {
    const Tile t{k % grid.columns(), k / grid.columns()};
    if (there.contains(t)) continue;
    missing += fmt::format("{}{},{}", told == 0 ? "" : " ", t.column, t.row);
    ++told;
  }
  if (count > 0)
    throw bad_input(
        folder, "tiles",
        fmt::format("{} of {}, without {}{}", of_grid, wanted, missing, count > named ? " …" : ""),
        "all of them");
  for (const Tile& t : there) {
    const std::string path = path_of(t);
    const Image header = read_exr_header(path);
    expect_of(attributes_of(all.map, grid, t), header, path);
    if (t.column >= grid.columns() || t.row >= grid.rows())
      throw bad_input(path, "name", "a tile beyond the map", "one of its grid");
    const Rectangle place = grid.place(t);
    if (header.width != place.width || header.height != place.height ||
        header.channels != all.header.channels)
      throw bad_input(
          path, "header",
          fmt::format("{} × {}, {} channels", header.width, header.height, header.channels.size()),
          fmt::format("{} × {}, {} channels", place.width, place.height,
                      all.header.channels.size()));
  }
  for (const Tile& t : grid.all()) all.paths.push_back(path_of(t));
  return all;
}

/// Counts and sums of a parameter, rows one after the other.
class Sums {
 public:
  /// Of the channel that holds a parameter's status; false of any other.
  static bool is_status(const std::string& channel) {
    return channel.ends_with(kStatus) || channel.find(kStatus + ".") != channel.npos;
  }
  Sums(const std::vector<std::string>& channels, const std::string& status) {
    const auto at = status.rfind(kStatus);
    const auto named = [&](const std::string& part) {
      return status.substr(0, at) + part + status.substr(at + kStatus.size());
    };
    const auto index = [&](const std::string& name) {
      return static_cast<std::size_t>(std::ranges::find(channels, name) - channels.begin());
    };
    sums_.name = named("");
    status_ = index(status);
    value_ = index(sums_.name);
    error_ = index(named(".std_error"));
    whole_ = std::max({status_, value_, error_}) < channels.size();
  }
  bool whole() const { return whole_; }

  void add(const std::vector<std::vector<float>>& planes, std::size_t texels) {
    for (std::size_t t = 0; t < texels; ++t) {
      const float status = planes[status_][t];
      sums_.free += is(status, ParameterStatus::free);
      sums_.fixed += is(status, ParameterStatus::fixed);
      sums_.at_bound += is(status, ParameterStatus::at_bound);
      sums_.not_identifiable += is(status, ParameterStatus::not_identifiable);
      const auto sum = [&](double& total, std::uint64_t& count, float v) {
        if (std::isnan(v)) return;
        total += static_cast<double>(v);
        ++count;
      };
      sum(sums_.mean, values_, planes[value_][t]);
      sum(sums_.mean_std_error, errors_, planes[error_][t]);
    }
  }
  MapParameter result() const {
    MapParameter p = sums_;
    p.mean /= static_cast<double>(values_);  // NaN of none
    p.mean_std_error /= static_cast<double>(errors_);
    return p;
  }

 private:
  static inline const std::string kStatus = ".status";
  static bool is(float status, ParameterStatus s) {
    return status == static_cast<float>(static_cast<int>(s));
  }
  MapParameter sums_;
  std::size_t status_ = 0, value_ = 0, error_ = 0;
  std::uint64_t values_ = 0, errors_ = 0;
  bool whole_ = false;
};

/// A parameter's name without its channel, and the channel's place among red, green and blue.
std::pair<std::string, std::size_t> as_told(const MapParameter& p) {
  const std::size_t end = p.name.size();
  if (end > 2 && p.name[end - 2] == '.')
    if (const auto place = std::string_view("RGB").find(p.name[end - 1]); place < 3)
      return {p.name.substr(0, end - 2), place};
  return {p.name, 0};
}

}  // namespace

bool has_tiles(const std::string& folder) {
  std::error_code none;
  return !tiles_in(folder, none).empty();
}

MapDocument gather_tiles(const std::string& folder, OutputFile& out, int threads) {
  const Tiles tiles = sound_tiles(folder);
  const TileGrid& grid = tiles.grid;
  const auto& names = tiles.header.channels;
  MapDocument d;
  d.path = out.path();
  d.model = tiles.map.at("gonio:model");
  d.options = tiles.map.at("gonio:options");
  d.stack = tiles.map.at("gonio:stack");
  d.width = grid.width;
  d.height = grid.height;
  d.tiles = tiles.paths.size();

  std::vector<ExrChannel> channels;
  std::vector<Sums> sums;
  std::vector<std::size_t> every;
  for (const auto& name : names) {
    const bool is_mark = Sums::is_status(name) || name == "outcome";
    every.push_back(channels.size());
    channels.push_back({name, is_mark ? Storage::half : Storage::single});
    if (Sums::is_status(name)) sums.emplace_back(names, name);
  }
  const auto place_of = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const auto outcome = place_of("outcome"), rms = place_of("rms"), misfit = place_of("misfit");
  double sum_of_rms = 0;
  if (std::max({outcome, rms, misfit}) == names.size() || !std::ranges::all_of(sums, &Sums::whole))
    throw bad_input(tiles.paths[0], "channels", fmt::format("{}", fmt::join(names, ", ")),
                    "those of a tile of gonio fit_map");

  MapAttributes attributes = tiles.map;
  attributes["gonio:schema"] = "gonio.map/1";
  ExrWriter writer(out, grid.width, grid.height, channels, attributes, ExrWriter::Packing::runs,
                   threads);
  // Of a stranger's tiles with thousands of channels fewer rows.
  constexpr std::size_t most_rows = 64, most_numbers = std::size_t{1} << 25;
  const std::size_t at_once =
      std::clamp(most_numbers / (names.size() * grid.width), std::size_t{1}, most_rows);
  std::vector<std::vector<float>> rows(names.size());
  std::vector<float> part;
  std::vector<float*> into(names.size());
  std::vector<const float*> planes(names.size());
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    const std::size_t height = grid.place({0, row}).height;
    for (std::size_t y = 0; y < height; y += at_once) {
      const std::size_t count = std::min(at_once, height - y);
      for (std::size_t c = 0; c < names.size(); ++c) {
        rows[c].resize(count * grid.width);
        planes[c] = rows[c].data();
      }
      for (std::size_t column = 0; column < grid.columns(); ++column) {
        const Rectangle place = grid.place({column, row});
        part.resize(names.size() * count * place.width);
        for (std::size_t c = 0; c < names.size(); ++c)
          into[c] = part.data() + c * count * place.width;
        open_exr(tiles.paths[row * grid.columns() + column])
            ->read({0, y, place.width, count}, every, into);
        for (std::size_t c = 0; c < names.size(); ++c)
          for (std::size_t k = 0; k < count; ++k)
            std::copy_n(into[c] + k * place.width, place.width,
                        rows[c].data() + k * grid.width + place.x);
      }
      const std::size_t texels = count * grid.width;
      for (auto& s : sums) s.add(rows, texels);
      const auto ended = [&](TexelOutcome how) {
        const auto last = rows[outcome].begin() + static_cast<std::ptrdiff_t>(texels);
        return static_cast<std::uint64_t>(
            std::count(rows[outcome].begin(), last, static_cast<float>(static_cast<int>(how))));
      };
      d.converged += ended(TexelOutcome::converged);
      d.not_converged += ended(TexelOutcome::not_converged);
      d.no_data += ended(TexelOutcome::no_data);
      for (std::size_t t = 0; t < texels; ++t) {
        if (!std::isnan(rows[rms][t])) sum_of_rms += double{rows[rms][t]};
        d.judged += rows[misfit][t] >= 0;
        d.misfit += rows[misfit][t] > 1;
      }
      writer.write(count, planes);
    }
  }
  writer.finish();
  d.rms = sum_of_rms / static_cast<double>(d.converged + d.not_converged);  // NaN of none
  for (const auto& s : sums) d.parameters.push_back(s.result());
  std::ranges::stable_sort(d.parameters, {}, as_told);  // a file has its channels by the alphabet
  return d;
}

}  // namespace gonio
