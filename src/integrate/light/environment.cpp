#include "integrate/light/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace gonio {
namespace {

using Pixels = SummedEnvironment::Rectangle;

/// No part of a texel is smaller.
constexpr double kSmallest = 0x1p-20;

/// Its middle and sides [rad].
struct Shape {
  double theta, phi, sin_theta, cos_theta;
  double x, y;  ///< along the parallel through the middle, along the meridian

  Shape(const Environment& map, const Pixels& r)
      : theta(map.theta((r.y0 + r.y1) / 2)),
        phi(map.phi((r.x0 + r.x1) / 2)),
        sin_theta(std::sin(theta)),
        cos_theta(std::cos(theta)),
        x((map.phi(r.x0) - map.phi(r.x1)) * sin_theta),
        y(map.theta(r.y1) - map.theta(r.y0)) {}
  double radius() const { return std::hypot(x, y) / 2; }
  /// Mean square of the distance from the middle.
  double spread() const { return (x * x + y * y) / 12; }
  /// (cos θ₀ − cos θ₁) Δφ, in which near the pole the cosines would cancel
  double solid_angle() const { return 2 * x * std::sin(y / 2); }
  /// Centre of its area, which lies further from the pole than half way.
  double centre_theta() const { return theta + y * y / 12 * cos_theta / sin_theta; }
  Direction middle() const { return direction(centre_theta(), phi); }
};

/// Flux by channel, then (R + G + B) ω Δω.
std::array<double, 6> even_light(const Shape& s, const Rgb& l) {
  const double omega = s.solid_angle(), all = omega * (l[0] + l[1] + l[2]);
  const Direction d = s.middle();
  return {omega * l[0], omega * l[1], omega * l[2], all * d.x, all * d.y, all * d.z};
}

/// Light of it that comes from above the horizon of n, as if the rectangle were flat.
SummedEnvironment::Light above(const Environment& map,
                               const Pixels& r,
                               SummedEnvironment::Light light,
                               const Direction& n) {
  const Shape s(map, r);
  const double height = dot(n, light.centre);
  if (height >= (s.x + s.y) / 2) return light;
  const double c = std::cos(s.phi), sine = std::sin(s.phi);
  const Direction east{-sine, c, 0}, south{s.cos_theta * c, s.cos_theta * sine, -s.sin_theta};
  const double reach = (s.x * std::abs(dot(n, east)) + s.y * std::abs(dot(n, south))) / 2;
  if (height >= reach) return light;
  if (height <= -reach) return {};
  for (double& f : light.flux) f *= (height + reach) / (2 * reach);
  const double up = (reach - height) / 2;
  Direction& d = light.centre;
  d = {d.x + up * n.x, d.y + up * n.y, d.z + up * n.z};
  const double length = std::sqrt(dot(d, d));
  d = {d.x / length, d.y / length, d.z / length};
  return light;
}

/// Two or four.
struct Parts {
  std::array<Pixels, 4> of;
  std::size_t n = 0;
  const Pixels* begin() const { return of.data(); }
  const Pixels* end() const { return of.data() + n; }
};

/// Cut along the longer side, or both; between texels while there are several.
Parts parts(const Environment& map, const Pixels& r) {
  const Shape s(map, r);
  const bool cut_x = 2 * s.x > s.y, cut_y = 2 * s.y > s.x;
  const auto middle_of = [](double low, double high, bool cut) {
    if (!cut) return high;
    const double half = (low + high) / 2;
    return high - low > 1 ? std::floor(half) : half;
  };
  const double x = middle_of(r.x0, r.x1, cut_x), y = middle_of(r.y0, r.y1, cut_y);
  Parts p;
  p.of[p.n++] = {r.x0, x, r.y0, y};
  if (cut_x) p.of[p.n++] = {x, r.x1, r.y0, y};
  if (cut_y) p.of[p.n++] = {r.x0, x, y, r.y1};
  if (cut_x && cut_y) p.of[p.n++] = {x, r.x1, y, r.y1};
  return p;
}

/// Excess of the light's spread within parts over half of that between them; 0 where they
/// vouch for it, as of even light, of which it is a third.
double hidden_spread(std::span<const SummedEnvironment::Light> parts, double whole_spread) {
  double within = 0, all = 0;
  for (const auto& l : parts) {
    const double weight = l.flux[0] + l.flux[1] + l.flux[2];
    within += weight * l.spread;
    all += weight;
  }
  return all > 0 ? std::max(1.5 * within / all - whole_spread / 2, 0.0) : 0;
}

/// A rectangle, as what its parts give.
struct Leaf {
  Pixels r;
  bool blind;  ///< it is too large to see the functions
};

}  // namespace

