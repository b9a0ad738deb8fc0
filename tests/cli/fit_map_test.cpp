// gonio fit_map: from a stack to a map, killed and begun again, and what it refuses.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/text.h"
#include "cli/program.h"
#include "image/exr.h"
#include "tiff_bytes.h"

#include <fmt/format.h>
#include <sys/resource.h>

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

const std::string model = "--fix f0=0.05";

/// A stack in the folder s.
void make_stack(const Folder& f, const std::string& words = "") {
  const auto o = gonio(f, std::string("synth ") + paint +
                              " --layout map --size 20,12 --images 12 --noise 0.02 -o s " + words);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "s/stack.json: 12 images, noise 2 %, seed 1\n");
  EXPECT_EQ(o.err, "");
}
std::string map_bytes(const Folder& f) {
  return read_bytes(f / "maps.exr");
}

TEST(FitMapCommand, FitsAStackAndSaysWhatTheMapHolds) {
  const Folder f;
  make_stack(f);
  const auto o = gonio(f, "fit_map s/stack.json " + model + " -o maps.exr");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "") << "progress is for terminals";
  EXPECT_NE(o.out.find("texels  20 × 12, 100 % converged\n"), o.out.npos) << o.out;
  EXPECT_NE(o.out.find("\nalpha "), o.out.npos) << o.out;
  EXPECT_NE(o.out.find("map     maps.exr\n"), o.out.npos) << o.out;
  EXPECT_FALSE(fs::exists(f / "maps.exr.tiles")) << "taken away once the map is whole";
  const Image map = read_exr(f / "maps.exr");
  const auto alpha = std::ranges::find(map.channels, "alpha");
  ASSERT_NE(alpha, map.channels.end());
  for (const float v : map.planes[static_cast<std::size_t>(alpha - map.channels.begin())])
    EXPECT_NEAR(v, 0.15F, 0.03F);
}

TEST(StackCommand, MakesAStackOfPhotographsAndTheListOfTheirLamps) {
  const Folder f;
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o\n0,0,0,0\n40,90,0,0\n60,180,0,0\n");
  ASSERT_EQ(gonio(f, std::string("synth ") + paint +
                         " --layout map --size 4,3 --values f_r_cosine --directions d.csv -o s")
                .code,
            0);
  f.write("s/dome.lp",
          "3\nimage_000.jpg 0 0 1\nimage_001.jpg 0 0.642788 0.766044\n"
          "image_002.jpg -0.866025 0 0.5\n");
  const auto o = gonio(f, "stack s/dome.lp -o s/mine.json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("s/mine.json: 3 images of 4 × 3\n"), o.out.npos) << o.out;
  EXPECT_NE(o.out.find("scale   unknown"), o.out.npos) << o.out;
  const auto j =
      gonio(f, "stack s/dome.lp --white 0.5 --white-reflectance 0.9 -o s/mine.json --json").json();
  EXPECT_NEAR(j["images"][0]["scale"], 0.9 / (3.14159265 * 0.5), 1e-6);
  EXPECT_EQ(j["values"], "f_r_cosine");
  expect_one_line(gonio(f, "stack s/dome.lp --images d.csv -o s/x.json"), 3, "image_000.jpg");
  expect_one_line(gonio(f, "stack s/dome.lp --white 0 -o s/x.json"), 2, "--white");
  expect_one_line(gonio(f, "stack s/dome.lp --white-reflectance 0.9 -o s/x.json"), 2, "--white");
  expect_one_line(gonio(f, "stack s/dome.lp --saturation 1 --floor 2 -o s/x.json"), 2,
                  "--saturation");
  expect_one_line(gonio(f, "stack s/dome.lp --images . -o s/x.json"), 3,
                  ".exr, .npy, .png or .tif");
  EXPECT_FALSE(fs::exists(f / "s/x.json"));
}

TEST(StackCommand, TakesVectorsAsPlacesOfLampsWhereTheyAreNear) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 4,3 --images 2 -o s").code, 0);
  f.write("s/dome.lp", "2\nimage_000.exr 0 0 100\nimage_001.exr 0 120 160\n");
  const auto j = gonio(f, "stack s/dome.lp --near 40 --white 0.5 -o s/mine.json --json").json();
  EXPECT_EQ(j["width"], 40);
  EXPECT_EQ(j["images"][1]["light_position"], nlohmann::json({0, 120, 160}));
  const double first = j["images"][0]["scale"], second = j["images"][1]["scale"];
  EXPECT_NEAR(first, 1 / (3.14159265 * 0.5), 1e-6);
  EXPECT_NEAR(second, first * 4, 1e-6) << "twice as far, a quarter of the light";
}

