// Where masking forms are compared, and by which roughness they are told.
#include "reports/remap/pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "geometry/half_difference.h"

namespace gonio::remapping {

Pairs::Pairs(std::vector<Cosines> cosines, std::size_t azimuths)
    : cosines_(std::move(cosines)), azimuths_(azimuths) {
  rows_.reserve(cosines_.size() * azimuths);
  for (const auto& c : cosines_)
    for (std::size_t k = 0; k < azimuths; ++k) {
      const double phi =
          std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(azimuths);
      rows_.push_back(
          frame_angles({direction(std::acos(c.nol), 0), direction(std::acos(c.nov), phi)}));
    }
}

std::vector<Pairs::Cosines> all_pairs(std::span<const double> cosines) {
  std::vector<Pairs::Cosines> out;
  for (const double nol : cosines)
    for (const double nov : cosines) out.push_back({nol, nov});
  return out;
}

std::vector<double> g2_at(std::size_t term, double roughness, std::span<const Row> rows) {
  std::vector<double> parameters;
  for (const auto& p : catalogue()[term].parameters)
    parameters.push_back(p.name == "alpha" ? roughness * roughness : p.start);
  return shown_in(Number::double_, term, parameters, rows);
}

bool reads_half(std::size_t term) {
  static const Pairs two({{0.3, 0.6}}, 2);
  const auto g = g2_at(term, 0.5, two.rows());
  return g[0] != g[1];
}

std::vector<double> mean_g2(std::size_t term, double roughness, const Pairs& pairs) {
  const std::size_t n = pairs.azimuths();
  std::vector<double> out(pairs.cosines().size());
  if (reads_half(term)) {
    const auto g = g2_at(term, roughness, pairs.rows());
    for (std::size_t i = 0; i < g.size(); ++i) out[i / n] += g[i] / static_cast<double>(n);
    return out;
  }
  std::vector<Row> rows(out.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = pairs.rows()[i * n];
  return g2_at(term, roughness, rows);
}

NearestRoughness nearest(const std::function<double(double)>& f, std::span<const double> grid) {
  std::vector<double> at;
  for (const double r : grid) at.push_back(f(r));
  const auto least = static_cast<std::size_t>(std::ranges::min_element(at) - at.begin());
  // Golden section between the neighbours of the least.
  double a = grid[least > 0 ? least - 1 : 0], b = grid[std::min(least + 1, grid.size() - 1)];
  constexpr double part = 0.6180339887498949;
  double x = b - part * (b - a), y = a + part * (b - a), fx = f(x), fy = f(y);
  while (b - a > 1e-5) {
    if (fx < fy) {
      b = y, y = x, fy = fx;
      x = b - part * (b - a), fx = f(x);
    } else {
      a = x, x = y, fx = fy;
      y = a + part * (b - a), fy = f(y);
    }
  }
  NearestRoughness best{x, fx, false};
  if (at[least] <= fx) best = {grid[least], at[least], false};
  best.at_end = best.roughness < grid.front() + 1e-4 || best.roughness > grid.back() - 1e-4;
  return best;
}

}  // namespace gonio::remapping
