// Tiles joined into their map, and those that are refused.
#include "fitting/map/gather.h"

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "fitting/map/stacks.h"
#include "refusal.h"

#include <sys/resource.h>
#include <unistd.h>

namespace gonio {
namespace {

using namespace test;

/// Folder of tiles, 8 × 8 each.
std::string tiles(const Folder& f) {
  TexelOptions lambert;
  lambert.model = "lambert";
  fit_map(f, known_stack(f, "s", {}, 4), lambert, 8, 8);
  return f / "map.tiles";
}
MapDocument gather(const Folder& f, const std::string& folder) {
  OutputFile out(f / "joined.exr");
  auto d = gather_tiles(folder, out, 1);
  out.commit();
  return d;
}

TEST(Gather, SaysHowManyTexelsEndedHowAndTheirMeans) {
  const Folder f;
  const MapDocument d = gather(f, tiles(f));
  EXPECT_EQ(d.model, "lambert");
  EXPECT_EQ(d.tiles, 9U);
  EXPECT_EQ(d.converged + d.not_converged + d.no_data, map_width * map_height);
  ASSERT_EQ(d.parameters.size(), 3U);
  const Image map = read_exr(f / "joined.exr");
  for (const auto& p : d.parameters) {
    double sum = 0, known = 0;
    for (const float v : plane(map, p.name))
      if (!std::isnan(v)) sum += static_cast<double>(v), ++known;
    EXPECT_GT(known, 0);
    EXPECT_LT(known, map_width * map_height) << "four values of another model leave some unknown";
    EXPECT_NEAR(p.mean, sum / known, 1e-9) << p.name;
    EXPECT_EQ(static_cast<double>(p.not_identifiable), map_width * map_height - known);
    EXPECT_EQ(p.free + p.fixed + p.at_bound + p.not_identifiable, map_width * map_height);
  }
  EXPECT_TRUE(has_tiles(f / "map.tiles"));
  EXPECT_FALSE(has_tiles(f / "s"));
  EXPECT_FALSE(has_tiles(f / "nothing"));
}

TEST(Gather, NamesTheTilesThatAreMissing) {
  const Folder f;
  const std::string folder = tiles(f);
  for (const char* name : {"/tile_1_0.exr", "/tile_2_2.exr"})
    ASSERT_TRUE(std::filesystem::remove(folder + name));
  EXPECT_HAS(refusal([&] { gather(f, folder); }),
             "map.tiles: tiles: found 7 of 9, without 1,0 2,2, expected all of them");
  EXPECT_FALSE(std::filesystem::exists(f / "joined.exr"));
  for (const auto& e : std::filesystem::directory_iterator(folder))
    std::filesystem::remove(e.path());
  EXPECT_HAS(refusal([&] { gather(f, folder); }), "tiles: found none");
  EXPECT_HAS(refusal([&] { gather(f, f / "nothing"); }), "nothing: opening");
}

TEST(Gather, LeavesOtherFilesOfTheFolderAlone) {
  const Folder f;
  const std::string folder = tiles(f);
  for (const char* name : {"tile_1.exr", "tile_01_1.exr", "tile_1_1.exr.bak", "notes.txt"})
    f.write(std::string("map.tiles/") + name, "x");
  EXPECT_EQ(gather(f, folder).tiles, 9U);
  EXPECT_EQ(read_bytes(folder + "/notes.txt"), "x");
}

/// An image with another value of one attribute.
Image changed(Image image, const std::string& name, const std::string& value) {
  image.attributes[name] = value;
  return image;
}

TEST(Gather, RefusesTilesOfOtherOptionsStacksGridsAndVersions) {
  const Folder f;
  const std::string folder = tiles(f), tile = folder + "/tile_1_1.exr";
  const Image whole = read_exr(tile);
  const auto with = [&](const std::string& name, const std::string& value) {
    write_exr(tile, changed(whole, name, value));
    return refusal([&] { gather(f, folder); });
  };
  EXPECT_EQ(with("gonio:stack", whole.attributes.at("gonio:stack")), "") << "the ruler";
  for (const char* name :
       {"gonio:stack", "gonio:options", "gonio:version", "gonio:model", "gonio:channels",
        "gonio:size", "gonio:tile_size", "gonio:tile", "gonio:schema"})
    EXPECT_HAS(with(name, "another"), "tile_1_1.exr: " + std::string(name) + ": found another");
  Image less = whole;
  less.channels.pop_back();
  less.planes.pop_back();
  write_exr(tile, less);
  EXPECT_HAS(refusal([&] { gather(f, folder); }), "tile_1_1.exr: header");
  Image narrow = whole;
  narrow.width = 7;
  for (auto& p : narrow.planes) p.resize(7 * 8);
  write_exr(tile, narrow);
  EXPECT_HAS(refusal([&] { gather(f, folder); }), "found 7 × 8, ");
  write_exr(tile, whole);
  write_exr(folder + "/tile_9_9.exr", whole);
  EXPECT_HAS(refusal([&] { gather(f, folder); }), "tile_9_9.exr: gonio:tile");
}

TEST(Gather, RefusesFirstTilesThatLie) {
  const Folder f;
  const std::string folder = tiles(f), tile = folder + "/tile_0_0.exr";
  const Image whole = read_exr(tile);
  const auto with = [&](const std::string& name, const std::string& value) {
    write_exr(tile, changed(whole, name, value));
    return refusal([&] { gather(f, folder); });
  };
  for (const char* size : {"0,1", "1", "1,2,3", "99999999999999999999,1", "16385,1", "-1,2", ""})
    EXPECT_HAS(with("gonio:size", size), "expected two sizes") << size;
  EXPECT_HAS(with("gonio:size", "16384,16384"), "found 9 of 4194304, without 3,0 ");
  Image none = whole;
  none.attributes.clear();
  write_exr(tile, none);
  EXPECT_HAS(refusal([&] { gather(f, folder); }), "no attribute gonio:size");
  Image other = whole;
  other.channels[0] = "alpha.status";
  for (const auto& e : std::filesystem::directory_iterator(folder))
    if (e.path() != tile) std::filesystem::remove(e.path());
  other.attributes["gonio:size"] = "8,8";
  write_exr(tile, other);
  EXPECT_HAS(refusal([&] { gather(f, folder); }), "tile_0_0.exr: channels");
}

TEST(Gather, NeedsNoMoreMemoryForTilesOfManyChannels) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take the address space for themselves";
#endif
  const Folder f;
  std::filesystem::create_directory(f / "t");
  const TileGrid grid{8192, 64, 8192, 64};
  std::vector<ExrChannel> channels{{"misfit"}, {"outcome"}, {"rms"}};
  for (int k = 0; k < 128; ++k) channels.push_back({"x" + std::to_string(k)});
  MapAttributes map;
  for (const char* name : {"gonio:version", "gonio:model", "gonio:options", "gonio:stack",
                           "gonio:shaders", "gonio:channels"})
    map[name] = "a stranger's";
  {
    OutputFile out(f / "t/tile_0_0.exr");
    ExrWriter writer(out, grid.width, grid.height, channels, attributes_of(map, grid, {}),
                     ExrWriter::Packing::runs);
    const std::vector<float> row(grid.width);
    const std::vector<const float*> planes(channels.size(), row.data());
    for (std::size_t y = 0; y < grid.height; ++y) writer.write(1, planes);
    writer.finish();
    out.commit();
  }
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t room = rlim_t{450} << 20;  // of 550 MB for all rows at once
  const rlimit limit{pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + room,
                     before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
  EXPECT_NO_THROW(gather(f, f / "t"));
  ::setrlimit(RLIMIT_AS, &before);
}

}  // namespace
}  // namespace gonio
