// gonio render: what it writes and what it refuses.
#include <filesystem>
#include <fstream>

#include "cli/program.h"
#include "image/display.h"
#include "image/exr.h"
#include "png_pixels.h"
#include "scene/description/scene_example.h"

namespace gonio::test {
namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}
/// A golden sphere under a rectangle and a lamp, quickly planned; of the other materials there is no object.
nlohmann::json golden_sphere() {
  auto s = nlohmann::json(scene::test::example());
  s["objects"] = {{{"shape", "sphere"}, {"material", "satin gold"}, {"center", {0, 1, 0}}}};
  s["lights"].erase(1);
  s["view"]["orbit"]["distance"] = 4;
  s.erase("budget_ns");  // no time of this machine decides
  s["tolerance"] = {{"metric", "delta_e_2000"}, {"quantile", 0.5}, {"limit", 1.5}, {"max", 90}};
  return s;
}
struct SceneFolder : Folder {
  SceneFolder() { write(*this / "scene.json", golden_sphere().dump()); }
};
const std::string words = "render scene.json --width 40 --height 20 --samples 2 ";

TEST(RenderCommand, WritesLinearRadianceAndWhatItWasMadeWith) {
  const SceneFolder f;
  const auto j = gonio(f, words + "-o a.exr --seed 5 --json").json();
  EXPECT_EQ(j["seed"], 5);
  const Image image = read_exr(f / "a.exr");
  EXPECT_EQ(image.width, 40U);
  EXPECT_EQ(image.height, 20U);
  EXPECT_EQ(image.attributes.at("gonio:seed"), "5");
  EXPECT_EQ(image.attributes.at("gonio:samples"), "2");
  EXPECT_EQ(image.attributes.at("gonio:exposure"), "0.5");
  EXPECT_EQ(image.attributes.at("gonio:scene_sha256"), j["scene_sha256"]);
  double sum = 0;  // channels come sorted: B, G, R
  for (const float v : image.planes[1]) sum += double{v} / 800;
  EXPECT_GT(sum, 0.01);
  EXPECT_NEAR(sum, j["mean_radiance"][1], 1e-6);
}

TEST(RenderCommand, WritesAPngThatSaysHowItIsToned) {
  const SceneFolder f;
  EXPECT_EQ(gonio(f, words + "-o a.png").code, 0);
  const auto bytes = read_bytes(f / "a.png");
  EXPECT_NE(bytes.find(std::string("tone_map\0exposed, clipped, sRGB", 31)), bytes.npos);
  EXPECT_EQ(gonio(f, words + "-o b.png --jobs 1").code, 0);
  EXPECT_EQ(read_bytes(f / "b.png"), bytes);
  EXPECT_EQ(gonio(f, words + "-o b.png --seed 8").code, 0);
  EXPECT_NE(read_bytes(f / "b.png"), bytes);
}

TEST(RenderCommand, LaysAPlanBesideAllEffects) {
  const SceneFolder f;
  ASSERT_EQ(gonio(f, "plan scene.json -o plan.json --samples 512 --cost operations --quiet").code,
            0);
  const auto j = gonio(f, words + "--plan plan.json -o a.exr --json").json();
  const Image image = read_exr(f / "a.exr");
  ASSERT_EQ(image.channels, (std::vector<std::string>{"B", "G", "R", "delta_e_2000", "planned.B",
                                                      "planned.G", "planned.R"}));
  float most = 0;
  for (const float v : image.planes[3]) most = std::max(most, v);
  EXPECT_FLOAT_EQ(most, j["delta_e_2000"]["max"].get<float>());
  EXPECT_GT(most, 0);
  EXPECT_NE(image.planes[1], image.planes[5]);
  EXPECT_EQ(gonio(f, words + "--plan plan.json -o a.png").code, 0);
  const auto bytes = read_bytes(f / "a.png");
  EXPECT_EQ(bytes.substr(16, 8), (std::string{0, 0, 0, 120, 0, 0, 0, 20}));  // three panels
  const auto pixels = png_pixels(bytes).pixels;
  std::size_t red = 0, grey = 0;
  for (std::size_t y = 0; y < 20; ++y)
    for (std::size_t x = 0; x < 40; ++x) {
      const float d = image.planes[3][y * 40 + x] / 1.5F;  // of the limit
      const auto& shown = pixels[y * 120 + 80 + x];
      (d > 1 ? red : grey) += d > 0 ? 1 : 0;
      EXPECT_EQ(shown[1], shown[2]);
      EXPECT_NEAR(shown[1], d > 1 ? 0 : 255 * d, 0.51);
      EXPECT_EQ(shown[0], d > 1 ? 255 : shown[1]);
      for (std::size_t panel = 0; panel < 2; ++panel) {  // G, exposed by a half
        const float g = image.planes[panel == 0 ? 1 : 5][y * 40 + x] / 2;
        EXPECT_EQ(pixels[y * 120 + panel * 40 + x][1], srgb_byte(double{g}));
      }
    }
  EXPECT_GT(red, 0U);
  EXPECT_GT(grey, 20U);
  // all effects alone are the same picture as beside a plan
  EXPECT_EQ(gonio(f, words + "-o b.exr").code, 0);
  EXPECT_EQ(read_exr(f / "b.exr").planes[1], image.planes[1]);
}

TEST(RenderCommand, RefusesAndWritesNothing) {
  const SceneFolder f;
  write(f / "bad.json", "{");
  write(f / "other.json", golden_sphere().dump(1));
  ASSERT_EQ(gonio(f, "plan other.json -o other_plan.json --samples 512 --quiet").code, 0);
  expect_one_line_each(f, 2,
                       {{"render scene.json -o a.jpg", ".exr or .png"},
                        {"render scene.json -o a.png --width 5000", "--width"},
                        {"render scene.json", "--output"},
                        {"render scene.json --plan bad.json -o bad.json", ".exr or .png"}});
  expect_one_line_each(f, 3,
                       {{"render none.json -o a.png", "none.json"},
                        {"render bad.json -o a.png", "bad.json"},
                        {"render scene.json --plan bad.json -o a.png", "bad.json"},
                        {"render scene.json --plan other_plan.json -o a.png", "sha256"}});
  EXPECT_FALSE(std::filesystem::exists(f / "a.png"));
}

}  // namespace
}  // namespace gonio::test
