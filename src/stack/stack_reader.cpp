#include "stack/stack_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "base/quantile.h"
#include "base/sha256.h"
#include "base/whole_loop.h"
#include "table/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::array<float, 3> floats(const Direction& d) {
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

/// Indices of channels by their names.
std::vector<std::size_t> channels_among(const ImageFile& file,
                                        const std::vector<std::string>& names) {
  std::vector<std::size_t> indices;
  for (const auto& name : names) {
    const auto at = std::ranges::find(file.channels(), name);
    if (at == file.channels().end()) return {};
    indices.push_back(static_cast<std::size_t>(at - file.channels().begin()));
  }
  return indices;
}
[[noreturn]] void refuse_channels(const ImageFile& file, const std::string& expected) {
  throw bad_input(file.path(), "channels", fmt::format("{}", fmt::join(file.channels(), ", ")),
                  expected);
}

const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};

}  // namespace

StackPart::Piece StackPart::piece(std::size_t k) const {
  Piece p;
  p.first = k * piece_texels;
  p.texels = std::min(piece_texels, texels - p.first);
  const auto part = [&](const Floats& all, std::size_t each) {
    return all.empty() ? std::span<const float>()
                       : std::span<const float>(all).subspan(p.first * each, p.texels * each);
  };
  p.values = part(values, images * channels);
  p.light = shared ? std::span<const float>(light) : part(light, images * 3);
  p.view = shared ? std::span<const float>(view) : part(view, images * 3);
  p.normal = part(normal, 3);
  return p;
}

void expect_size_of(const std::string& first,
                    std::size_t width,
                    std::size_t height,
                    const ImageFile& file) {
  if (file.width() != width || file.height() != height)
    throw bad_input(file.path(), "size", fmt::format("{} × {}", file.width(), file.height()),
                    fmt::format("{} × {} as {}", width, height, first));
}

std::unique_ptr<ImageFile> StackReader::open(const std::string& path) {
  auto file = open_image(path, stack_.linear);
  if (width_ == 0) {
    width_ = file->width();
    height_ = file->height();
  }
  expect_size_of(first_, width_, height_, *file);
  // Of files in scan lines a part costs all columns.
  block_width_ = std::max(block_width_, file->block_width());
  block_height_ = std::max(block_height_, file->block_height());
  return file;
}

std::size_t StackReader::vectors(const std::string& name) {
  const std::string path = stack_.path_of(name);
  const auto [number, is_new] = map_number_.try_emplace(path, maps_.size());
  if (!is_new) return number->second;
  const auto stamp = InputFile(path).stamp();
  auto file = open(path);
  if (file->in_unit_range())
    throw bad_input(path, "header", "whole numbers, which are not below 0",
                    "an image of vectors in OpenEXR or TIFF's floats, or an array of NumPy's");
  auto channels = channels_among(*file, xyz);
  if (channels.empty()) channels = channels_among(*file, rgb);
  if (channels.empty()) refuse_channels(*file, "X, Y and Z, or R, G and B");
  const std::size_t numbers = file->channels().size();
  maps_.push_back({path, channels, nullptr, stamp, numbers});
  keep(maps_.back(), std::move(file));
  return maps_.size() - 1;
}

namespace {

/// Bytes that files may hold which stay open, and once more those that are opened anew for a part.
constexpr std::size_t most_held = std::size_t{1} << 28;

}  // namespace

void StackReader::keep(Source& source, std::unique_ptr<ImageFile> file) {
  constexpr std::size_t most_files = 512;  // a PNG that is opened again is read from its top
  source.held = file->held();
  if (kept_ == most_files || source.held > most_held - kept_bytes_) return;
  ++kept_;
  kept_bytes_ += source.held;
  source.file = std::move(file);
}

