#pragma once
/// \file
/// Difference between what is seen and what should be.

#include <algorithm>
#include <span>
#include <vector>

#include "scene/description/scene.h"

namespace gonio::scene {

/// Difference of each radiance from the reference's, by the metric of a scene's tolerance.
///
///   delta_e_2000   of display colours (image/display.h)
///   relative       the channel's that differs most: |L − L₀|/L₀; 0 where both are 0, 1 where L₀ alone is
std::vector<double> differences(Metric,
                                double exposure,
                                std::span<const Rgb> reference,
                                std::span<const Rgb> radiance);

/// Differences of independent points, as a tolerance judges them.
struct Judgement {
  std::size_t samples = 0, exceeding = 0;  ///< those beyond the limit
  double quantile = 0;                     ///< of the differences
  double upper = 0;                        ///< its upper confidence bound
  double bound = 1;                        ///< of the share that is beyond the limit
  double worst = 0;

  /// True where the bound of the quantile keeps the limit, and none is beyond the greatest.
  bool keeps(const Tolerance& t) const { return upper <= t.limit && worst <= t.max; }
  /// True where no larger a share is beyond the limit, with the tolerance's confidence, than its quantile leaves, and none is beyond
  /// the greatest.
  bool holds(const Tolerance& t) const { return bound <= 1 - t.quantile && worst <= t.max; }
  /// True where these points by themselves break the tolerance: else it holds, or they are too few to show whether it does.
  bool breaks(const Tolerance& t) const {
    return static_cast<double>(exceeding) > (1 - t.quantile) * static_cast<double>(samples) ||
           worst > t.max;
  }
};

/// What a plan's points may show, so that a verification on other points agrees: less than the tolerance allows.
struct Margin {
  double most_exceeding = 0;  ///< that a judgement's bound may be
  double most_worst = 0;      ///< that its worst may be

  bool is_kept(const Judgement& j) const {
    return j.bound <= most_exceeding && j.worst <= most_worst;
  }
  /// How much of it a judgement takes: up to 1 it is kept.
  double taken(const Judgement& j) const {
    return std::max(part(j.bound, most_exceeding), part(j.worst, most_worst));
  }
  /// True where it is the worst point that takes most of it; else it is the share beyond the limit.
  bool is_taken_by_worst(const Judgement& j) const {
    return part(j.worst, most_worst) > part(j.bound, most_exceeding);
  }

 private:
  static double part(double x, double most);
};

/// \param values  reordered
Judgement judge(std::vector<double>& values, const Tolerance&);

}  // namespace gonio::scene