TEST(StackCommand, RefusesFramesThatAreNoPhotographs) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 4,3 --images 2 -o s").code, 0);
  f.write("s/dome.lp", "2\nimage_000.exr 0 0 1\nimage_001.exr 0 0.6 0.8\n");
  Image frame{4, 3, {"R", "G", "B"}, std::vector(3, std::vector<float>(12)), {}};
  write_exr(f / "s/zeros.exr", frame);
  for (auto& plane : frame.planes) plane.assign(12, std::numeric_limits<float>::quiet_NaN());
  write_exr(f / "s/nan.exr", frame);
  expect_one_line_each(f, 3,
                       {{"stack s/dome.lp --flat s/zeros.exr -o s/x.json",
                         "s/zeros.exr: R: found none above 0 in 12 of 12 pixels, expected"},
                        {"stack s/dome.lp --flat s/nan.exr -o s/x.json", "s/nan.exr: R: found"},
                        {"stack s/dome.lp --dark s/nan.exr -o s/x.json", "s/nan.exr: R: found"}});
  EXPECT_FALSE(fs::exists(f / "s/x.json"));
  EXPECT_EQ(gonio(f, "stack s/dome.lp --dark s/zeros.exr -o s/x.json").code, 0);
}

TEST(StackCommand, FindsTheLampsInAMirrorBall) {
  const Folder f;
  fs::create_directories(f / "photos");
  Image i{40, 40, {"Y"}, {std::vector<float>(1600, 0.1F)}, {}};
  i.planes[0][20 * 40 + 28] = 5;  // 8.5 of 20 pixels to the right of the middle
  write_exr(f / "photos/a.exr", i);
  const auto o = gonio(f, "stack photos --ball 20,20.5,20 --linear -o photos/s.json --json");
  ASSERT_EQ(o.code, 3) << o.out;
  expect_one_line(o, 3, "a.exr: ball 20,20.5,20");  // beyond the lower edge
  const auto j = gonio(f, "stack photos --ball 20,20.5,19 -o photos/s.json --json").json();
  const double x = 8.5 / 19;
  EXPECT_NEAR(j["images"][0]["light"][0], 2 * x * std::sqrt(1 - x * x), 1e-9);
  EXPECT_NEAR(j["images"][0]["light"][1], 0, 1e-9);
  expect_one_line(gonio(f, "stack photos --ball 20,20 -o photos/s.json"), 2, "X,Y,RADIUS");
  expect_one_line(gonio(f, "stack photos --ball 20,20,9 --near 3 -o photos/s.json"), 2, "--near");
}

TEST(StackCommand, KeepsTheDarkFrameAndTheWhiteSheetByTheirPaths) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 4,3 --images 4 -o s").code, 0);
  f.write("s/dome.lp", "2\nimage_000.exr 0 0 1\nimage_001.exr 0 1 1\n");
  const std::string both = "stack s/dome.lp --dark s/image_002.exr --flat s/image_003.exr -o ";
  const auto j = gonio(f, both + "s/mine.json --json").json();
  EXPECT_EQ(j["dark"], "image_002.exr");
  EXPECT_EQ(j["flat"], "image_003.exr");
  const std::string flat = read_bytes(f / "s/image_003.exr");
  expect_one_line(gonio(f, both + "s/image_003.exr"), 2, "image_003.exr");
  EXPECT_EQ(read_bytes(f / "s/image_003.exr"), flat);
  fs::create_directories(f / "t");
  expect_one_line(gonio(f, "stack s/dome.lp --dark s/image_002.exr -o t/mine.json"), 3,
                  "below the folder");
  Image small{2, 2, {"R", "G", "B"}, {{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}, {}};
  write_exr(f / "s/small.exr", small);
  expect_one_line(gonio(f, "stack s/dome.lp --dark s/small.exr -o s/mine.json"), 3,
                  "small.exr: size");
}

