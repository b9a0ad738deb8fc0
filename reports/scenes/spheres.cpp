// Small pictures of a sphere: with all effects, and as planned.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/base64.h"
#include "geometry/half_vector.h"
#include "image/display.h"
#include "reports/scenes/measure.h"
#include "scene/trace/camera.h"

#include <tbb/parallel_for.h>

namespace gonio::scenes {
namespace {

using namespace scene;

constexpr std::size_t across = 3;        ///< looks into a pixel, each way
constexpr std::size_t directions = 32;   ///< of light from all around, for each of them
constexpr std::uint64_t stream = 2'000;  ///< of draws, after those of plans and verifications

/// Points that looks into a picture meet, a row for each direction of light, with the pixel in the place of the point.
struct Seen {
  LitPoints points;
  std::vector<bool> any;  ///< [pixel]: a look into it meets the sphere
};
Seen look(const Lit& lit, std::size_t pixels) {
  struct Row {
    std::vector<FrameAngles<double>> angles;
    std::vector<std::uint32_t> pixel;
    std::vector<Rgb> weight;
    std::vector<std::uint32_t> hits;
  };
  const Camera camera = middle_camera(lit.scene.view);
  const auto widths = lit.looks[0].widths();
  const std::size_t fine = pixels * across;
  std::vector<Row> rows(pixels);
  tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t j) {
    Row& row = rows[j];
    std::vector<Incident> light;
    row.hits.assign(pixels, 0);
    for (std::size_t y = j * across; y < (j + 1) * across; ++y)
      for (std::size_t x = 0; x < fine; ++x) {
        const Ray r = ray(camera, (static_cast<double>(x) + 0.5) / static_cast<double>(fine),
                          (static_cast<double>(y) + 0.5) / static_cast<double>(fine), 1);
        const auto hit = lit.tracer.closest(r.origin, r.direction);
        if (!hit) continue;
        const Direction to_viewer{-r.direction.x, -r.direction.y, -r.direction.z};
        Draws draws(lit.scene.seed, stream, y, x);
        light.clear();
        lit.lighting.incident(hit->position, hit->frame, to_viewer, widths, directions, draws,
                              light);
        ++row.hits[x / across];
        const Direction v = hit->frame.inside(to_viewer);
        for (const auto& l : light) {
          const Direction d = hit->frame.inside(l.direction);
          const auto a = angles_between<double>({d.x, d.y, d.z}, {v.x, v.y, v.z});
          if (!(a.nol > 0) || !(a.nov > 0)) continue;
          row.angles.push_back(a);
          row.pixel.push_back(static_cast<std::uint32_t>(j * pixels + x / across));
          row.weight.push_back(l.weight);
        }
      }
  });
  Seen s;
  s.points.count = pixels * pixels;
  for (const auto& row : rows) {
    for (const auto h : row.hits) s.any.push_back(2 * h >= across * across);
    const std::size_t first = (s.any.size() - pixels);
    for (std::size_t i = 0; i < row.angles.size(); ++i) {
      const double share = 1.0 / row.hits[row.pixel[i] - first];
      s.points.angles.push_back(row.angles[i]);
      s.points.point.push_back(row.pixel[i]);
      s.points.weight.push_back(
          {share * row.weight[i][0], share * row.weight[i][1], share * row.weight[i][2]});
    }
  }
  return s;
}

char byte(double x) {
  return static_cast<char>(static_cast<unsigned char>(std::lround(std::clamp(x, 0.0, 255.0))));
}
/// Bytes of what a display shows, by sRGB's curve.
std::string shown(const std::vector<Rgb>& radiance, double exposure) {
  std::string bytes;
  for (const auto& l : radiance)
    for (const double c : displayed(l, exposure))
      bytes += byte(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055));
  return base64(bytes);
}

}  // namespace

ScenePicture picture_of(const Lit& lit,
                        const Surface& everything,
                        const Surface& planned,
                        std::size_t pixels) {
  constexpr double scale = 50, most = 254, none = 255;
  const Seen seen = look(lit, pixels);
  const LitColumns columns(seen.points.angles);
  const auto all = radiance(everything, seen.points, columns),
             some = radiance(planned, seen.points, columns);
  const auto apart = differences(Metric::delta_e_2000, lit.scene.exposure, all, some);
  ScenePicture p;
  p.pixels = pixels;
  p.everything = shown(all, lit.scene.exposure);
  p.planned = shown(some, lit.scene.exposure);
  std::string difference;
  for (std::size_t i = 0; i < apart.size(); ++i) {
    difference += byte(seen.any[i] ? std::min(scale * apart[i], most) : none);
    if (seen.any[i]) p.worst = std::max(p.worst, apart[i]);
  }
  p.difference = base64(difference);
  return p;
}

}  // namespace gonio::scenes