SummedEnvironment::SummedEnvironment(Environment map)
    : map_(std::move(map)), sums_((map_.width + 1) * map_.height) {
  for (std::size_t j = 0; j < map_.height; ++j) {
    std::array<double, 6> row{};
    for (std::size_t i = 0; i < map_.width; ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      const auto adds = even_light(Shape(map_, {x, x + 1, y, y + 1}), map_.texel(i, j));
      for (std::size_t k = 0; k < 6; ++k) {
        row[k] += adds[k];
        sums_[j * (map_.width + 1) + i + 1][k] = row[k];
      }
    }
  }
}

SummedEnvironment::Light SummedEnvironment::light(const Pixels& r) const {
  const auto index = [](double v) { return static_cast<std::size_t>(v); };
  std::array<double, 6> sum{};
  double rows = 0;
  const auto last = index(std::ceil(r.y1));
  for (std::size_t j = index(r.y0); j < last; ++j) {
    const double y = static_cast<double>(j);
    const Pixels part{r.x0, r.x1, std::max(r.y0, y), std::min(r.y1, y + 1)};
    const bool whole = part.y1 - part.y0 == 1;
    if (r.x1 - r.x0 <= 1) {  // within one texel
      const auto adds = even_light(Shape(map_, part), map_.texel(index(r.x0), j));
      for (std::size_t k = 0; k < 6; ++k) sum[k] += adds[k];
      rows += adds[0] + adds[1] + adds[2];
      continue;
    }
    const auto* row = sums_.data() + j * (map_.width + 1);
    const auto &low = row[index(r.x0)], &high = row[index(r.x1)], &all = row[map_.width];
    // a part of the row has a part of its light, nearer to a pole or further
    double part_of = 1, across = 1, up = 1;
    if (!whole) {
      const Shape s(map_, part), of(map_, {r.x0, r.x1, y, y + 1});
      part_of = s.solid_angle() / of.solid_angle();
      across = part_of * std::sin(s.centre_theta()) / std::sin(of.centre_theta());
      up = part_of * std::cos(s.centre_theta()) / std::cos(of.centre_theta());
    }
    const double scales[] = {part_of, part_of, part_of, across, across, up};
    for (std::size_t k = 0; k < 6; ++k) sum[k] += (high[k] - low[k]) * scales[k];
    rows += all[0] + all[1] + all[2];
  }
  const double length = std::hypot(sum[3], sum[4], sum[5]);
  const Shape whole(map_, r);
  // Where there is next to no light, differences of large sums say nothing of where it comes from.
  if (!(length > 1e-9 * rows)) return {{sum[0], sum[1], sum[2]}, whole.middle(), whole.spread()};
  // |ω − c|² is 1 − |c|² on average of points, which texels are not.
  const double x = (r.x0 + r.x1) / 2, half_x = std::min(r.x1 - r.x0, 1.0) / 2;
  const double y = (r.y0 + r.y1) / 2, half_y = std::min(r.y1 - r.y0, 1.0) / 2;
  const double of_texel = Shape(map_, {x - half_x, x + half_x, y - half_y, y + half_y}).spread();
  const double mean = length / (sum[0] + sum[1] + sum[2]);
  return {{sum[0], sum[1], sum[2]},
          {sum[3] / length, sum[4] / length, sum[5] / length},
          std::max((1 - mean) * (1 + mean), 0.0) + of_texel};
}