StackReader::Source StackReader::source_of(const std::string& name) {
  const std::string path = stack_.path_of(name);
  Source source{path, {}, nullptr, InputFile(path).stamp()};
  auto file = open(path);
  source.numbers = file->channels().size();
  const bool first = channels_.empty();
  if (first)
    channels_ = stack_.channels.value_or(file->channels().size() == 1 ? file->channels() : rgb);
  const bool only = channels_.size() == 1 && file->channels().size() == 1 && !stack_.channels;
  source.channels = only ? std::vector<std::size_t>{0} : channels_among(*file, channels_);
  if (source.channels.empty())
    refuse_channels(*file, stack_.channels || !first
                               ? fmt::format("{} among them", fmt::join(channels_, ", "))
                               : "one, or R, G and B; or \"channels\" in the stack");
  keep(source, std::move(file));
  return source;
}

StackReader::StackReader(Stack stack, WithoutName)
    : stack_(std::move(stack)), opening_(std::make_unique<MemoryBudget>(most_held)) {
  first_ = stack_.path_of(stack_.images[0].path);
  for (const StackImage& image : stack_.images) {
    images_.push_back(source_of(image.path));
    const auto map_of = [&](const auto& towards) {
      if (const auto* map = std::get_if<2>(&towards)) return vectors(map->path);
      const auto* near = std::get_if<3>(&towards);
      if (!near) return none;
      is_near_ = true;
      maps_.push_back({stack_.path, {}, nullptr, {}, 0, 0, near->at});
      return maps_.size() - 1;
    };
    light_maps_.push_back(map_of(image.light));
    view_maps_.push_back(map_of(image.view));
    shared_ = shared_ && light_maps_.back() == none && view_maps_.back() == none;
  }
  if (stack_.dark) dark_ = source_of(*stack_.dark);
  if (stack_.flat) flat_ = source_of(*stack_.flat);
  expect_photographs();
  if (flat_) {
    const auto tenth = [](std::size_t n) { return std::max<std::size_t>(1, n / 10); };
    const Rectangle part{(width_ - tenth(width_)) / 2, (height_ - tenth(height_)) / 2,
                         tenth(width_), tenth(height_)};
    std::vector<float> dark, light, middle;
    read_frames(part, dark, light);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      std::vector<double> seen;
      for (std::size_t t = 0; t < part.size(); ++t)
        if (const float per = light[c * part.size() + t]; per > 0) seen.push_back(1 / double{per});
      if (seen.empty())
        throw bad_input(flat_->path, "its middle", "none above the dark frame",
                        "numbers of a white sheet under light");
      middle.push_back(static_cast<float>(median(seen)));
    }
    middle_ = middle;
  }
  if (channels_.size() == 1) channels_ = {""};
  if (stack_.heights) {
    heights_ = Source{stack_.path_of(*stack_.heights), {0}, nullptr, {}};
    heights_->opened = InputFile(heights_->path).stamp();
    auto file = open(heights_->path);
    heights_->numbers = file->channels().size();
    if (heights_->numbers != 1) refuse_channels(*file, "one");
    keep(*heights_, std::move(file));
  }
  if (stack_.normals) normals_ = vectors(*stack_.normals);
  if (stack_.truth) will_read(stack_.path_of(stack_.truth->parameters));  // it is no output either
}

StackReader::StackReader(Stack stack) : StackReader(std::move(stack), WithoutName()) {
  digest_ = make_digest();
}

void StackReader::expect_frames(Stack stack) {
  StackReader(std::move(stack), WithoutName());
}

std::string StackReader::make_digest() const {
  std::vector<const Source*> all;
  for (const auto* sources : {&images_, &maps_})
    for (const Source& s : *sources)
      if (!s.position) all.push_back(&s);
  for (const auto* frame : {&dark_, &flat_, &heights_})
    if (*frame) all.push_back(&**frame);
  std::vector<std::string> digests(all.size());
  for_each_whole(all.size(), [&](std::size_t k) {
    const InputFile in(all[k]->path);
    expect_unchanged(*all[k], in);
    // Numbers have eight bytes at most: a file that is longer holds something else.
    constexpr std::uint64_t besides = std::uint64_t{1} << 24;
    digests[k] = sha256_of_file(in, besides + 8 * width_ * height_ * all[k]->numbers);
  });
  std::string list = sha256_of_file(stack_.path) + '\n';
  for (const auto& digest : digests) list += digest + '\n';
  return sha256(list);
}