#ifdef GONIO_TIFF
TEST(StackCommand, TakesPhotographsInTiffWithNumbersFromZeroToOne) {
  const Folder f;
  f.write("photo.tif", tiff_of({}));
  f.write("photo.lp", "1\nphoto.jpg 0 0 1\n");
  // A number of the file itself is 65535 times too large.
  expect_one_line(gonio(f, "stack photo.lp --white 26214 -o x.json"), 2, "over 65535, 0.4");
  EXPECT_EQ(gonio(f, "stack photo.lp --white 0.4 -o x.json --json").json()["saturation"], 1);
  f.write("dark.tif", tiff_of({.bits = 32}));  // whatever the frames are
  EXPECT_EQ(gonio(f, "stack photo.lp --dark dark.tif -o x.json --json").json()["saturation"], 1);
  f.write("photo.tif", tiff_of({.is_line = false}));
  expect_one_line(gonio(f, "stack photo.lp -o y.json"), 3, "photo.tif: TransferFunction");
  EXPECT_EQ(gonio(f, "stack photo.lp --linear -o y.json --json").json()["linear"], true);
}
#endif

TEST(FitMapCommand, TakesTheModelThatPredictsUnseenImagesBest) {
  const Folder f;
  make_stack(f);
  const std::string right = "lambert+ggx/smith_ggx.correlated/schlick",
                    words = "fit_map s/stack.json --models lambert," + right + " -o maps.exr";
  const auto o = gonio(f, words);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("model   " + right + "\nchosen  lambert leaves "), o.out.npos) << o.out;
  const auto j = gonio(f, words + " --json").json();
  EXPECT_EQ(j["model"], right);
  ASSERT_EQ(j["models"].size(), 2U);
  EXPECT_EQ(j["models"][0]["model"], right);
  EXPECT_GT(j["models"][1]["unseen_rms"], 1.5 * j["models"][0]["unseen_rms"].get<double>());
  expect_one_line(gonio(f, "fit_map s/stack.json --models lambert,lambXrt -o m.exr"), 2, "lambXrt");
}

/// The stack with the azimuths of all lights negated.
void negate_lights(const Folder& f) {
  auto j = nlohmann::ordered_json::parse(read_bytes(f / "s/stack.json"));
  for (auto& image : j["images"]) image["phi_i"] = -image["phi_i"].get<double>();
  f.write("s/stack.json", j.dump(2) + "\n");
}

TEST(FitMapCommand, StopsBeforeItFitsDirectionsThatAreNotTheImagesOwn) {
  const Folder f;
  make_stack(f);
  negate_lights(f);
  for (const char* more : {"", " --tile 0,0"}) {
    const auto o = gonio(f, std::string("fit_map s/stack.json -o maps.exr") + more);
    expect_one_line(o, 3, "s/stack.json: directions: ");
    EXPECT_EQ(o.err.find("…"), o.err.npos) << "cut short: " << o.err;
    EXPECT_NE(o.err.find("phi_i becomes −φ"), o.err.npos) << o.err;
    EXPECT_FALSE(fs::exists(f / "maps.exr"));
  }
  const auto o = gonio(f, "fit_map s/stack.json -o maps.exr --as-given --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.json()["warnings"][0].get<std::string>().find("azimuth is negated"), o.out.npos);
}

TEST(FitMapCommand, SaysWhereAnAzimuthCouldNotBeChecked) {
  const Folder f;
  f.write("lamps.csv",
          "theta_i,phi_i,theta_o,phi_o\n10,0,0,0\n20,70,0,0\n30,140,0,0\n40,210,0,0\n50,280,0,0\n"
          "60,350,0,0\n25,60,0,0\n35,130,0,0\n45,200,0,0\n55,270,0,0\n");
  ASSERT_EQ(gonio(f, std::string("synth ") + paint +
                         " --layout map --size 24 --noise 0.01 --directions lamps.csv -o flat/")
                .code,
            0);
  const auto o = gonio(f, "fit_map flat/stack.json -o maps.exr --html m.html");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("azimuth could not be checked on this surface"), o.out.npos) << o.out;
  const std::string page = read_bytes(f / "m.html");
  EXPECT_NE(page.find("azimuth could not be checked on this surface"), page.npos);
  EXPECT_EQ(page.find("no more than noise leaves"), page.npos) << "praise";
  EXPECT_EQ(gonio(f, "fit_map flat/stack.json -o maps.exr --json").json()["azimuth"], "open");
}

