#pragma once
/// \file
/// Points with the radiance that all effects in their exact form give them, and how far that may be off.

#include <utility>
#include <vector>

#include "scene/plan/difference.h"
#include "scene/plan/samples.h"

namespace gonio::scene {

struct Reference {
  LitPoints points;
  LitColumns columns;
  std::vector<Rgb> exact;
  /// Difference that two standard errors of the light between facets make at each point, everywhere in the same sense.
  std::vector<double> own_error;

  /// Points whose light of an environment is summed over so many directions that a surface which looks it up can be compared
  /// with that: 16 times as many as the drawer draws, 1024 as a rule.  The rows of the environment are let go.
  static Reference under_sky(const Scene&,
                             const PointDrawer&,
                             std::uint64_t stream,
                             std::size_t first,
                             std::size_t count,
                             const Surface& exact);

  Reference(const Scene&, LitPoints, const Surface& exact);
  std::vector<double> differences_of(const Scene& s, const Surface& surface) const {
    return differences(s.tolerance.metric, s.exposure, exact, radiance(surface, points, columns));
  }
  /// The same with the reference's own error added at each point: where that holds, a bound of the difference from the light itself.
  std::vector<double> bounds_of(const Scene& s, const Surface& surface) const;

 private:
  Reference(LitPoints p, std::vector<Rgb> radiance, std::vector<double> error)
      : points(std::move(p)),
        columns(points.angles),
        exact(std::move(radiance)),
        own_error(std::move(error)) {}
};

/// Differences of points that are drawn for them, a part after the other: no light is kept.
struct FreshDifferences {
  std::vector<double> all;  ///< with the reference's own error in each
  std::vector<double> own;  ///< that error

  std::size_t drawn = 0;
  /// Draws on, up to so many points of a stream.
  void draw_to(std::size_t samples,
               const Scene&,
               const PointDrawer&,
               std::uint64_t stream,
               const Surface& exact,
               const Surface&);
};
/// Judgement of so many of them.
Judgement judge_fresh(const Scene&,
                      const PointDrawer&,
                      std::uint64_t stream,
                      std::size_t samples,
                      const Surface& exact,
                      const Surface&);

}  // namespace gonio::scene
