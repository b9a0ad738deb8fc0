// The pictures of the scenes that are curves and maps.
#include <algorithm>
#include <cmath>

#include "reports/scenes/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr double least_error = 1e-3;  ///< what is less is drawn there

using Names = std::vector<std::string>;
Names names_in(const std::string& list) {
  Names names;
  for (std::size_t at = 0; at < list.size();) {
    const auto end = std::min(list.find(", ", at), list.size());
    names.push_back(list.substr(at, end - at));
    at = end + 2;
  }
  return names;
}
Names common_names(const std::vector<const SceneFrontRow*>& points) {
  Names common = names_in(points[0]->kept);
  for (const auto* p : points) {
    const auto own = names_in(p->kept);
    std::erase_if(common, [&](const auto& n) { return std::ranges::find(own, n) == own.end(); });
  }
  return common;
}
Names without(Names names, const Names& others) {
  std::erase_if(names, [&](const auto& n) { return std::ranges::find(others, n) != others.end(); });
  return names;
}

void add_front(Pictures& p, const ScenesRows& r) {
  for (const auto& row : r.rows) {
    auto f = make_figure("front", {{"material", row.material}, {"light", row.light}});
    f.title = fmt::format("Accuracy against time: {} under {}", row.material, row.light);
    f.note =
        "of the sets that nothing beats in both, down to an error of 0.001, on the points where "
        "sets "
        "are compared; plans are judged on others";
    f.x = {"time of one direction of light [ns]"};
    f.y = {"ΔE2000, upper bound at 99 % of the points", true};
    std::vector<const SceneFrontRow*> points;
    for (const auto& c : r.front)
      if (c.material == row.material && c.light == row.light && std::isfinite(c.error_upper)) {
        points.push_back(&c);
        if (c.error_upper <= least_error) break;  // nobody sees what dearer sets make better
      }
    if (points.empty()) continue;
    const auto common = common_names(points);
    if (!common.empty()) f.note += fmt::format("; all of them keep {}", fmt::join(common, ", "));
    FigureCurve front{"sets of effects", {}, {}, FigureCurve::Kind::points},
        chosen{"the plan", {}, {}, FigureCurve::Kind::points};
    for (const auto* c : points) {
      const double error = std::max(least_error, c->error_upper);
      const auto label = without(names_in(c->kept), common);
      front.x.push_back(c->ns);
      front.y.push_back(error);
      front.x_error.push_back(c->ns_spread);
      front.labels.push_back(label.empty() ? "only these"
                                           : fmt::format("{}", fmt::join(label, ", ")));
      if (!c->chosen) continue;
      chosen.x.push_back(c->ns);
      chosen.y.push_back(error);
    }
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
  // The index shows the first: that with most to see.
  const auto points = [](const Figure& f) { return f.curves[1].x.size(); };
  if (const auto most = std::ranges::max_element(p.figures, {}, points); most != p.figures.end())
    std::rotate(p.figures.begin(), most, most + 1);
  add_maps(p, r);
  return p;
}

}  // namespace gonio