TEST(FitMapCommand, EndsWithExitCodeFourWhereMostTexelsDoNotConverge) {
  const Folder f;
  make_stack(f);
  auto j = nlohmann::ordered_json::parse(read_bytes(f / "s/stack.json"));
  while (j["images"].size() > 3) j["images"].erase(3);
  f.write("s/stack.json", j.dump(2) + "\n");
  const auto o = gonio(f, "fit_map s/stack.json -o maps.exr --json");
  const auto ended = o.json()["texels"];
  EXPECT_EQ(o.code == 0, ended["converged"] > ended["not_converged"]) << o.out;
  EXPECT_GE(o.json()["rms"], 0);
}

TEST(FitMapCommand, MakesAPageThatSaysWhereTheModelFits) {
  const Folder f;
  make_stack(f);
  ASSERT_EQ(gonio(f, "fit_map s/stack.json -o maps.exr --html m.html").code, 0);
  const std::string right = read_bytes(f / "m.html");
  for (const char* part : {"kd in colour", "alpha", "misfit", "20 × 12 texels"})
    EXPECT_NE(right.find(part), right.npos) << part;
  EXPECT_NE(right.find("no more than noise leaves"), right.npos);
  ASSERT_EQ(
      gonio(f, "fit_map s/stack.json --model lambert --metric log -o maps.exr --html m.html").code,
      0);
  const std::string wrong = read_bytes(f / "m.html");
  EXPECT_NE(wrong.find("does not fit"), wrong.npos);
  expect_one_line(gonio(f, "fit_map s/stack.json -o maps.exr --html maps.exr"), 2, "maps.exr");
  auto j = nlohmann::ordered_json::parse(read_bytes(f / "s/stack.json"));
  while (j["images"].size() > 3) j["images"].erase(3);
  f.write("s/three.json", j.dump(2) + "\n");
  gonio(f, "fit_map s/three.json -o maps.exr --html m.html");
  EXPECT_NE(read_bytes(f / "m.html").find("is not judged"), std::string::npos);
  expect_one_line(gonio(f, "fit_map s/stack.json --tile 0,0 -o t --html m.html"), 2, "--html");
}

TEST(FitMapCommand, PrintsOneDocumentForJson) {
  const Folder f;
  make_stack(f);
  const auto j = gonio(f, "fit_map s/stack.json " + model + " -o maps.exr --json").json();
  EXPECT_EQ(j["schema"], "gonio.map/1");
  EXPECT_EQ(j["texels"]["converged"], 240);
  EXPECT_EQ(j["options"]["fix"][0]["name"], "f0");
  const auto t =
      gonio(f, "fit_map s/stack.json " + model + " --tile 1,0 --tile-size 16 -o t --json").json();
  EXPECT_EQ(t["tiles"][0], "t/tile_1_0.exr");
  EXPECT_EQ(t["columns"], 2);
}

