// gonio render: a scene as a picture.
#include "scene/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/file.h"
#include "base/quantile.h"
#include "base/sha256.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "image/display.h"
#include "image/exr.h"
#include "image/png.h"
#include "scene/plan/difference.h"
#include "scene/plan/document.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using namespace scene;
using Json = nlohmann::ordered_json;

struct RenderCall : Common {
  std::string scene, plan, out;
  RenderOptions picture;
  std::optional<std::uint64_t> seed;
};

/// Name and value of what a picture was made with.
using Notes = std::vector<std::pair<std::string, std::string>>;

/// Every effect in its exact form, and where there is a plan its forms beside, of the same samples.
struct Pictures {
  Picture exact;
  std::optional<Picture> planned;
  std::vector<double> difference;  ///< of each pixel [CIEDE2000]
  double white = 1;                ///< difference that is shown white

  std::size_t width() const { return exact.width * (planned ? 3 : 1); }
};

std::string exr_of(const std::string& path, const Pictures& p, const Notes& notes) {
  Image image{p.exact.width, p.exact.height, {}, {}, {}};
  const auto add = [&](const std::string& name, const auto& values, const auto& value_of_pixel) {
    image.channels.push_back(name);
    auto& plane = image.planes.emplace_back();
    for (const auto& v : values) plane.push_back(static_cast<float>(value_of_pixel(v)));
  };
  const auto add_picture = [&](const std::string& layer, const Picture& picture) {
    constexpr std::array channels{"R", "G", "B"};
    for (std::size_t c = 0; c < channels.size(); ++c)
      add(layer + channels[c], picture.radiance, [c](const Rgb& v) { return v[c]; });
  };
  add_picture("", p.exact);
  if (p.planned) {
    add_picture("planned.", *p.planned);
    add("delta_e_2000", p.difference, [](double v) { return v; });
  }
  for (const auto& [name, value] : notes) image.attributes["gonio:" + name] = value;
  return exr_bytes(path, image);
}

std::string png_of(const Pictures& p, double exposure, Notes notes) {
  PngImage image{p.width(), p.exact.height, {}, {{"Software", "gonio render"}}};
  const std::size_t width = p.exact.width;
  const auto add = [&](const Rgb& c) {
    image.pixels.push_back({srgb_byte(c[0]), srgb_byte(c[1]), srgb_byte(c[2])});
  };
  const auto add_row = [&](std::size_t y, const Picture& picture) {
    for (std::size_t x = 0; x < width; ++x)
      add(displayed(picture.radiance[y * width + x], exposure));
  };
  for (std::size_t y = 0; y < p.exact.height; ++y) {
    add_row(y, p.exact);
    if (!p.planned) continue;
    add_row(y, *p.planned);
    for (std::size_t x = 0; x < width; ++x) {
      const double part = p.difference[y * width + x] / p.white;
      const auto grey = static_cast<unsigned char>(std::lround(255 * std::min(part, 1.0)));
      image.pixels.push_back(part > 1 ? std::array<unsigned char, 3>{255, 0, 0}
                                      : std::array{grey, grey, grey});
    }
  }
  notes.emplace_back("tone_map", "exposed, clipped, sRGB");
  if (p.planned) {
    notes.emplace_back("panels", "all effects, planned, difference");
    notes.emplace_back("difference", fmt::format("CIEDE2000, white at {}, red beyond", p.white));
  }
  for (auto& note : notes) image.text.push_back(std::move(note));
  return png_bytes(image);
}

Pictures pictures_of(const Scene& scene, const RenderCall& o) {
  const auto looks = looks_of(scene);
  std::optional<PlannedForms> plan;
  if (!o.plan.empty()) plan = read_plan(o.plan, scene, looks);
  constexpr std::size_t steps = 100;
  TimedProgress progress(o.quiet, "rendering", plan ? 2 * steps : steps);
  std::size_t before = 0;
  const auto picture = [&](const auto& forms_of_material) {
    std::vector<Shown> shown;
    for (std::size_t k = 0; k < looks.size(); ++k)
      shown.emplace_back(looks[k], forms_of_material(k));
    auto made = render(scene, shown, o.picture, [&](std::size_t done, std::size_t all) {
      const auto step = [&](std::size_t n) { return before + n * steps / all; };
      if (step(done) != step(done - 1)) progress(step(done));
    });
    before += steps;
    return made;
  };
  Pictures p{picture([&](std::size_t k) { return looks[k].exact(); }), {}, {}};
  if (plan) {
    p.planned =
        picture([&](std::size_t k) { return plan->by_material[k].value_or(looks[k].exact()); });
    p.difference =
        differences(Metric::delta_e_2000, scene.exposure, p.exact.radiance, p.planned->radiance);
    if (scene.tolerance.metric == Metric::delta_e_2000 && scene.tolerance.limit > 0)
      p.white = scene.tolerance.limit;
  }
  progress.clear();
  return p;
}

