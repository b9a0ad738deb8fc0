#pragma once
/// \file
/// Small stacks of known parameters, and maps of them as files.

#include <algorithm>
#include <string>
#include <vector>

#include "data_synth/stack_synth.h"
#include "fitting/map/fit_map.h"
#include "fitting/map/gather.h"
#include "image/exr.h"
#include "stack/stack_reader.h"
#include "support.h"

namespace gonio::test {

inline constexpr std::size_t map_width = 23, map_height = 19;

/// Image of parameters that vary over the map.
inline std::string known_parameters(const Folder& f) {
  Image p;
  p.width = map_width;
  p.height = map_height;
  p.channels = {"alpha", "kd.R", "kd.G", "kd.B"};
  p.planes.resize(4);
  for (std::size_t t = 0; t < map_width * map_height; ++t) {
    const auto x = static_cast<float>(t % map_width), y = static_cast<float>(t / map_width);
    p.planes[0].push_back(0.15F + 0.015F * x);
    for (std::size_t c = 1; c < 4; ++c)
      p.planes[c].push_back(0.05F * static_cast<float>(c) + 0.02F * y);
  }
  write_exr(f / "known.exr", p);
  return f / "known.exr";
}

inline BoundModel known_model() {
  return bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                    parse_settings(std::vector<std::string>{"f0=0.05"}), 3);
}

/// Stack in a folder of its own; its path.
inline std::string known_stack(const Folder& f,
                               const std::string& name,
                               StackSynthOptions o = {},
                               std::size_t images = 24) {
  o.images = images;
  o.parameters = known_parameters(f);
  synthesize_stack(known_model(), o, f / name);
  return f / name + "/stack.json";
}

/// Map of a stack, fitted in tiles of that size; its path.
inline std::string fit_map(const Folder& f,
                           const std::string& stack,
                           const TexelOptions& options,
                           std::size_t tile_width = 256,
                           std::size_t tile_height = 256,
                           const std::string& name = "map") {
  const StackReader reader(read_stack(stack));
  const TileGrid grid{reader.width(), reader.height(), tile_width, tile_height};
  const std::string folder = f / name + ".tiles";
  fit_tiles(reader, options, grid, grid.all(), folder);
  OutputFile out(f / name + ".exr");
  gather_tiles(folder, out, 1);
  out.commit();
  return f / name + ".exr";
}

inline const std::vector<float>& plane(const Image& map, const std::string& channel) {
  const auto at = std::ranges::find(map.channels, channel);
  EXPECT_NE(at, map.channels.end()) << channel;
  return map.planes[static_cast<std::size_t>(at - map.channels.begin())];
}

}  // namespace gonio::test
