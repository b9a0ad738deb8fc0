// gonio render: a scene as a picture.
#include "scene/render/render.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>

#include "base/file.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "image/display.h"
#include "image/exr.h"
#include "image/png.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using namespace scene;
using Json = nlohmann::ordered_json;

struct Options : Common {
  std::string scene, out;
  RenderOptions picture;
  std::optional<std::uint64_t> seed;
};

/// Name and value of what a picture was made with.
using Notes = std::vector<std::pair<std::string, std::string>>;

Notes notes_of(const Scene& scene, const RenderOptions& o) {
  return {{"scene_sha256", scene.sha256},
          {"exposure", fmt::format("{}", scene.exposure)},
          {"samples", fmt::format("{}", o.samples)},
          {"seed", fmt::format("{}", o.seed)}};
}

std::string exr_of(const std::string& path, const Picture& p, const Notes& notes) {
  Image image{p.width, p.height, {"R", "G", "B"}, {}, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    auto& plane = image.planes.emplace_back();
    for (const auto& v : p.radiance) plane.push_back(v[c]);
  }
  for (const auto& [name, value] : notes) image.attributes["gonio:" + name] = value;
  return exr_bytes(path, image);
}

std::string png_of(const Picture& p, double exposure, Notes notes) {
  PngImage image{p.width, p.height, {}, {{"Software", "gonio render"}}};
  for (const auto& v : p.radiance) {
    const Rgb c = displayed({double{v[0]}, double{v[1]}, double{v[2]}}, exposure);
    image.pixels.push_back({srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2])});
  }
  notes.insert(notes.begin(), {"tone_map", "exposed, clipped, sRGB"});
  for (auto& note : notes) image.text.push_back(std::move(note));
  return png_bytes(image);
}

Exit run(const Options& given) {
  Options o = given;
  const auto kind = std::filesystem::path(o.out).extension();
  if (kind != ".exr" && kind != ".png")
    throw wrong_usage(fmt::format("-o {}: a picture's name ends in .exr or .png", o.out));
  use_jobs(o.jobs);
  check_outputs({o.scene}, {o.out});
  OutputFile out(o.out);
  const auto begin = std::chrono::steady_clock::now();
  const Scene scene = read_scene(o.scene);
  o.picture.seed = o.seed.value_or(scene.seed);
  std::vector<Shown> shown;
  for (const auto& m : scene.materials) {
    const Look look(m);
    shown.emplace_back(look, look.exact());
  }
  std::optional<TimedProgress> progress;
  const Picture picture = render(scene, shown, o.picture, [&](std::size_t done, std::size_t all) {
    if (!progress) progress.emplace(o.quiet || o.json, "rendering", 100);
    if (done * 100 / all != (done - 1) * 100 / all) (*progress)(done * 100 / all);
  });
  progress.reset();
  const auto notes = notes_of(scene, o.picture);
  out.write(kind == ".exr" ? exr_of(o.out, picture, notes)
                           : png_of(picture, scene.exposure, notes));
  out.commit();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!o.json) {
    say("{}: {} × {}, {} samples a pixel, {:.1f} s\n", o.out, picture.width, picture.height,
        o.picture.samples, seconds);
    return Exit::done;
  }
  Rgb mean{};
  for (const auto& v : picture.radiance)
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += double{v[c]} / static_cast<double>(picture.radiance.size());
  print_document(Json{{"output", o.out},
                      {"scene_sha256", scene.sha256},
                      {"width", picture.width},
                      {"height", picture.height},
                      {"samples", o.picture.samples},
                      {"seed", o.picture.seed},
                      {"exposure", scene.exposure},
                      {"mean_radiance", mean},
                      {"time_ms", 1000 * seconds}});
  return Exit::done;
}

}  // namespace

void add_render(CommandLine& line) {
  constexpr std::size_t most = 4096;
  auto [c, o] = line.command("render",
                             "Makes a picture of a scene, every effect in its exact form: linear "
                             "radiance as OpenEXR, or as "
                             "PNG what a display shows of it (exposed, clipped, sRGB), from the "
                             "middle of the scene's views",
                             "gonio render scene.json -o scene.png", run);
  c.option("SCENE", o->scene, "Scene, gonio.scene/1").required();
  c.option("-o,--output", o->out, "Picture: .exr or .png").required();
  c.option("--width", o->picture.width, "Pixels across").in(std::size_t{1}, most).show_default();
  c.option("--height", o->picture.height, "Pixels down").in(std::size_t{1}, most).show_default();
  c.option("--samples", o->picture.samples, "Samples of a pixel")
      .in(std::size_t{1}, std::size_t{1} << 20)
      .show_default();
  add_seed(c, o->seed, "Seed of the samples (the scene's)");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