Exit run(const RenderCall& given) {
  RenderCall o = given;
  const auto kind = std::filesystem::path(o.out).extension();
  if (kind != ".exr" && kind != ".png")
    throw wrong_usage(fmt::format("-o {}: a picture's name ends in .exr or .png", o.out));
  use(o);
  std::vector<std::string> inputs{o.scene};
  if (!o.plan.empty()) inputs.push_back(o.plan);
  check_outputs(inputs, {o.out});
  OutputFile out(o.out);
  const Stopwatch begin;
  const Scene scene = read_scene(o.scene);
  o.picture.seed = o.seed.value_or(scene.seed);
  const Pictures p = pictures_of(scene, o);
  Notes notes{{"scene_sha256", scene.sha256},
              {"exposure", fmt::format("{}", scene.exposure)},
              {"samples", fmt::format("{}", o.picture.samples)},
              {"seed", fmt::format("{}", o.picture.seed)}};
  if (p.planned) notes.emplace_back("plan_sha256", sha256_of_file(o.plan));
  out.write(kind == ".exr" ? exr_of(o.out, p, notes) : png_of(p, scene.exposure, notes));
  out.commit();
  const double seconds = begin.seconds();

  auto differences = p.difference;
  const double high = p.planned ? quantile(differences, 0.99) : 0;
  const double worst = p.planned ? std::ranges::max(differences) : 0;
  if (!o.json) {
    say("{}: {} × {}, {} samples a pixel, {:.1f} s\n", o.out, p.exact.width, p.exact.height,
        o.picture.samples, seconds);
    if (p.planned)
      say("the plan differs by ΔE2000 {:.2g} in 99 % of the pixels or less, {:.2g} at most\n", high,
          worst);
    return Exit::done;
  }
  Rgb mean{};
  for (const auto& v : p.exact.radiance)
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += v[c] / static_cast<double>(p.exact.radiance.size());
  Json document{{"output", o.out},
                {"scene_sha256", scene.sha256},
                {"width", p.exact.width},
                {"height", p.exact.height},
                {"samples", o.picture.samples},
                {"seed", o.picture.seed},
                {"exposure", scene.exposure},
                {"mean_radiance", mean}};
  if (p.planned) document["delta_e_2000"] = {{"p99", high}, {"max", worst}};
  document["time_ms"] = 1000 * seconds;
  print_document(document);
  return Exit::done;
}

}  // namespace

void add_render(CommandLine& line) {
  constexpr std::size_t most = 4096;
  auto [c, o] = line.command<RenderCall>(
      "render", "Makes a picture of a scene, with a plan also what that leaves and the difference",
      "gonio render scene.json --plan plan.json -o both.png", run);
  c.option("SCENE", o->scene, "Scene, gonio.scene/1").required();
  c.option("--plan", o->plan, "Plan of that scene, gonio.plan/2");
  c.option("-o,--output", o->out,
           "Picture: .exr of linear radiance, a plan's in layers; or .png of what a display shows, "
           "a plan's "
           "beside it and the difference CIEDE2000, white at the tolerance's limit and red beyond")
      .required();
  c.option("--width", o->picture.width, "Pixels across").in(std::size_t{1}, most).show_default();
  c.option("--height", o->picture.height, "Pixels down").in(std::size_t{1}, most).show_default();
  c.option("--samples", o->picture.samples, "Samples of a pixel")
      .in(std::size_t{1}, std::size_t{1} << 20)
      .show_default();
  c.option("--seed", o->seed, "Seed of the samples (the scene's)");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
