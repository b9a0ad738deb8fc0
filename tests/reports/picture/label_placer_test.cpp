#include "reports/picture/label_placer.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace gonio::svg {
namespace {

constexpr double width = 600, height = 280, text_height = 10;  // above the baseline

struct Named {
  Spot point;
  double text_width;
  std::optional<LabelPlace> place;
  Area area() const {
    const double left = point.x + place->text.x, baseline = point.y + place->text.y;
    return {left, baseline - text_height, left + text_width, baseline};
  }
};
double distance(const Area& a, const Spot& p) {
  return std::hypot(std::max({a.left - p.x, 0.0, p.x - a.right}),
                    std::max({a.top - p.y, 0.0, p.y - a.bottom}));
}
bool meet(const Area& a, const Area& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// Points in two crowds, each with a bar of its error, named one after the other.
std::vector<Named> crowds(std::mt19937& random, std::vector<Area>& bars) {
  std::uniform_real_distribution<double> at(-30, 30), size(30, 150), error(0, 25);
  LabelPlacer placer(width, height);
  std::vector<Named> all;
  for (const Spot& middle : {Spot{120, 60}, Spot{420, 180}})
    for (int i = 0; i < 7; ++i) {
      all.push_back({{middle.x + at(random), middle.y + at(random)}, size(random), {}});
      const auto& p = all.back().point;
      const double e = error(random);
      bars.push_back({p.x - e, p.y - 1, p.x + e, p.y + 1});
      placer.add_point(p);
      placer.add_bar(bars.back());
    }
  for (auto& n : all) n.place = placer.place(n.point, n.text_width);
  return all;
}

TEST(LabelPlacer, PutsANameBesideAPointThatHasRoom) {
  LabelPlacer placer(width, height);
  placer.add_point({300, 140});
  const auto place = placer.place({300, 140}, 80);
  ASSERT_TRUE(place);
  EXPECT_FALSE(place->end);
}

TEST(LabelPlacer, PutsANameWithoutALineNearerToItsPointThanToAnyOther) {
  std::mt19937 random(1);
  int beside = 0, led = 0;
  for (int run = 0; run < 50; ++run) {
    std::vector<Area> bars;
    const auto all = crowds(random, bars);
    for (const auto& n : all) {
      if (!n.place) continue;
      (n.place->end ? led : beside) += 1;
      if (n.place->end) continue;
      for (const auto& other : all)
        EXPECT_LE(distance(n.area(), n.point), distance(n.area(), other.point));
    }
  }
  EXPECT_GT(beside, 100);
  EXPECT_GT(led, 100);
}

TEST(LabelPlacer, LetsNoNameMeetAnotherOrABar) {
  std::mt19937 random(2);
  for (int run = 0; run < 50; ++run) {
    std::vector<Area> bars;
    const auto all = crowds(random, bars);
    for (const auto& n : all) {
      if (!n.place) continue;
      EXPECT_TRUE(std::ranges::none_of(bars, [&](const Area& b) { return meet(n.area(), b); }));
      for (const auto& other : all)
        EXPECT_FALSE(&other != &n && other.place && meet(n.area(), other.area()));
    }
  }
}

TEST(LabelPlacer, LeadsNoLinePastAnotherPoint) {
  std::mt19937 random(3);
  for (int run = 0; run < 50; ++run) {
    std::vector<Area> bars;
    const auto all = crowds(random, bars);
    for (const auto& n : all) {
      if (!n.place || !n.place->end) continue;
      const auto [right, down] = *n.place->end;
      const double length = std::hypot(right, down);
      for (const auto& other : all) {
        const double x = other.point.x - n.point.x, y = other.point.y - n.point.y;
        const double along = (x * right + y * down) / length;
        if (std::hypot(x, y) <= 6 || along < 8 || along > length) continue;
        EXPECT_GT(std::abs(x * down - y * right) / length, 4);
      }
    }
  }
}

}  // namespace
}  // namespace gonio::svg