void StackReader::expect_unchanged(const Source& source, const InputFile& now) {
  if (now.stamp() != source.opened)
    throw bad_input(source.path, "reading", "the file changed meanwhile",
                    "one that stays as it is");
}

std::size_t StackReader::bytes_of_texel() const {
  const std::size_t vectors = (shared_ ? 0 : 6 * images_.size()) + (has_normals() ? 3 : 0) +
                              3 * maps_.size() + (is_near_ ? 4 : 0);
  const std::size_t frames = dark_ || flat_ ? 2 : 0;
  return sizeof(float) * ((images_.size() + frames) * channels_.size() + vectors);
}

void StackReader::expect_photographs() const {
  if (!dark_ && !flat_) return;
  constexpr std::size_t at_once = std::size_t{1} << 20;
  const std::size_t rows = whole_blocks(at_once / width_, block_height_),
                    channels = channels_.size();
  std::vector<std::size_t> no_number(channels), no_light(channels);
  std::vector<float> dark, gain;
  for (std::size_t y = 0; y < height_; y += rows) {
    const Rectangle part{0, y, width_, std::min(rows, height_ - y)};
    read_frames(part, dark, gain);
    for (std::size_t k = 0; k < dark.size(); ++k) {
      no_number[k / part.size()] += !std::isfinite(dark[k]);
      no_light[k / part.size()] += std::isnan(gain[k]);
    }
  }
  const auto expect = [&](const Source& frame, const std::vector<std::size_t>& without,
                          const char* lacks, const char* expected) {
    const std::size_t texels = width_ * height_;
    for (std::size_t c = 0; c < channels; ++c)
      if (2 * without[c] > texels)
        throw bad_input(frame.path, channels == 1 ? "its numbers" : channels_[c],
                        fmt::format("{} in {} of {} pixels", lacks, without[c], texels), expected);
  };
  if (dark_)
    expect(*dark_, no_number, "none", "numbers of a photograph without light in most of them");
  if (flat_)
    expect(*flat_, no_light, dark_ ? "none above the dark frame" : "none above 0",
           "numbers of a white sheet under light in most of them");
}

void StackReader::read_frames(const Rectangle& part,
                              std::vector<float>& dark,
                              std::vector<float>& gain) const {
  const std::size_t n = channels_.size() * part.size();
  if (dark_)
    read(*dark_, part, dark);
  else
    dark.assign(n, 0);
  if (!flat_) return gain.assign(n, 1);
  read(*flat_, part, gain);
  for (std::size_t k = 0; k < n; ++k) {
    const float light = gain[k] - dark[k];
    gain[k] = light > 0 && std::isfinite(light)
                  ? (middle_.empty() ? 1 : middle_[k / part.size()]) / light
                  : nan;
  }
}

void StackReader::read(const Source& source, const Rectangle& part, std::vector<float>& to) const {
  to.resize(source.channels.size() * part.size());
  std::vector<float*> planes;
  for (std::size_t c = 0; c < source.channels.size(); ++c)
    planes.push_back(to.data() + c * part.size());
  const auto read_from = [&](ImageFile& file) {
    expect_unchanged(source, InputFile(source.path));
    file.read(part, source.channels, planes);
    expect_unchanged(source, InputFile(source.path));
  };
  if (source.file)
    read_from(*source.file);
  else
    opening_->with(static_cast<double>(source.held),
                   [&] { read_from(*open_image(source.path, stack_.linear)); });
}