Gathered gather(const SummedEnvironment& light,
                const Gather& g,
                std::size_t functions,
                const Focus& focus,
                const RelativeGoal& goal) {
  const Environment& map = light.map();
  const std::size_t numbers = 3 * functions;
  std::vector<Leaf> leaves;
  std::vector<double> value, error;  // [leaf][function][channel]
  Gathered total;

  /// Within how much the functions change, about a rectangle.
  const auto scale_at = [&](const Shape& shape) {
    const double far = std::acos(std::clamp(dot(shape.middle(), focus.at), -1.0, 1.0));
    return std::clamp(far + focus.width, 1e-12, 0.4);
  };
  std::vector<Direction> at;
  std::vector<double> columns;
  std::vector<double*> out;
  const auto add = [&](const std::vector<Pixels>& rectangles) {
    std::vector<SummedEnvironment::Light> lights;
    std::vector<std::size_t> first{0};
    std::vector<double> unseen;  // relative error by what parts hide
    at.clear();
    for (const auto& r : rectangles) {
      const auto push = [&](const Pixels& part) {
        lights.push_back(above(map, part, light.light(part), focus.normal));
      };
      push(r);
      for (const auto& part : parts(map, r)) push(part);
      const Shape shape(map, r);
      const double scale = scale_at(shape);
      leaves.push_back({r, 4 * shape.radius() > scale});
      unseen.push_back(
          8 / (scale * scale) *
          hidden_spread(std::span(lights).subspan(first.back() + 1), lights[first.back()].spread));
      first.push_back(lights.size());
    }
    for (const auto& l : lights) at.push_back(l.centre);
    columns.resize(functions * at.size());
    out.clear();
    for (std::size_t f = 0; f < functions; ++f) out.push_back(columns.data() + f * at.size());
    g(at, out);
    total.evaluations += at.size();
    for (std::size_t k = 0; k < rectangles.size(); ++k)
      for (std::size_t f = 0; f < functions; ++f)
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (std::size_t p = first[k] + 1; p < first[k + 1]; ++p)
            sum += lights[p].flux[c] * out[f][p];
          value.push_back(sum);
          error.push_back(2 * std::abs(sum - lights[first[k]].flux[c] * out[f][first[k]]) +
                          unseen[k] * sum);
        }
  };

  add({{0, static_cast<double>(map.width), 0, static_cast<double>(map.height)}});
  std::vector<std::size_t> order;
  std::vector<double> share;
  for (;;) {
    std::vector<double> sum(numbers), off(numbers);
    for (std::size_t k = 0; k < value.size(); ++k) {
      sum[k % numbers] += value[k];
      off[k % numbers] += error[k];
    }
    total.error = 0;
    std::vector<double> scale(numbers);
    for (std::size_t k = 0; k < numbers; ++k) {
      scale[k] = sum[k] > 0 ? sum[k] : off[k];
      if (off[k] > 0) total.error = std::max(total.error, off[k] / scale[k]);
    }
    share.assign(leaves.size(), 0);
    order.clear();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      for (std::size_t k = 0; k < numbers; ++k)
        if (scale[k] > 0) share[i] = std::max(share[i], error[i * numbers + k] / scale[k]);
      const Pixels& r = leaves[i].r;
      if (r.x1 - r.x0 < kSmallest && r.y1 - r.y0 < kSmallest) continue;
      if (leaves[i].blind) share[i] = std::numeric_limits<double>::infinity();
      if (share[i] > 0) order.push_back(i);
    }
    const bool blind = std::ranges::any_of(order, [&](std::size_t i) { return leaves[i].blind; });
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return share[i]; });
    // The fewest whose parts, were they exact, would leave half of the error asked for.
    double left = 0;
    std::size_t chosen = order.size();
    while (chosen > 0 && left + share[order[chosen - 1]] <= goal.error / 2)
      left += share[order[--chosen]];
    if ((!blind && total.error <= goal.error) || chosen == 0 ||
        total.evaluations >= goal.evaluations) {
      for (std::size_t f = 0; f < functions; ++f)
        total.value.push_back({sum[3 * f], sum[3 * f + 1], sum[3 * f + 2]});
      return total;
    }
    order.resize(chosen);
    std::ranges::sort(order);
    std::vector<Pixels> halves;
    std::size_t next = 0, to = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (next < order.size() && order[next] == i) {
        ++next;
        for (const auto& part : parts(map, leaves[i].r)) halves.push_back(part);
        continue;
      }
      std::copy_n(value.begin() + static_cast<std::ptrdiff_t>(i * numbers), numbers,
                  value.begin() + static_cast<std::ptrdiff_t>(to * numbers));
      std::copy_n(error.begin() + static_cast<std::ptrdiff_t>(i * numbers), numbers,
                  error.begin() + static_cast<std::ptrdiff_t>(to * numbers));
      leaves[to++] = leaves[i];
    }
    leaves.resize(to);
    value.resize(to * numbers);
    error.resize(to * numbers);
    add(halves);
  }
}

}  // namespace gonio
