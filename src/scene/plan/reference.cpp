#include "scene/plan/reference.h"

#include <algorithm>
#include <functional>

namespace gonio::scene {

Reference::Reference(const Scene& s, LitPoints p, const Surface& surface)
    : points(std::move(p)), columns(points.angles), own_error(points.count) {
  std::vector<Rgb> off;
  exact = radiance(surface, points, columns, surface.multiple.lobe ? &off : nullptr);
  if (surface.multiple.lobe) own_error = differences(s.tolerance.metric, s.exposure, exact, off);
}

std::vector<double> Reference::bounds_of(const Scene& s, const Surface& surface) const {
  auto d = differences_of(s, surface);
  std::ranges::transform(d, own_error, d.begin(), std::plus{});
  return d;
}

Reference Reference::under_sky(const Scene& s,
                               const PointDrawer& drawer,
                               std::uint64_t stream,
                               std::size_t first,
                               std::size_t count,
                               const Surface& exact) {
  constexpr std::size_t part = 256, times = 16;
  const PointDrawer finer = drawer.with_directions(times * drawer.directions());
  LitPoints all;
  std::vector<Rgb> light;
  std::vector<double> error;
  for (std::size_t at = 0; at < count; at += part) {
    const Reference r(s, finer.draw(stream, first + at, std::min(part, count - at)), exact);
    const auto& p = r.points;
    const auto rows = static_cast<std::ptrdiff_t>(p.sky);
    all.angles.insert(all.angles.end(), p.angles.begin(), p.angles.begin() + rows);
    all.weight.insert(all.weight.end(), p.weight.begin(), p.weight.begin() + rows);
    for (std::size_t i = 0; i < p.sky; ++i)
      all.point.push_back(p.point[i] + static_cast<std::uint32_t>(all.count));
    all.view.insert(all.view.end(), p.view.begin(), p.view.end());
    light.insert(light.end(), r.exact.begin(), r.exact.end());
    error.insert(error.end(), r.own_error.begin(), r.own_error.end());
    all.count += p.count;
  }
  all.sky = all.point.size();
  return {std::move(all), std::move(light), std::move(error)};
}

void FreshDifferences::draw_to(std::size_t samples,
                               const Scene& s,
                               const PointDrawer& drawer,
                               std::uint64_t stream,
                               const Surface& exact,
                               const Surface& surface) {
  constexpr std::size_t part = 4096;
  while (drawn < samples) {
    const std::size_t n = std::min(part, samples - drawn);
    const Reference fresh = surface.image_lit
                                ? Reference::under_sky(s, drawer, stream, drawn, n, exact)
                                : Reference(s, drawer.draw(stream, drawn, n), exact);
    const auto d = fresh.bounds_of(s, surface);
    all.insert(all.end(), d.begin(), d.end());
    own.insert(own.end(), fresh.own_error.begin(), fresh.own_error.end());
    drawn += n;
  }
}

Judgement judge_fresh(const Scene& s,
                      const PointDrawer& drawer,
                      std::uint64_t stream,
                      std::size_t samples,
                      const Surface& exact,
                      const Surface& surface) {
  FreshDifferences d;
  d.draw_to(samples, s, drawer, stream, exact, surface);
  return judge(d.all, s.tolerance);
}

}  // namespace gonio::scene
