#include "scene/plan/reference.h"

#include <algorithm>

namespace gonio::scene {

Judgement judge_fresh(const Scene& s,
                      const PointDrawer& drawer,
                      std::uint64_t stream,
                      std::size_t samples,
                      const Surface& exact,
                      const Surface& surface) {
  constexpr std::size_t part = 4096;
  std::vector<double> all;
  for (std::size_t at = 0; at < samples; at += part) {
    const Reference fresh(drawer.draw(stream, at, std::min(part, samples - at)), exact);
    const auto d = fresh.differences_of(s, surface);
    all.insert(all.end(), d.begin(), d.end());
  }
  return judge(all, s.tolerance);
}

}  // namespace gonio::scene
