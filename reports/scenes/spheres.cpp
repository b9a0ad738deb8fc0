// Small pictures of a sphere: with all effects, and as planned.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/base64.h"
#include "image/display.h"
#include "image/png.h"
#include "reports/scenes/measure.h"
#include "scene/render/render.h"
#include "scene/trace/camera.h"

namespace gonio::scenes {
namespace {

using namespace scene;

/// PNG of what a display shows, in base64.
std::string shown(const Picture& p, double exposure) {
  PngImage image{p.width, p.height, {}, {}};
  for (const auto& radiance : p.radiance)
    image.pixels.push_back(displayed_bytes(radiance, exposure));
  return base64(png_bytes(image));
}

/// True of a pixel whose middle shows an object.
bool shows_object(const Lit& lit, std::size_t x, std::size_t y, std::size_t pixels) {
  const auto at = [&](std::size_t i) {
    return (static_cast<double>(i) + 0.5) / static_cast<double>(pixels);
  };
  const Ray r = ray(middle_camera(lit.scene.view), at(x), at(y), 1);
  return lit.tracer.closest(r.origin, r.direction).has_value();
}

}  // namespace

page::DifferenceScale difference_scale(const Tolerance& t) {
  if (t.metric == Metric::relative) return {steps_of_difference, 1, 4, false};
  return {steps_of_difference, t.limit, t.max, false};
}

ScenePicture picture_of(const Lit& lit,
                        std::span<const Forms> planned,
                        std::size_t pixels,
                        std::size_t samples) {
  constexpr double most = 254, none = 255;
  const RenderOptions options{pixels, pixels, samples, lit.scene.seed};
  std::vector<Shown> exact, dropped;
  for (std::size_t k = 0; k < lit.looks.size(); ++k) {
    exact.emplace_back(lit.looks[k], lit.looks[k].exact());
    dropped.emplace_back(lit.looks[k], planned[k]);
  }
  const Picture all = render(lit.scene, exact, options), some = render(lit.scene, dropped, options);
  const auto apart =
      differences(Metric::delta_e_2000, lit.scene.exposure, all.radiance, some.radiance);
  ScenePicture p;
  p.pixels = pixels;
  p.everything = shown(all, lit.scene.exposure);
  p.planned = shown(some, lit.scene.exposure);
  std::string bytes;
  for (std::size_t i = 0; i < apart.size(); ++i) {
    const bool object = shows_object(lit, i % pixels, i / pixels, pixels);
    const double byte = object ? std::min(steps_of_difference * apart[i], most) : none;
    bytes += static_cast<char>(static_cast<unsigned char>(std::lround(byte)));
    if (object) p.worst = std::max(p.worst, apart[i]);
  }
  p.difference = base64(bytes);
  return p;
}

}  // namespace gonio::scenes