TEST(FitMapCommand, IsTheSameToTheBitForAnyTilesAndJobs) {
  const Folder f;
  make_stack(f);
  const std::string words = "fit_map s/stack.json " + model + " -o maps.exr";
  ASSERT_EQ(gonio(f, words + " --jobs 1").code, 0);
  const std::string once = map_bytes(f);
  for (const char* how : {" --jobs 3", " --tile-size 8", " --tile-size 20,1 --jobs 2"}) {
    ASSERT_EQ(gonio(f, words + how).code, 0);
    EXPECT_EQ(map_bytes(f), once) << how;
  }
}

TEST(FitMapCommand, GoesOnFromTheTilesOfARunThatWasKilled) {
  const Folder f;
  make_stack(f);
  const std::string words = "fit_map s/stack.json " + model + " --tile-size 10,6 -o maps.exr";
  ASSERT_EQ(gonio(f, words).code, 0);
  const std::string whole = map_bytes(f);
  fs::remove(f / "maps.exr");
  // Killed at any time; nothing of it is there under its name but whole tiles.
  for (const char* time : {"0.02", "0.05", "0.1"})
    gonio(f, words, std::string("timeout -s KILL ") + time + " ");
  const auto o = gonio(f, words);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(map_bytes(f), whole);
  // One tile from before, surely.
  ASSERT_EQ(
      gonio(f, "fit_map s/stack.json " + model + " --tile-size 10,6 --tile 0,1 -o maps.exr.tiles")
          .code,
      0);
  EXPECT_NE(gonio(f, words).out.find("; 1 of 4 tiles kept from before"), std::string::npos);
  EXPECT_EQ(map_bytes(f), whole);
}

TEST(FitMapCommand, RefusesBadInputInOneLine) {
  const Folder f;
  make_stack(f);
  f.write("cut.json", R"({"schema": "gonio.stack/1", "images": [)");
  f.write("below.json",
          R"({"schema": "gonio.stack/1", "images": [{"path": "a", "theta_i": 95, "theta_o": 0}]})");
  f.write("none.json", R"({"schema": "gonio.stack/1", "images": [{"path": "a", "theta_o": 0}]})");
  f.write("gone.json",
          R"({"schema": "gonio.stack/1", "images": [{"path": "a", "theta_i": 0, "theta_o": 0}]})");
  Image small;
  small.width = small.height = 3;
  small.channels = {"B", "G", "R"};
  small.planes.assign(3, std::vector<float>(9, 0.5F));
  write_exr(f / "s/small.exr", small);
  f.write("s/sizes.json", R"({"schema": "gonio.stack/1", "images": [)"
                          R"({"path": "image_000.exr", "theta_i": 0, "theta_o": 0},)"
                          R"({"path": "small.exr", "theta_i": 0, "theta_o": 0}]})");
  expect_one_line_each(
      f, 3,
      {{"fit_map cut.json -o m.exr", "cut.json"},
       {"fit_map below.json -o m.exr", "below.json: /images/0/theta_i: found 95"},
       {"fit_map none.json -o m.exr",
        "expected one of theta_i, light, light_map or light_position"},
       {"fit_map gone.json -o m.exr", "a: opening"},
       {"fit_map s/sizes.json -o m.exr", "small.exr: size: found 3 × 3, expected 20 × 12"},
       {"fit_map nothing.json -o m.exr", "nothing.json"},
       {"fit_map s/image_000.exr -o m.exr", "image_000.exr"},
       {"fit_map s/stack.json -o nowhere/m.exr", "nowhere/m.exr: writing"},
       {"fit_map s/stack.json -o s", "s: writing: found a directory"},
       {"fit_map s/stack.json --tile 0,0 -o s/stack.json/t", "s/stack.json/t"}});
  EXPECT_FALSE(fs::exists(f / "m.exr"));
  EXPECT_FALSE(fs::exists(f / "m.exr.tiles"));
}

