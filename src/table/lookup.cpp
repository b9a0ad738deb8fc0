#include "table/lookup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

namespace gonio {
namespace {

/// The pair moved to where a grid's axes are.
DirectionPair onto(const Grid& g, const DirectionPair& p) {
  const auto inside = [&](std::size_t axis, double angle) {
    return std::clamp(angle, 0.0, g.axes[axis].span);
  };
  const Axis& last = g.axes[2];
  const bool one = last.spacing == Axis::Spacing::constant || last.size == 1;
  if (g.kind == Grid::Kind::half_difference) {
    auto a = half_difference(p);
    if (one) {
      const double phi = std::remainder(a.phi_d, std::numbers::pi);
      const double there = std::abs(std::remainder(last.angle(0, g.bins), std::numbers::pi));
      a.phi_d += std::copysign(there, phi) - phi;
    }
    return directions({inside(0, a.theta_h), a.phi_h, inside(1, a.theta_d), a.phi_d});
  }
  const double phi_i = phi_of(p.wi),
               phi = std::remainder(phi_of(p.wo) - phi_i, 2 * std::numbers::pi);
  const double to = one ? last.angle(0, g.bins) : std::min(std::abs(phi), last.span);
  return {direction(inside(0, theta_of(p.wi)), phi_i),
          direction(inside(1, theta_of(p.wo)), phi_i + std::copysign(to, phi))};
}

/// One of a pair and its mirror images, the light at azimuth 0.
DirectionPair folded(const DirectionPair& p) {
  DirectionPair q = turned(p);
  q.wo.y = std::abs(q.wo.y);
  return q;
}

}  // namespace

Lookup::Lookup(const Table& t, double reach)
    : table_(t), at_(t), chord2_(std::pow(2 * std::sin(reach / 2), 2)), nearest_(reach) {
  if (t.grid()) return;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at_.directions(i);
    const auto is_valid = [&](const Values& v) { return mask(angles(p), v[i]) == Mask::valid; };
    if (std::ranges::all_of(t.values, is_valid)) nearest_.add(folded(p), i);
  }
}

bool Lookup::is_within_reach(const DirectionPair& p) const {
  const auto [in, out] = squared_chords(turned(p), turned(onto(*table_.grid(), p)));
  return std::max(in, out) <= chord2_;
}

GridCell Lookup::operator()(const DirectionPair& p) const {
  if (table_.grid()) {
    if (!is_within_reach(p)) return {};
    GridCell cell = cell_around(table_, at_, p);
    // Half of the weight that there can be: below the horizon no table has values.
    const auto parts = std::span(cell.part).first(cell.count);
    const double all = std::accumulate(parts.begin(), parts.end(), 0.0);
    for (double& part : parts) part /= all;
    return cell.valid_in(table_.values);
  }
  GridCell one;
  double best = std::numeric_limits<double>::max();
  for (const auto& q : {folded(p), folded(swapped(p))})
    if (const auto sample = nearest_(q)) {
      const auto [in, out] = squared_chords(q, folded(at_.directions(*sample)));
      if (in + out >= best) continue;
      best = in + out;
      one.sample[0] = *sample;
      one.part[0] = 1;
      one.count = 1;
    }
  return one;
}

}  // namespace gonio
