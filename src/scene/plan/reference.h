#pragma once
/// \file
/// Points with the radiance that all effects in their exact form give them.

#include <utility>
#include <vector>

#include "scene/plan/difference.h"
#include "scene/plan/samples.h"

namespace gonio::scene {

struct Reference {
  LitPoints points;
  LitColumns columns;
  std::vector<Rgb> exact;

  /// Points whose light of an environment is summed over so many directions that a surface which looks it up can be compared
  /// with that: 16 times as many as the drawer draws, 1024 as a rule.  The rows of the environment are let go.
  static Reference under_sky(const PointDrawer&,
                             std::uint64_t stream,
                             std::size_t first,
                             std::size_t count,
                             const Surface& exact);

  Reference(LitPoints p, const Surface& surface)
      : points(std::move(p)), columns(points.angles), exact(radiance(surface, points, columns)) {}
  std::vector<double> differences_of(const Scene& s, const Surface& surface) const {
    return differences(s.tolerance.metric, s.exposure, exact, radiance(surface, points, columns));
  }

 private:
  Reference(LitPoints p, std::vector<Rgb> radiance)
      : points(std::move(p)), columns(points.angles), exact(std::move(radiance)) {}
};

/// Judgement on points first drawn for it, a part after the other: memory does not grow with their number.
Judgement judge_fresh(const Scene&,
                      const PointDrawer&,
                      std::uint64_t stream,
                      std::size_t samples,
                      const Surface& exact,
                      const Surface&);

}  // namespace gonio::scene
