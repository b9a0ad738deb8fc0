// The pictures of the scenes that are curves and maps.
#include <algorithm>
#include <cmath>

#include "reports/scenes/scenes.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr double least_error = 1e-3;  ///< what is less is drawn there

void add_front(Pictures& p, const ScenesRows& r) {
  for (const auto& row : r.rows) {
    auto f = make_figure("front", {{"material", row.material}, {"light", row.light}});
    f.title = fmt::format("Accuracy against time: {} under {}", row.material, row.light);
    f.note = "of the sets that nothing beats in both; below 0.001 is drawn at 0.001";
    f.x = {"time of one direction of light [ns]"};
    f.y = {"ΔE2000, upper bound at 99 % of the points", true};
    FigureCurve front{"sets of effects", {}, {}, FigureCurve::Kind::both},
        chosen{"the plan", {}, {}, FigureCurve::Kind::points};
    for (const auto& c : r.front) {
      if (c.material != row.material || c.light != row.light || !std::isfinite(c.error_upper))
        continue;
      const double error = std::max(least_error, c.error_upper);
      const std::string label = c.kept.empty() ? "nothing" : c.kept;
      front.x.push_back(c.ns);
      front.y.push_back(error);
      front.x_error.push_back(c.ns_spread);
      front.labels.push_back(label);
      if (!c.chosen) continue;
      chosen.x.push_back(c.ns);
      chosen.y.push_back(error);
      chosen.labels.push_back(label);
    }
    if (front.x.empty()) continue;
    const auto [from, to] = std::ranges::minmax(front.x);
    f.curves = {{"tolerance",
                 {from, to},
                 {r.tolerance.limit, r.tolerance.limit},
                 FigureCurve::Kind::line,
                 true},
                std::move(front)};
    if (!chosen.x.empty()) f.curves.push_back(std::move(chosen));
    p.figures.push_back(std::move(f));
  }
}

void add_maps(Pictures& p, const ScenesRows& r) {
  for (const auto& m : r.maps) {
    auto map = make_map("switches_on", {{"material", m.material}, {"effect", m.name}});
    map.title = fmt::format("{}: {}", m.material, m.name);
    map.x = {"angle between light and viewer [°]", m.light_deg};
    map.y = {"roughness", m.roughness};
    map.value = "ΔE2000 where it is dropped";
    map.values = m.error;
    map.scale = FigureMap::Scale::root;
    map.limit = 10;
    map.line = r.tolerance.limit;
    p.maps.push_back(std::move(map));
  }
}

}  // namespace

Pictures pictures(const ScenesRows& r) {
  Pictures p;
  add_front(p, r);
  add_maps(p, r);
  return p;
}

}  // namespace gonio
