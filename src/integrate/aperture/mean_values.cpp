#include "integrate/aperture/mean_values.h"

#include "brdf/model/evaluate.h"

namespace gonio {

std::vector<std::vector<double>> mean_values(const BoundModel& b,
                                             const ApertureAngles& seen,
                                             std::size_t first,
                                             std::size_t count) {
  std::vector<FrameAngles<double>> angles;
  const std::size_t begin = seen.begin(first), end = seen.end(first + count - 1);
  for (std::size_t k = begin; k < end; ++k) angles.push_back(seen.angles(k));
  const auto f = evaluate(b, angles);
  std::vector<std::vector<double>> all(f.size(), std::vector<double>(count));
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = seen.begin(first + i); k < seen.end(first + i); ++k)
        all[c][i] += seen.weight(k) * f[c][k - begin];
  return all;
}

std::vector<std::vector<double>> mean_values(
    const BoundModel& b,
    std::size_t pairs,
    const std::function<DirectionPair(std::size_t)>& directions,
    const Aperture& aperture) {
  return mean_values(b, ApertureAngles(pairs, directions, aperture, b.model.anisotropic), 0, pairs);
}

}  // namespace gonio
