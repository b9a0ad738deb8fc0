// Links and documents of strangers where results go: no file of the user's is written through one,
// none takes another's name.
#include "cli/program.h"
#include "foreign/compile.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

/// Links of those names, each to a file beside the folder that says whose it is.
void plant(const Folder& f, const std::string& folder, const std::vector<std::string>& names) {
  fs::create_directories(f / folder);
  for (const auto& name : names) {
    f.write("mine." + name, "mine");
    fs::create_symlink("../mine." + name, f / (folder + "/" + name));
  }
}
/// They were replaced, and what they led to is as it was.
void expect_replaced(const Folder& f,
                     const std::string& folder,
                     const std::vector<std::string>& names) {
  for (const auto& name : names) {
    EXPECT_EQ(read_bytes(f / ("mine." + name)), "mine") << name;
    const auto there = fs::symlink_status(f / (folder + "/" + name));
    EXPECT_TRUE(fs::is_regular_file(there)) << name;
  }
}

TEST(Links, AreReplacedByImagesOfASynthesizedStackAndByTexturesOfAMap) {
  const Folder f;
  const std::vector<std::string> images{"image_000.exr", "parameters.exr", "stack.json"};
  plant(f, "s", images);
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 8 --images 12 -o s").code, 0);
  expect_replaced(f, "s", images);
  ASSERT_EQ(gonio(f, "fit_map s/stack.json -o m.exr --fix f0=0.05").code, 0);
  const std::vector<std::string> textures{"m.mtlx_color.png", "m.mtlx_highlight.png",
                                          "m.mtlx_roughness_metal.png"};
  plant(f, "e", textures);
  ASSERT_EQ(gonio(f, "export m.exr --to open_pbr -o e/m.mtlx").code, 0);
  expect_replaced(f, "e", textures);
}

TEST(Links, AreReplacedByFilesOfAReport) {
  const Folder f;
  const std::vector<std::string> names{"diffuse.json", "diffuse.html", "diffuse.csv"};
  plant(f, "r", names);
  ASSERT_EQ(gonio(f, "report diffuse --quick --pictures first -o r").code, 0);
  expect_replaced(f, "r", names);
  fs::remove_all(f / "r/diffuse");
  fs::create_directory(f / "elsewhere");
  fs::create_symlink("../elsewhere", f / "r/diffuse");
  expect_one_line(gonio(f, "report diffuse --quick -o r"), 3, "r/diffuse: writing: found a link");
  EXPECT_TRUE(fs::is_empty(f / "elsewhere"));
}

TEST(Links, AreReplacedByWhatStandsBesideAResult) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout random -o t.csv").code, 0);
  plant(f, "p", {"t.page.json"});
  ASSERT_EQ(gonio(f, "inspect t.csv --html p/t.html").code, 0);
  expect_replaced(f, "p", {"t.page.json"});

  plant(f, "c", {"t.csv.gonio.json"});
  const std::string side = read_bytes(f / "t.csv.gonio.json");
  f.write("mine.t.csv.gonio.json", side);
  ASSERT_EQ(gonio(f, "convert t.csv c/t.csv").code, 0);
  EXPECT_EQ(read_bytes(f / "mine.t.csv.gonio.json"), side) << "of another table";

  f.write("scene.json", R"({"schema": "gonio.scene/1",
    "materials": {"chalk": {"model": "lambert"}},
    "objects": [{"shape": "sphere", "material": "chalk"}],
    "lights": [{"type": "directional", "direction": [0, 0.6, 0.8], "irradiance": [1, 1, 1]}],
    "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 14},
    "tolerance": {"metric": "delta_e_2000", "limit": 1, "max": 4}})");
  plant(f, "plan", {"p.mtlx"});
  ASSERT_EQ(gonio(f, "plan scene.json --samples 512 --write mtlx -o plan/p.json").code, 0);
  expect_replaced(f, "plan", {"p.mtlx"});
}

TEST(Links, AreReplacedByTiles) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 8 --images 12 -o s").code, 0);
  fs::create_directory(f / "t");
  fs::create_symlink("../nothing", f / "t/tile_0_0.exr");
  ASSERT_EQ(gonio(f, "fit_map s/stack.json --tile 0,0 -o t --fix f0=0.05").code, 0);
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(f / "t/tile_0_0.exr")));
  EXPECT_FALSE(fs::exists(f / "nothing"));
}

TEST(Links, OfTheUsersOwnAreFollowed) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout random -o t.csv").code, 0);
  fs::create_directory(f / "there");
  fs::create_symlink("there/page.html", f / "p.html");
  ASSERT_EQ(gonio(f, "inspect t.csv --html p.html").code, 0);
  EXPECT_TRUE(fs::is_symlink(f / "p.html"));
  EXPECT_TRUE(fs::exists(f / "there/page.html"));
}

TEST(Outputs, ThatADocumentReadsAreWrongUsageWhicheverDocumentNamesThem) {
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders";
  const Folder f;
  const std::string shader =
      "// kd 0 1 0.5\nfloat mine(float NoL, float NoV, float kd) { return kd / 3.14159265; }\n";
  f.write("m.glsl", shader);
  ASSERT_EQ(gonio(f, "synth lambert --set kd=0.3 --layout random -o t.csv").code, 0);
  ASSERT_EQ(gonio(f, "fit t.csv --model m.glsl:mine -o fit.json").code, 0);
  const std::string rest =
      R"("objects": [{"shape": "sphere", "material": "a"}],
    "lights": [{"type": "directional", "direction": [0, 0.6, 0.8], "irradiance": [1, 1, 1]}],
    "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 14},
    "tolerance": {"metric": "delta_e_2000", "limit": 1, "max": 4}})";
  f.write("scene.json",
          R"({"schema": "gonio.scene/1", "materials": {"a": {"fit": "fit.json"}},)" + rest);
  f.write("own.json",
          R"({"schema": "gonio.scene/1", "materials": {"a": {"model": "m.glsl:mine"}},)" + rest);
  f.write("choice.json", R"({"schema": "gonio.choice/1", "model": "m.glsl:mine",
    "reference": "lambert", "parameters": {"kd": 0.3}, "domain": {"mu": [0.1, 1]},
    "budgets": {"nonfinite": 0}})");
  for (const char* words :
       {"export fit.json --to gltf -o m.glsl", "shader fit.json --language glsl -o m.glsl",
        "eval fit.json --directions t.csv -o m.glsl", "explore fit.json -o m.glsl",
        "synth fit.json --layout random -o m.glsl", "plan scene.json -o m.glsl",
        "plan own.json -o m.glsl", "validate choice.json -o m.glsl",
        "fit t.csv --model m.glsl:mine -o m.glsl"}) {
    SCOPED_TRACE(words);
    expect_one_line(gonio(f, words), 2, "m.glsl is an input; it would be overwritten");
    EXPECT_EQ(read_bytes(f / "m.glsl"), shader);
  }
}

}  // namespace
}  // namespace gonio::test
