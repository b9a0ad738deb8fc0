#include "table/nearest_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio {
namespace {

double squared(const Direction& a, const Direction& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z);
}

}  // namespace

DirectionPair swapped(const DirectionPair& p) {
  return {p.wo, p.wi};
}

DirectionPair mirrored(DirectionPair p) {
  p.wi.y = -p.wi.y;
  p.wo.y = -p.wo.y;
  return p;
}

DirectionPair turned(const DirectionPair& p) {
  const double r = std::hypot(p.wi.x, p.wi.y);
  if (r == 0) return p;
  const double c = p.wi.x / r, s = p.wi.y / r;
  return {{r, 0, p.wi.z}, {p.wo.x * c + p.wo.y * s, p.wo.y * c - p.wo.x * s, p.wo.z}};
}

std::array<double, 2> squared_chords(const DirectionPair& a, const DirectionPair& b) {
  return {squared(a.wi, b.wi), squared(a.wo, b.wo)};
}

NearestSample::NearestSample(double reach)
    : reach_(2 * std::sin(reach / 2)), size_(std::max(reach_, 1e-3)) {}

void NearestSample::add(const DirectionPair& p, std::size_t sample) {
  const auto q = turned(p);
  // One in a quarter of a cell: the rest of dense samples need not be looked at.
  if (taken_.insert(key(cell_of(q, size_ / 4))).second)
    cells_[key(cell_of(q, size_))].push_back({q, sample});
}

std::optional<std::size_t> NearestSample::operator()(const DirectionPair& p) const {
  const auto q = turned(p);
  const auto home = cell_of(q, size_);
  const std::array at{q.wi.x, q.wo.x, q.wo.y, q.wo.z};
  double best = std::numeric_limits<double>::max();
  std::optional<std::size_t> found;
  const auto look_into = [&](int number) {
    Cell cell = home;
    double away = 0;  // of the cell, squared
    for (std::size_t a = 0; a < 4; ++a, number /= 3) {
      cell[a] += number % 3 - 1;
      const double low = static_cast<double>(cell[a]) * size_;
      away += std::pow(std::max({low - at[a], at[a] - low - size_, 0.0}), 2);
    }
    if (away >= best) return;
    const auto there = cells_.find(key(cell));
    if (there == cells_.end()) return;
    for (const auto& [pair, sample] : there->second) {
      const auto [in, out] = squared_chords(pair, q);
      if (std::max(in, out) > reach_ * reach_ || in + out >= best) continue;
      best = in + out;
      found = sample;
    }
  };
  constexpr int cells = 81, middle = 40;  // first, since it leaves few of the others
  look_into(middle);
  for (int k = 0; k < cells; ++k)
    if (k != middle) look_into(k);
  return found;
}

NearestSample::Cell NearestSample::cell_of(const DirectionPair& q, double size) {
  const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size)); };
  return {index(q.wi.x), index(q.wo.x), index(q.wo.y), index(q.wo.z)};
}

std::uint64_t NearestSample::key(const Cell& c) {
  std::uint64_t all = 0;
  for (const auto i : c) all = (all << 16U) | (static_cast<std::uint64_t>(i) & 0xffffU);
  return all;
}

}  // namespace gonio
