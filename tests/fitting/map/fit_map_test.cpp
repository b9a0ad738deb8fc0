// Maps by tiles: what was put in comes back, and nothing depends on how the work is cut.
#include "fitting/map/fit_map.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "fitting/map/stacks.h"
#include "refusal.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

using namespace test;

TexelOptions held() {
  TexelOptions o;
  o.fixed = parse_settings(std::vector<std::string>{"f0=0.05"});
  return o;
}

TEST(FitMap, RecoversTheParametersOfEveryTexel) {
  const Folder f;
  const Image known = read_exr(known_parameters(f));
  const Image map = read_exr(fit_map(f, known_stack(f, "s"), {}));
  EXPECT_EQ(map.width, map_width);
  EXPECT_EQ(map.height, map_height);
  for (const char* name : {"alpha", "kd.R", "kd.G", "kd.B"}) {
    const auto& found = plane(map, name);
    for (std::size_t t = 0; t < found.size(); ++t)
      ASSERT_NEAR(found[t], plane(known, name)[t], 2e-3F) << name << " " << t;
  }
  for (const char* name : {"f0.R", "f0.G", "f0.B"})
    for (const float v : plane(map, name)) ASSERT_NEAR(v, 0.05F, 2e-3F) << name;
  for (const char* name : {"outcome", "alpha.status", "kd.status.R", "f0.status.B"})
    for (const float v : plane(map, name)) ASSERT_EQ(v, 0) << name;
  for (const float v : plane(map, "alpha.std_error")) ASSERT_GE(v, 0);
}

TEST(FitMap, SaysOfWhatItWasMade) {
  const Folder f;
  const std::string stack = known_stack(f, "s", {}, 12);
  const Image map = read_exr_header(fit_map(f, stack, held()));
  EXPECT_EQ(map.attributes.at("gonio:schema"), "gonio.map/1");
  EXPECT_EQ(map.attributes.at("gonio:model"), "lambert+ggx/smith_ggx.correlated/schlick");
  EXPECT_HAS(map.attributes.at("gonio:options"), "\"name\":\"f0\"");
  EXPECT_EQ(map.attributes.at("gonio:stack"), StackReader(read_stack(stack)).digest());
  EXPECT_EQ(map.attributes.at("gonio:channels"), "R,G,B");
}

