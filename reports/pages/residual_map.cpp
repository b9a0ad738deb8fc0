#include "reports/pages/residual_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "brdf/model/evaluate.h"
#include "integrate/aperture/mean_values.h"
#include "reports/pages/angle_bins.h"
#include "table/health/health.h"

namespace gonio {
namespace {

constexpr AngleBins bins{Grid::Kind::half_difference, 45, 30};

}  // namespace

ResidualMap make_residual_map(const Table& table, const BoundModel& fitted) {
  assert(fitted.model.channels == table.values.size());
  ResidualMap map;
  map.theta_h_deg = bins.x_deg();
  map.theta_d_deg = bins.y_deg();
  map.mean.assign(bins.x * bins.y, 0);
  map.rms.assign(bins.x * bins.y, 0);
  map.count.assign(bins.x * bins.y, 0);

  constexpr std::size_t most_pairs = 2000;
  std::size_t step = (table.size() * table.values.size() + most_pairs - 1) / most_pairs;
  while (std::gcd(step, table.values.size()) > 1) ++step;  // else some channels are never met
  std::size_t values = 0;
  const SampleAngles at(table);
  const auto copied = copied_pairs(table);
  constexpr std::size_t chunk = 1 << 15;  // samples whose angles and model values are held at once
  std::vector<FrameAngles<double>> x;
  for (std::size_t first = 0; first < table.size(); first += chunk) {
    const std::size_t end = std::min(first + chunk, table.size());
    x.clear();
    for (std::size_t i = first; i < end; ++i)
      x.push_back(fitted.model.anisotropic ? at.frame(i)
                                           : FrameAngles<double>{at(i), 0, 0, 0, 0, 0, 0});
    const auto directions = [&](std::size_t i) { return at.directions(first + i); };
    const auto model = table.aperture ? mean_values(fitted, x.size(), directions, table.aperture)
                                      : evaluate(fitted, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(x[i].nol > 0 && x[i].nov > 0)) continue;
      if (!copied.empty() && copied[(first + i) / at.row_size()]) continue;
      const std::size_t k = bins.cell(x[i]);
      for (std::size_t c = 0; c < table.values.size(); ++c) {
        const double y = table.values[c][first + i], f = model[c][i];
        if (mask(x[i], y) != Mask::valid || !(y > 0) || !(f > 0) || !std::isfinite(f)) continue;
        if (values++ % step == 0 && map.measured.size() < most_pairs) {
          map.measured.push_back(y);
          map.predicted.push_back(f);
        }
        const double ratio = std::log(f / y);
        map.mean[k] += ratio;
        map.rms[k] += ratio * ratio;
        ++map.count[k];
      }
    }
  }
  for (std::size_t k = 0; k < map.count.size(); ++k) {
    const double n =
        map.count[k] ? static_cast<double>(map.count[k]) : std::numeric_limits<double>::quiet_NaN();
    map.mean[k] /= n;
    map.rms[k] = std::sqrt(map.rms[k] / n);
  }
  return map;
}

}  // namespace gonio
