#include "table/grid_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gonio {
namespace {

bool has_value(double v) {
  return std::isfinite(v) && v >= 0;
}

}  // namespace

GridCell GridCell::valid_in(const std::vector<Values>& channels) const {
  GridCell kept;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = sample[k];
    if (!std::ranges::all_of(channels, [i](const Values& v) { return has_value(v[i]); })) continue;
    kept.sample[kept.count] = i;
    kept.part[kept.count++] = part[k];
  }
  return kept;
}

double GridCell::mean_of(const Values& values) const {
  double sum = 0, weight = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double v = values[sample[k]];
    if (!has_value(v)) continue;
    sum += part[k] * v;
    weight += part[k];
  }
  return weight > 0.5 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

GridCell cell_around(const Table& t,
                     const SampleAngles& at,
                     const DirectionPair& p,
                     std::ptrdiff_t step) {
  const Grid& g = *t.grid();
  std::array<double, 3> angle;
  if (g.kind == Grid::Kind::half_difference) {
    const auto a = half_difference(p);
    angle = {a.theta_h, a.theta_d, a.phi_d < 0 ? a.phi_d + g.axes[2].span : a.phi_d};
  } else {
    const double phi = std::remainder(phi_of(p.wo) - phi_of(p.wi), 2 * std::numbers::pi);
    angle = {theta_of(p.wi), theta_of(p.wo), std::abs(phi)};
  }
  GridCell cell;
  std::array<std::array<std::size_t, 2>, 3> corner;
  std::array<double, 3> part;
  for (std::size_t a = 0; a < 3; ++a) {
    const Axis& axis = g.axes[a];
    const auto size = static_cast<std::ptrdiff_t>(axis.size);
    const double x = axis.index(angle[a], g.bins), last = static_cast<double>(size - 1);
    if (!(x >= -1 && x <= last + 1)) return cell;
    const bool periodic = axis.name == "phi_d" && axis.has_bins();
    const double inside = periodic ? x : std::clamp(x, 0.0, last);
    const auto low =
        step * static_cast<std::ptrdiff_t>(std::floor(inside / static_cast<double>(step)));
    const std::ptrdiff_t high = periodic ? low + step : std::min(low + step, size - 1);
    part[a] =
        high > low ? (inside - static_cast<double>(low)) / static_cast<double>(high - low) : 0;
    corner[a] = {static_cast<std::size_t>((low + size) % size),
                 static_cast<std::size_t>((high + size) % size)};
  }
  for (unsigned bits = 0; bits < 8; ++bits) {
    double w = 1;
    std::size_t i = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const unsigned up = (bits >> a) & 1U;
      w *= up ? part[a] : 1 - part[a];
      i = i * g.axes[a].size + corner[a][up];
    }
    if (w == 0 || mask(at(i), 0) != Mask::valid) continue;
    cell.sample[cell.count] = i;
    cell.part[cell.count++] = w;
  }
  return cell;
}

}  // namespace gonio