std::vector<float> StackReader::places_of(const Rectangle& part) const {
  const std::size_t n = part.size();
  std::vector<float> places(3 * n), heights(n, 0);
  if (heights_) read(*heights_, part, heights);
  const double step = *stack_.width / static_cast<double>(width_);
  const auto from_middle = [&](std::size_t at, std::size_t all) {
    return static_cast<float>((static_cast<double>(2 * at + 1) - static_cast<double>(all)) / 2 *
                              step);
  };
  for (std::size_t t = 0; t < n; ++t) {
    places[t] = from_middle(part.x + t % part.width, width_);
    places[n + t] = -from_middle(part.y + t / part.width, height_);
    places[2 * n + t] = heights[t];
  }
  return places;
}

void StackReader::read_vectors(std::size_t map,
                               const Rectangle& part,
                               const std::vector<float>& places,
                               std::vector<float>& to) const {
  const std::size_t n = part.size();
  if (const auto& from = maps_[map].position) {
    const std::array<double, 3> at{from->x, from->y, from->z};
    to.resize(3 * n);
    for (std::size_t k = 0; k < to.size(); ++k)
      to[k] = static_cast<float>(at[k / n] - double{places[k]});
  } else {
    read(maps_[map], part, to);
  }
  for (std::size_t t = 0; t < n; ++t) {
    const double x = to[t], y = to[n + t], z = to[2 * n + t];
    const double length = std::hypot(x, y, z);
    const auto unit = [&](double v) { return length > 0 ? static_cast<float>(v / length) : 0.0F; };
    if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z))  // hypot forgets a NaN
      to[t] = unit(x), to[n + t] = unit(y), to[2 * n + t] = unit(z);
    else
      to[t] = to[n + t] = to[2 * n + t] = nan;
  }
}

void StackReader::refuse(const Source& source,
                         const Rectangle& part,
                         std::size_t texel,
                         const char* what) const {
  throw bad_input(
      source.path,
      fmt::format("column {}, row {}", part.x + texel % part.width, part.y + texel / part.width),
      what, "a direction above the surface: z above 0");
}

void StackReader::make_reflectance(const Rectangle& part,
                                   std::size_t i,
                                   const std::vector<std::vector<float>>& maps,
                                   const std::vector<float>& places,
                                   std::vector<float>& values) const {
  const std::size_t n = part.size();
  const StackImage& image = stack_.images[i];
  const auto vector_of = [&](std::size_t map, std::size_t t) {
    const auto& m = maps[map];
    return Direction{m[t], m[n + t], m[2 * n + t]};
  };
  const auto light = direction_of(image.light);
  for (std::size_t t = 0; t < n; ++t) {
    const Direction normal = has_normals() ? vector_of(normals_, t) : Direction{};
    const bool has_surface = normal.z > 0;  // not of NaN
    double factor = image.scale;
    if (stack_.values == StackValues::f_r_cosine) {
      const double cosine = dot(normal, light ? *light : vector_of(light_maps_[i], t));
      factor = cosine >= least_cosine ? factor / cosine : double{nan};
      if (const auto* near = std::get_if<SidePosition<Side::light>>(&image.light)) {
        const Vector to_lamp =
            near->at - Vector{double{places[t]}, double{places[n + t]}, double{places[2 * n + t]}};
        factor *= dot(to_lamp, to_lamp) / dot(near->at, near->at);
      }
    }
    bool has_value = false;
    for (std::size_t k = t; k < values.size(); k += n) {
      const bool is_number = std::isfinite(values[k]);
      has_value = has_value || is_number;
      values[k] = is_number && has_surface ? values[k] * static_cast<float>(factor) : nan;
    }
    if (!has_value || !has_surface) continue;
    for (const std::size_t map : {light_maps_[i], view_maps_[i]})
      if (map != none && !(maps[map][2 * n + t] > 0))
        refuse(maps_[map], part, t,
               std::isnan(maps[map][2 * n + t]) ? "no direction" : "one below the surface");
  }
}

