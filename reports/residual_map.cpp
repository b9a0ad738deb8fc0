#include "reports/residual_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "brdf/evaluate.h"

namespace gonio {
namespace {

constexpr std::size_t bins_h = 45, bins_d = 30;

/// Samples that lie on an edge, as those of many grids do, belong to the bin above it whatever the
/// rounding of their angle.
std::size_t bin(double x, std::size_t bins) {
  const double i = std::floor(x * static_cast<double>(bins) + 1e-9);
  return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(bins - 1)));
}

std::size_t cell(const Angles<double>& a) {
  const double theta_h = std::atan2(std::sqrt(a.sin2_theta_h), a.noh);
  const double theta_d = std::acos(std::min(a.voh, 1.0));
  return bin(std::sqrt(theta_h / (90 * degree)), bins_h) * bins_d +
         bin(theta_d / (90 * degree), bins_d);
}

}  // namespace

ResidualMap make_residual_map(const Table& table, const BoundModel& fitted) {
  assert(fitted.model.channels == table.values.size());
  ResidualMap map;
  for (std::size_t i = 0; i <= bins_h; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(bins_h);
    map.theta_h_deg.push_back(90 * x * x);
  }
  for (std::size_t i = 0; i <= bins_d; ++i)
    map.theta_d_deg.push_back(90 * static_cast<double>(i) / static_cast<double>(bins_d));
  map.mean.assign(bins_h * bins_d, 0);
  map.rms.assign(bins_h * bins_d, 0);
  map.count.assign(bins_h * bins_d, 0);

  const SampleAngles at(table);
  constexpr std::size_t chunk = 1 << 15;  // samples whose angles and model values are held at once
  std::vector<Angles<double>> x;
  for (std::size_t first = 0; first < table.size(); first += chunk) {
    const std::size_t end = std::min(first + chunk, table.size());
    x.clear();
    for (std::size_t i = first; i < end; ++i) x.push_back(at(i));
    const auto model = evaluate(fitted, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(x[i].nol > 0 && x[i].nov > 0)) continue;
      const std::size_t k = cell(x[i]);
      for (std::size_t c = 0; c < table.values.size(); ++c) {
        const double y = table.values[c][first + i], f = model[c][i];
        if (mask(x[i], y) != Mask::valid || !(y > 0) || !(f > 0) || !std::isfinite(f)) continue;
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
