#include "reports/picture/front.h"

#include <algorithm>
#include <cmath>

namespace gonio {

FrontPlace front_place(std::span<const TimedError> rivals, std::size_t form) {
  const TimedError& own = rivals[form];
  FrontPlace place;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    const TimedError& other = rivals[i];
    if (i == form || other.error > own.error * (1 + same_error)) continue;
    const auto faster = difference({other.time, other.each}, {own.time, own.each});
    if (faster.survives && faster.ns > 0) place.front = false;
    place.tie |= !faster.survives;
    const bool is_as_exact = other.error >= own.error * (1 - same_error);
    place.on_line &= other.time.ns > own.time.ns || (is_as_exact && other.time.ns == own.time.ns);
  }
  return place;
}

void mark_front(std::span<FrontDot> dots) {
  std::vector<TimedError> places;
  for (const auto& d : dots) places.push_back(d.at);
  for (std::size_t i = 0; i < dots.size(); ++i) dots[i].front = front_place(places, i).on_line;
}

FigureCurve front_points(std::string name, std::span<const FrontDot> dots) {
  FigureCurve c;
  c.name = std::move(name);
  c.kind = FigureCurve::Kind::points;
  for (const auto& d : dots) {
    c.x.push_back(d.at.time.ns);
    c.y.push_back(d.at.error);
    c.x_error.push_back(d.at.time.spread_ns);
    c.labels.push_back(d.name);
  }
  return c;
}

std::optional<FigureCurve> front_line(std::string name, std::span<const FrontDot> dots) {
  std::vector<TimedError> front;
  for (const auto& d : dots)
    if (d.front) front.push_back(d.at);
  if (front.size() < 2) return {};
  std::ranges::stable_sort(front, {}, [](const TimedError& e) { return e.time.ns; });
  FigureCurve line;
  line.name = std::move(name);
  line.dashed = true;
  for (const auto& e : front) {
    line.x.push_back(e.time.ns);
    line.y.push_back(e.error);
  }
  return line;
}

}  // namespace gonio