void StackReader::read(const Rectangle& part, StackPart& to) const {
  const std::size_t n = part.size(), images = images_.size(), channels = channels_.size();
  to.texels = n;
  to.images = images;
  to.channels = channels;
  to.shared = shared_;
  to.values.resize(images * channels * n);
  to.light.resize(images * 3 * (shared_ ? 1 : n));
  to.view.resize(to.light.size());
  to.normal.resize(has_normals() ? 3 * n : 0);

  std::vector<std::vector<float>> maps(maps_.size());
  const auto places = is_near_ ? places_of(part) : std::vector<float>();
  for_each_whole(maps.size(), [&](std::size_t m) { read_vectors(m, part, places, maps[m]); });
  // do_piece(first texel, texels) of each piece
  const auto for_pieces = [&](const auto& do_piece) {
    for (std::size_t first = 0; first < n; first += StackPart::piece_texels)
      do_piece(first, std::min(StackPart::piece_texels, n - first));
  };
  if (has_normals()) {
    const auto& normals = maps[normals_];
    for (std::size_t t = 0; t < n; ++t)
      if (normals[2 * n + t] < 0 ||
          (normals[2 * n + t] == 0 && (normals[t] != 0 || normals[n + t] != 0)))
        refuse(maps_[normals_], part, t, "a normal that points below the surface");
    for_pieces([&](std::size_t first, std::size_t count) {
      for (std::size_t k = 0; k < 3; ++k)
        std::copy_n(normals.data() + k * n + first, count,
                    to.normal.data() + first * 3 + k * count);
    });
  }

  std::vector<float> dark, gain;
  if (dark_ || flat_) read_frames(part, dark, gain);
  for_each_whole(images, [&](std::size_t i) {
    std::vector<float> read_values;
    read(images_[i], part, read_values);
    if (stack_.saturation || stack_.floor || !gain.empty()) {
      constexpr float far = std::numeric_limits<float>::infinity();
      const auto clipped = static_cast<float>(stack_.saturation.value_or(double{far})),
                 floor = static_cast<float>(stack_.floor.value_or(-double{far}));
      for (std::size_t k = 0; k < read_values.size(); ++k) {
        float& v = read_values[k];
        const bool is_clipped = v >= clipped;
        if (!gain.empty()) v = (v - dark[k]) * gain[k];
        if (is_clipped || v <= floor) v = nan;
      }
    }
    const StackImage& image = stack_.images[i];
    const auto light = direction_of(image.light), view = direction_of(image.view);

    if (light && view && !has_normals()) {  // most stacks: one factor for all
      const double cosine = stack_.values == StackValues::f_r_cosine ? light->z : 1;
      const auto factor =
          static_cast<float>(cosine >= least_cosine ? image.scale / cosine : double{nan});
      for (float& v : read_values) {
        const bool is_number = std::abs(v) <= std::numeric_limits<float>::max();
        v = is_number ? v * factor : nan;
      }
    } else {
      make_reflectance(part, i, maps, places, read_values);
    }

    for_pieces([&](std::size_t first, std::size_t count) {
      float* const values = to.values.data() + first * images * channels + i * channels * count;
      for (std::size_t c = 0; c < channels; ++c)
        std::copy_n(read_values.data() + c * n + first, count, values + c * count);
      if (shared_) return;
      const auto put = [&](StackPart::Floats& all, const std::optional<Direction>& fixed,
                           std::size_t map) {
        float* const directions = all.data() + first * images * 3 + i * 3 * count;
        for (std::size_t k = 0; k < 3; ++k)
          if (fixed)
            std::fill_n(directions + k * count, count, floats(*fixed)[k]);
          else
            std::copy_n(maps[map].data() + k * n + first, count, directions + k * count);
      };
      put(to.light, light, light_maps_[i]);
      put(to.view, view, view_maps_[i]);
    });
    if (shared_) {
      std::ranges::copy(floats(*light), to.light.begin() + static_cast<std::ptrdiff_t>(3 * i));
      std::ranges::copy(floats(*view), to.view.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  });
}

}  // namespace gonio
