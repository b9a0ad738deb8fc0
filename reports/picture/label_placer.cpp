#include "reports/picture/label_placer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gonio::svg {
namespace {

constexpr double name_height = 13, descent = 3;
constexpr double gap = 2;  ///< between a line and its name

bool meet(const Area& a, const Area& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}
bool meets(const Area& a, const std::vector<Area>& any) {
  return std::ranges::any_of(any, [&](const Area& b) { return meet(a, b); });
}
bool is_same(const Spot& a, const Spot& b) {
  return a.x == b.x && a.y == b.y;
}
double distance(const Area& a, const Spot& p) {
  return std::hypot(std::max({a.left - p.x, 0.0, p.x - a.right}),
                    std::max({a.top - p.y, 0.0, p.y - a.bottom}));
}
Area around(const Spot& p, double beside, double above) {
  return {p.x - beside, p.y - above, p.x + beside, p.y + above};
}

/// Upper left corners of a name beside its point, the best first.
std::array<Spot, 12> near_places(double w) {
  return {{{5, -16},
           {-5 - w, -16},
           {5, 3},
           {-5 - w, 3},
           {7, -6},
           {-7 - w, -6},
           {-w / 2, -18},
           {-w / 2, 5},
           {5, 9},
           {-5 - w, 9},
           {5, -23},
           {-5 - w, -23}}};
}
/// The same farther off.
std::vector<Spot> far_places(double w) {
  std::vector<Spot> places;
  for (const double r : {26.0, 40.0, 56.0, 76.0, 100.0})
    for (const auto& [right, down] : {std::pair(0.8, -0.6),
                                      {0.8, 0.6},
                                      {-0.8, -0.6},
                                      {-0.8, 0.6},
                                      {0.3, -1.0},
                                      {0.3, 1.0},
                                      {-0.3, -1.0},
                                      {-0.3, 1.0},
                                      {1.0, -0.2},
                                      {1.0, 0.2},
                                      {-1.0, -0.2},
                                      {-1.0, 0.2}})
      places.push_back({r * right + (right > 0 ? gap : -gap - w), r * down - name_height / 2});
  return places;
}

}  // namespace

void LabelPlacer::add_line(const Spot& from, const Spot& to) {
  const int steps = std::max(1, static_cast<int>(std::hypot(to.x - from.x, to.y - from.y) / 4));
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    lines_.push_back(around({std::lerp(from.x, to.x, part), std::lerp(from.y, to.y, part)}, 2, 2));
  }
}

bool LabelPlacer::is_free(const Area& name, const Spot& own, double from_others) const {
  return name.left > 0 && name.right < width_ && name.top > -6 && name.bottom < height_ &&
         !meets(name, names_) && !meets(name, lines_) && !meets(name, bars_) &&
         std::ranges::none_of(points_, [&](const Spot& p) {
           return !is_same(p, own) && distance(name, p) < from_others;
         });
}

/// A line that passes a name or another point would seem to lead to that.  Points closer to its own than the size of a dot do not
/// count: no line can tell them apart.
bool LabelPlacer::leads(const Spot& own, const Spot& end) const {
  constexpr double begin = 6, step = 3, apart = 6;
  const double length = std::hypot(end.x - own.x, end.y - own.y);
  for (double at = begin; at < length; at += step) {
    const Spot here{std::lerp(own.x, end.x, at / length), std::lerp(own.y, end.y, at / length)};
    if (meets(around(here, 1, 1), names_) || std::ranges::any_of(points_, [&](const Spot& p) {
          return std::hypot(p.x - own.x, p.y - own.y) > apart &&
                 std::hypot(p.x - here.x, p.y - here.y) < apart;
        }))
      return false;
  }
  return true;
}

std::optional<LabelPlace> LabelPlacer::place(const Spot& point, double text_width) {
  const auto area = [&](const Spot& corner) {
    const double left = point.x + corner.x, top = point.y + corner.y;
    return Area{left, top, left + text_width, top + name_height};
  };
  const auto take = [&](const Spot& corner, std::optional<Spot> end) {
    names_.push_back(area(corner));
    return LabelPlace{{corner.x, corner.y + name_height - descent}, end};
  };
  // A name beside another point would be read as that one's.
  constexpr double clearly = 5;
  for (const Spot& corner : near_places(text_width))
    if (const Area name = area(corner); is_free(name, point, distance(name, point) + clearly))
      return take(corner, {});
  for (const Spot& corner : far_places(text_width)) {
    const double side = corner.x > 0 ? corner.x - gap : corner.x + text_width + gap;
    const Spot end{side, corner.y + name_height / 2};
    if (is_free(area(corner), point, clearly) && leads(point, {point.x + end.x, point.y + end.y}))
      return take(corner, end);
  }
  return {};
}

}  // namespace gonio::svg