TEST(FitMap, IsTheSameToTheBitWhateverTheTilesAndTheThreads) {
  const Folder f;
  StackSynthOptions noisy;
  noisy.noise = 0.05;
  const std::string stack = known_stack(f, "s", noisy, 12);
  const std::string whole = read_bytes(fit_map(f, stack, held()));
  int n = 0;
  for (const auto& [width, height] :
       {std::pair<std::size_t, std::size_t>{8, 8}, {5, 19}, {1, 4}, {64, 3}})
    for (const std::size_t threads : {1, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      const auto other = fit_map(f, stack, held(), width, height, "map" + std::to_string(n++));
      EXPECT_EQ(read_bytes(other), whole) << width << " " << height << " " << threads;
    }
}

TEST(FitMap, IsTheSameToTheBitWhateverTheMemoryOfItsResults) {
  const Folder f;
  const StackReader reader(read_stack(known_stack(f, "s", {}, 12)));
  const TileGrid grid{map_width, map_height, 8, 16};
  const auto tiles = [&](const std::string& name, std::size_t most_results) {
    fit_tiles(reader, held(), grid, grid.all(), f / name, {}, {}, most_results);
    std::vector<std::string> all;
    for (const Tile& t : grid.all()) all.push_back(read_bytes(f / (name + "/" + file_name(t))));
    return all;
  };
  const auto whole = tiles("whole", std::size_t{1} << 28);
  for (const std::size_t bytes : {1, 4000, 20'000})
    EXPECT_EQ(tiles(std::to_string(bytes), bytes), whole) << bytes;
}

TEST(FitMap, RemovesNothingFromItsFolderThatGonioDidNotMake) {
  const Folder f;
  const StackReader reader(read_stack(known_stack(f, "s", {}, 12)));
  const TileGrid grid{map_width, map_height, 8, 8};
  const std::string folder = f / "t", other = folder + "/tile_0_0.exr",
                    mine = folder + "/tile_2_2.exr";
  fit_tiles(reader, {}, grid, grid.all(), folder);
  const auto line = [&] {
    return refusal([&] { remove_other_tiles(reader, held(), grid, folder); });
  };
  for (const std::string& bytes : {read_bytes(f / "s/image_000.exr"), std::string("no image")}) {
    f.write("t/tile_2_2.exr", bytes);
    EXPECT_HAS(line(), "tile_2_2.exr: header: found no tile of a map");
    EXPECT_EQ(read_bytes(mine), bytes);
    EXPECT_TRUE(std::filesystem::exists(other)) << "before anything goes";
  }
  std::filesystem::remove(mine);
  EXPECT_EQ(line(), "");
  EXPECT_FALSE(std::filesystem::exists(other)) << "of other options";
}

TEST(FitMap, OfATileThatWasLostIsTheSameAndFitsThatTileAlone) {
  const Folder f;
  const std::string stack = known_stack(f, "s", {}, 12);
  const std::string whole = read_bytes(fit_map(f, stack, held(), 8, 8));
  const StackReader reader(read_stack(stack));
  const TileGrid grid{map_width, map_height, 8, 8};
  const std::string folder = f / "map.tiles", lost = folder + "/tile_1_2.exr";
  const std::string tile = read_bytes(lost);
  ASSERT_TRUE(std::filesystem::remove(lost));
  std::vector<std::size_t> seen;
  const MapCount n = fit_tiles(reader, held(), grid, grid.all(), folder,
                               [&](const MapCount& c) { seen.push_back(c.done); });
  EXPECT_EQ(n.tiles, 9U);
  EXPECT_EQ(n.kept, 8U);
  EXPECT_EQ(n.texels, 8 * 3U) << "the last row is of 3 texels";
  EXPECT_EQ(n.done, n.texels);
  EXPECT_EQ(seen.front(), 0U);
  EXPECT_EQ(seen.back(), n.texels);
  EXPECT_EQ(read_bytes(lost), tile);
}

TEST(FitMap, OfNumpysArraysIsThatOfOpenExr) {
  const Folder f;
  const Image exr = read_exr(fit_map(f, known_stack(f, "exr", {}, 12), held()));
  StackSynthOptions npy;
  npy.format = ImageFormat::npy;
  const Image other = read_exr(fit_map(f, known_stack(f, "npy", npy, 12), held(), 256, 256, "n"));
  EXPECT_EQ(other.channels, exr.channels);
  for (std::size_t c = 0; c < exr.planes.size(); ++c)
    for (std::size_t t = 0; t < exr.planes[c].size(); ++t)
      if (!std::isnan(exr.planes[c][t])) {
        ASSERT_EQ(other.planes[c][t], exr.planes[c][t]) << exr.channels[c] << " " << t;
      }
}

TEST(FitMap, WithDirectionsForEachTexelIsThatOfSharedOnes) {
  const Folder f;
  const std::string stack = known_stack(f, "s", {}, 12);
  const Image shared = read_exr(fit_map(f, stack, held()));
  Stack each = read_stack(stack);
  for (std::size_t i = 0; i < each.images.size(); ++i) {
    const Direction l = *direction_of(each.images[i].light);
    Image vectors;
    vectors.width = map_width;
    vectors.height = map_height;
    vectors.channels = {"X", "Y", "Z"};
    for (const double v : {l.x, l.y, l.z})
      vectors.planes.emplace_back(map_width * map_height, static_cast<float>(3 * v));
    const std::string name = "light_" + std::to_string(i) + ".exr";
    write_exr(f / "s/" + name, vectors);
    each.images[i].light = SideMap<Side::light>{name};
  }
  const Image other =
      read_exr(fit_map(f, f.write("s/each.json", to_json(each)), held(), 256, 256, "each"));
  for (const char* name : {"alpha", "kd.R", "kd.G", "kd.B"})
    for (std::size_t t = 0; t < map_width * map_height; ++t)
      ASSERT_NEAR(plane(other, name)[t], plane(shared, name)[t], 1e-4F) << name << " " << t;
}

TEST(FitMap, LeavesOutWhatIsNoNumberAndChangesNoOtherTexel) {
  const Folder f;
  const std::string stack = known_stack(f, "s", {}, 12);
  const Image whole = read_exr(fit_map(f, stack, held()));
  constexpr std::size_t hole = 77;
  for (int i = 0; i < 12; ++i) {
    const std::string path = fmt::format("{}/image_{:03}.exr", f / "s", i);
    Image image = read_exr(path);
    for (auto& p : image.planes) p[hole] = std::numeric_limits<float>::quiet_NaN();
    write_exr(path, image);
  }
  const Image map = read_exr(fit_map(f, stack, held(), 256, 256, "holed"));
  EXPECT_EQ(plane(map, "outcome")[hole],
            static_cast<float>(static_cast<int>(TexelOutcome::no_data)));
  EXPECT_TRUE(std::isnan(plane(map, "alpha")[hole]));
  for (std::size_t t = 0; t < map_width * map_height; ++t)
    if (t != hole) {
      ASSERT_EQ(plane(map, "alpha")[t], plane(whole, "alpha")[t]);
    }
}

TEST(FitMap, RefusesAFolderWithTilesOfAnythingElseAndLeavesThemAsTheyAre) {
  const Folder f;
  const std::string stack = known_stack(f, "s", {}, 12);
  fit_map(f, stack, held(), 8, 8);
  const std::string folder = f / "map.tiles", tile = folder + "/tile_0_0.exr";
  const std::string before = read_bytes(tile);
  const auto line = [&](const std::string& of, const TexelOptions& options, std::size_t size) {
    const StackReader reader(read_stack(of));
    const TileGrid grid{map_width, map_height, size, size};
    return refusal([&] { fit_tiles(reader, options, grid, grid.all(), folder); });
  };
  EXPECT_EQ(line(stack, held(), 8), "") << "the ruler";
  EXPECT_HAS(line(stack, {}, 8), "tile_0_0.exr: gonio:options: found …");
  EXPECT_HAS(line(stack, held(), 9), "gonio:tile_size: found 8,8, expected 9,9");
  TexelOptions lambert;
  lambert.model = "lambert";
  EXPECT_HAS(line(stack, lambert, 8), "gonio:model");
  EXPECT_HAS(line(known_stack(f, "t", {}, 13), held(), 8), "gonio:stack");
  Image older = read_exr(tile);
  older.attributes["gonio:version"] = "0.0.1";
  write_exr(tile, older);
  EXPECT_HAS(line(stack, held(), 8), "gonio:version: found 0.0.1, expected");
  f.write("map.tiles/tile_0_0.exr", before);
  EXPECT_EQ(line(stack, held(), 8), "");
  // Not the first one alone is looked at.
  const std::string last = folder + "/tile_2_2.exr", whole = read_bytes(last);
  older = read_exr(last);
  older.attributes["gonio:version"] = "0.0.1";
  write_exr(last, older);
  EXPECT_HAS(line(stack, held(), 8), "tile_2_2.exr: gonio:version: found 0.0.1, expected");
  f.write("map.tiles/tile_2_2.exr", whole);
  f.write("map.tiles/tile_0_0.exr", "half a til");
  EXPECT_HAS(line(stack, held(), 8), "tile_0_0.exr: ");
  EXPECT_EQ(read_bytes(tile), "half a til") << "not overwritten";
}

TEST(FitMap, RefusesOptionsOfNoMapAndAFolderThatCannotBeMade) {
  const Folder f;
  const StackReader reader(read_stack(known_stack(f, "s", {}, 12)));
  const TileGrid grid{map_width, map_height, 8, 8};
  TexelOptions o;
  o.model = "lambert+nonsense";
  EXPECT_HAS(refusal([&] { fit_tiles(reader, o, grid, grid.all(), f / "t"); }, Exit::usage),
             "nonsense");
  f.write("file", "x");
  EXPECT_HAS(refusal([&] { fit_tiles(reader, held(), grid, grid.all(), f / "file/t"); }),
             "file/t: writing");
  EXPECT_HAS(refusal([&] { fit_tiles(reader, held(), grid, grid.all(), f / "file"); }), "file");
}

}  // namespace
}  // namespace gonio
