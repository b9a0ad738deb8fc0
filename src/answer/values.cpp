#include "answer/values.h"

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "geometry/direction.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

DirectionPair pair_at(const DirectionColumns& at, std::size_t i) {
  return {direction(at.theta_i[i] * degree, at.phi_i[i] * degree),
          direction(at.theta_o[i] * degree, at.phi_o[i] * degree)};
}

}  // namespace

void evaluate_at(const BoundModel& model,
                 const DirectionColumns& at,
                 std::span<double* const> out) {
  // In parts: frames are larger than what they are made of.  Each sample is by itself, so that
  // parts change nothing.
  constexpr std::size_t part = 8192;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, at.size(), part),
      [&](const tbb::blocked_range<std::size_t>& r) {
        std::vector<FrameAngles<double>> angles;
        angles.reserve(r.size());
        for (std::size_t i = r.begin(); i < r.end(); ++i)
          angles.push_back(frame_angles(pair_at(at, i)));
        const auto f = evaluate(model, angles);
        for (std::size_t c = 0; c < f.size(); ++c)
          std::copy(f[c].begin(), f[c].end(), out[c] + r.begin());
      },
      tbb::simple_partitioner());
}

void interpolate_at(const Table& table, const DirectionColumns& at, std::span<double* const> out) {
  if (!table.grid() && !table.between)
    throw bad_input(table.path, "format " + table.format, "samples at single directions",
                    "a table that has values between its samples: a grid, or an RGL file; gonio "
                    "convert makes a grid of it");
  const Interpolator f(table);
  for (std::size_t c = 0; c < table.channels.size(); ++c)
    for (std::size_t i = 0; i < at.size(); ++i) {
      const DirectionPair p = pair_at(at, i);
      const double v = f(p, c);
      out[c][i] = mask(angles(p), v) == Mask::valid ? v : std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace gonio
