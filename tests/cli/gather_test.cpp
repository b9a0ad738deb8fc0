// gonio gather: the tiles of a map joined. What it makes of tables is in parts_test.cpp.
#include <filesystem>

#include "cli/program.h"
#include "image/exr.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

const std::string fit = "fit_map s/stack.json --fix f0=0.05 --tile-size 10,6 ";

/// A stack in the folder s, and its four tiles in t.
void make_tiles(const Folder& f) {
  ASSERT_EQ(gonio(f, std::string("synth ") + paint +
                         " --layout map --size 20,12 --images 12 --noise 0.02 -o s")
                .code,
            0);
  ASSERT_EQ(gonio(f, fit + "--tile 0,0 --tile 1,0 --tile 0,1 --tile 1,1 -o t").code, 0);
}

TEST(GatherCommand, JoinsTilesIntoTheMapOfOneRunByteForByte) {
  const Folder f;
  make_tiles(f);
  ASSERT_EQ(gonio(f, fit + "-o whole.exr").code, 0);
  const auto o = gonio(f, "gather t -o joined.exr");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_NE(o.out.find("texels  20 × 12, 100 % converged\n"), o.out.npos) << o.out;
  EXPECT_NE(o.out.find("map     joined.exr\n"), o.out.npos) << o.out;
  EXPECT_EQ(read_bytes(f / "joined.exr"), read_bytes(f / "whole.exr"));
  EXPECT_TRUE(fs::exists(f / "t/tile_1_1.exr")) << "the tiles stay";
}

TEST(GatherCommand, TellsTheChannelsOfAMapAsRedGreenBlue) {
  const Folder f;
  make_tiles(f);
  std::string names;
  const auto j = gonio(f, "gather t -o joined.exr --json").json();
  for (const auto& p : j["parameters"]) names += p["name"].get<std::string>() + " ";
  EXPECT_EQ(names, "alpha f0.R f0.G f0.B kd.R kd.G kd.B ");
}

TEST(GatherCommand, NamesTheTilesThatAreMissingAndWritesNoMap) {
  const Folder f;
  make_tiles(f);
  fs::remove(f / "t/tile_0_1.exr");
  expect_one_line(gonio(f, "gather t -o joined.exr"), 3, "t: tiles: found 3 of 4, without 0,1");
  EXPECT_FALSE(fs::exists(f / "joined.exr"));
}

TEST(GatherCommand, OpensNoShaderElsewhereThatTilesName) {
  const Folder f, other;
  make_tiles(f);
  other.write("my.glsl", "words that nobody shall see");
  for (const char* name : {"tile_0_0.exr", "tile_1_0.exr", "tile_0_1.exr", "tile_1_1.exr"}) {
    Image tile = read_exr(f / (std::string("t/") + name));
    tile.attributes["gonio:model"] = (other / "my.glsl") + ":brdf";
    write_exr(f / (std::string("t/") + name), tile);
  }
  expect_one_line(gonio(f, "gather t -o joined.exr --json"), 3, "--follow-paths");
  EXPECT_FALSE(fs::exists(f / "joined.exr"));
}

TEST(GatherCommand, RefusesWhatIsOfTablesBesideTilesAndWhatIsOfTilesBesideTables) {
  const Folder f;
  make_tiles(f);
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane -o a.csv").code, 0);
  ASSERT_EQ(gonio(f, "fit a.csv a.csv -o results").code, 0);
  fs::create_directory(f / "empty");
  expect_one_line_each(f, 2,
                       {{"gather t a.csv -o joined.exr", "no FILE"},
                        {"gather t", "-o MAPS.exr"},
                        {"gather t -o t", "would be overwritten"},
                        {"gather results -o joined.exr", "results holds no tiles of a map"},
                        {"gather a.csv -o joined.exr", "a.csv holds no tiles of a map"},
                        {"gather empty -o joined.exr", "empty holds no tiles of a map"}});
  EXPECT_FALSE(fs::exists(f / "joined.exr"));
}

}  // namespace
}  // namespace gonio::test
