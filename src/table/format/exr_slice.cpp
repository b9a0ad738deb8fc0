#include "table/format/exr_slice.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"
#include "image/exr.h"
#include "table/format/delimited.h"
#include "table/format/metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr const char *kLayout = "gonio:layout", *kPhi = "gonio:phi_d_rad",
                     *kChannels = "gonio:channels", *kTable = "gonio:table",
                     *kSlice = "image_slice";

std::string exr_name(const std::string& channel) {
  if (channel == "f") return "Y";
  if (channel == "r" || channel == "g" || channel == "b")
    return {static_cast<char>(channel[0] - 'a' + 'A')};
  return channel;
}

double angle(const std::string& path, const std::string& text) {
  const auto value = number_from<double>(text);
  if (!value || !(std::abs(*value) <= 2 * std::numbers::pi))
    throw bad_input(path, kPhi, text, "an angle in radians");
  return *value;
}

/// Turns [x][y] into [y][x] or back; `width` is that of the result.
template <class To, class From>
To turned(const From& from, std::size_t width) {
  To to(from.size());
  const std::size_t height = from.size() / width;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      to[y * width + x] = static_cast<typename To::value_type>(from[x * height + y]);
  return to;
}

}  // namespace

Grid image_slice_grid(std::size_t n_theta_h, std::size_t n_theta_d, double phi_d, Bins bins) {
  using enum Axis::Spacing;
  using std::numbers::pi;
  return {Grid::Kind::half_difference,
          {{{"theta_h", quadratic, n_theta_h, pi / 2},
            {"theta_d", uniform, n_theta_d, pi / 2},
            {"phi_d", constant, 1, phi_d}}},
          bins};
}

Table read_exr_slice(const std::string& path) {
  const Image header = read_exr_header(path);
  const auto attribute = [&](const char* name) {
    return attribute_of(header, name, path, "an image slice made by gonio");
  };
  if (const auto schema = header.attributes.find("gonio:schema");
      schema != header.attributes.end() && schema->second.starts_with("gonio.map"))
    throw bad_input(path, "gonio:schema",
                    fmt::format("{}: a map of {} × {} fits of {}", schema->second, header.width,
                                header.height, attribute("gonio:model")),
                    "a table; a map is shown by gonio export MAP --to gltf");
  if (attribute(kLayout) != kSlice) throw bad_input(path, kLayout, attribute(kLayout), kSlice);
  Table t;
  t.path = path;
  t.format = "exr";
  t.where =
      image_slice_grid(header.width, header.height, angle(path, attribute(kPhi)), Bins::centre);
  t.channels = comma_fields(attribute(kChannels));
  if (t.channels.size() > most_channels)
    throw bad_input(path, kChannels, fmt::format("{} channels", t.channels.size()),
                    fmt::format("at most {}", most_channels));
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const auto& channel : t.channels) {
    names.push_back(exr_name(channel));
    if (!known.insert(names.back()).second)
      throw bad_input(path, kChannels, names.back() + " twice", "each channel once");
  }
  for (const auto& plane : read_exr(path, most_slice_values, names).planes)
    t.values.push_back(turned<Values>(plane, header.height));
  apply_metadata(t, path, attribute(kTable));
  return t;
}

void write_exr_slice(const Table& t, const std::string& path) {
  const Grid* g = t.grid();
  if (!g || *g != image_slice_grid(g->axes[0].size, g->axes[1].size, g->axes[2].span, g->bins))
    throw bad_input(path, "writing", "a table of another shape",
                    "an image slice over theta_h, theta_d");
  Image image;
  image.width = g->axes[0].size;
  image.height = g->axes[1].size;
  for (const auto& channel : t.channels) image.channels.push_back(exr_name(channel));
  std::vector<std::string> fields;
  std::ranges::transform(t.channels, std::back_inserter(fields), comma_field);
  for (const auto& plane : t.values)
    image.planes.push_back(turned<std::vector<float>>(plane, image.width));
  image.attributes = {{kLayout, kSlice},
                      {kPhi, fmt::format("{}", g->axes[2].span)},
                      {kChannels, fmt::format("{}", fmt::join(fields, ","))},
                      {kTable, metadata_text(t)}};
  write_exr(path, image);
}

}  // namespace gonio