TEST(FitMapCommand, RefusesWrongWordsInOneLine) {
  const Folder f;
  make_stack(f);
  expect_one_line_each(f, 2,
                       {{"fit_map s/stack.json", "--output"},
                        {"fit_map s/stack.json --model nonsense -o m.exr", "nonsense"},
                        {"fit_map s/stack.json --fix beta=3 -o m.exr", "beta"},
                        {"fit_map s/stack.json --tile 1 -o t", "--tile 1"},
                        {"fit_map s/stack.json --tile 1,0 -o t", "0,0 to 0,0"},
                        {"fit_map s/stack.json --tile-size 0 -o m.exr", "--tile-size 0"},
                        {"fit_map s/stack.json --tile-size 8,x -o m.exr", "--tile-size 8,x"},
                        {"fit_map s/stack.json -o s/stack.json", "would be overwritten"},
                        {"fit_map s/stack.json --metric vague -o m.exr", "vague"},
                        {"fit_map s/stack.json --offset 0.1 -o m.exr", "not with l2_cosine"},
                        {"fit_map s/stack.json --model lambert --refine-normals -o m.exr",
                         "values f_r_cosine show it"}});
}

TEST(FitMapCommand, OverwritesNothingThatItReads) {
  const Folder f;
  make_stack(f);
  const std::string image = read_bytes(f / "s/image_000.exr");
  ASSERT_EQ(gonio(f, "fit_map s/stack.json --tile 0,0 -o t " + model).code, 0);
  const std::string tile = read_bytes(f / "t/tile_0_0.exr");
  expect_one_line_each(f, 2,
                       {{"fit_map s/stack.json -o s/stack.json", "is an input"},
                        {"fit_map s/stack.json -o ./s/../s/image_000.exr", "is an input"},
                        {"fit_map s/stack.json -o s/parameters.exr", "is an input"},
                        {"gather t -o t/../t/tile_0_0.exr", "is an input"}});
  EXPECT_EQ(read_bytes(f / "s/image_000.exr"), image);
  EXPECT_EQ(read_bytes(f / "t/tile_0_0.exr"), tile);
}

TEST(FitMapCommand, TakesNoTileAwayThatIsAnInput) {
  const Folder f;
  make_stack(f);
  fs::create_directory(f / "s/m.exr.tiles");
  std::string stack = read_bytes(f / "s/stack.json");
  for (int k = 0; k < 2; ++k) {
    const std::string image = fmt::format("image_00{}.exr", k),
                      tile = fmt::format("m.exr.tiles/tile_{}_0.exr", k);
    fs::rename(f / ("s/" + image), f / ("s/" + tile));
    stack.replace(stack.find(image), image.size(), tile);
  }
  f.write("s/stack.json", stack);
  expect_one_line(gonio(f, "fit_map s/stack.json -o s/m.exr " + model), 2, "is an input");
  for (int k = 0; k < 2; ++k)
    EXPECT_TRUE(fs::exists(f / fmt::format("s/m.exr.tiles/tile_{}_0.exr", k))) << k;
}

TEST(FitMapCommand, TakesNoImageAwayThatGonioDidNotMake) {
  const Folder f;
  make_stack(f);
  fs::create_directory(f / "m.exr.tiles");
  fs::copy_file(f / "s/image_000.exr", f / "m.exr.tiles/tile_7_7.exr");
  expect_one_line(gonio(f, "fit_map s/stack.json -o m.exr " + model), 3,
                  "m.exr.tiles/tile_7_7.exr: header: found no tile of a map");
  EXPECT_TRUE(fs::exists(f / "m.exr.tiles/tile_7_7.exr"));
}

TEST(FitMapCommand, RefusesTilesOfOtherOptionsAndKeepsThem) {
  const Folder f;
  make_stack(f);
  const std::string tile = "fit_map s/stack.json --tile 0,0 -o t ";
  ASSERT_EQ(gonio(f, tile + model).code, 0);
  const std::string before = read_bytes(f / "t/tile_0_0.exr");
  const auto o = gonio(f, tile + "--fix f0=0.04");
  expect_one_line(o, 3, "t/tile_0_0.exr: gonio:options: found …");
  const auto expected = o.err.find(", expected …");
  EXPECT_LT(o.err.find("\"values\":0.05"), expected) << "what differs: " << o.err;
  EXPECT_NE(o.err.find("\"values\":0.04", expected), o.err.npos) << o.err;
  EXPECT_EQ(read_bytes(f / "t/tile_0_0.exr"), before);
  expect_one_line(gonio(f, "fit_map s/stack.json --tile 1,0 --tile-size 16 -o t"), 3, "tile_0_0");
  EXPECT_FALSE(fs::exists(f / "t/tile_1_0.exr")) << "not beside tiles of another map";
}

TEST(FitMapCommand, LosesNothingWhereItCannotWrite) {
  const Folder f;
  make_stack(f);
  const std::string words = "fit_map s/stack.json " + model + " -o maps.exr";
  ASSERT_EQ(gonio(f, words).code, 0);
  const std::string whole = map_bytes(f);
  expect_one_line(gonio(f, words + " --tile-size 8", "ulimit -f 1; "), 3, "writing");
  EXPECT_EQ(map_bytes(f), whole) << "that of before";
}

/// Of a stack of 3.2 GB, no more than a part is in memory.
TEST(FitMapCommand, NeedsMemoryForATileAndNotForTheStack) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take the address space for themselves";
#endif
  const Folder f;
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (4096, 4096, 3), }";
  std::string images;
  for (int i = 0; i < 16; ++i) {
    const std::string name = "image_" + std::to_string(i) + ".npy";
    f.write(name,
            std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header);
    fs::resize_file(f / name, 10 + header.size() + std::uintmax_t{4096} * 4096 * 3 * 4);  // holes
    images += std::string(i ? "," : "") + R"({"path": ")" + name + R"(", "theta_i": )" +
              std::to_string(5 * i) + R"(, "theta_o": 10})";
  }
  f.write("stack.json", R"({"schema": "gonio.stack/1", "images": [)" + images + "]}");
  const std::string limit = "ulimit -v 1000000; ";  // kB: a third of the stack
  const auto o =
      gonio(f, "fit_map stack.json --model lambert --tile 3,2 --tile-size 64 -o t", limit);
  EXPECT_TRUE(o.code == 0) << o.err;
  EXPECT_TRUE(fs::exists(f / "t/tile_3_2.exr"));
}

TEST(FitMapCommand, BeginsAnewWhereARefusedOrOtherRunLeftTiles) {
  const Folder f;
  make_stack(f);
  ASSERT_EQ(gonio(f, "fit_map s/stack.json " + model + " -o whole.exr").code, 0);
  ASSERT_EQ(gonio(f,
                  "fit_map s/stack.json --model lambert --tile-size 4 --tile 0,0 --tile 1,0 "
                  "-o m.exr.tiles")
                .code,
            0);
  const auto o = gonio(f, "fit_map s/stack.json " + model + " -o m.exr");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(read_bytes(f / "m.exr"), read_bytes(f / "whole.exr"));
  EXPECT_FALSE(fs::exists(f / "m.exr.tiles"));
}

TEST(FitMapCommand, OfTwoRunsOnOneMapBothSucceedOrOneSaysSoBeforeItWorks) {
  const Folder f;
  make_stack(f);
  f.write("two", "a() { " + program() + " fit_map s/stack.json " + model +
                     " --tile-size 1 -o m.exr >o$1 2>e$1; echo $? >c$1; }\na 1 & a 2 & wait\n");
  for (int round = 0; round < 4; ++round) {
    ASSERT_EQ(std::system(("cd '" + f / "" + "' && bash two").c_str()), 0);
    int done = 0;
    for (const char* k : {"1", "2"}) {
      const std::string code = read_bytes(f / (std::string("c") + k)),
                        said = read_bytes(f / (std::string("e") + k));
      done += code == "0\n";
      EXPECT_TRUE(code == "0\n" || said.find("another run") != said.npos) << said;
    }
    EXPECT_GE(done, 1);
    EXPECT_FALSE(fs::exists(f / "m.exr.tiles"));
    fs::remove(f / "m.exr");
  }
}

}  // namespace
}  // namespace gonio::test
