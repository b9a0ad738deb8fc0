// The pictures of the atlas.
#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "reports/finding/names.h"
#include "reports/stability/stability.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Tolerance that half is held to: what nobody sees in a highlight's brightness.
constexpr double tolerance = 0.02;

/// "GGX from |n × h|²", "GGX from NoH"
std::string with_form(const std::string& name, const std::string& form) {
  if (form == "cross") return name + " from |n × h|²";
  if (form == "cosine") return name + " from NoH";
  return name;
}
/// The same by the id, by which pictures are found.
std::string key_of(const std::string& id, const std::string& form) {
  return with_form(std::string(short_id(id)), form);
}
std::string kind_of(const std::string& id) {
  return role_of(id) == Role::ndf ? "distributions" : "masking";
}

void add_by_alpha(Pictures& p, const StabilityRows& r) {
  for (const auto& c : r.by_alpha) {
    // an input without a value at every alpha leaves nothing to draw
    if (std::ranges::none_of(c.worst, [](double x) { return std::isfinite(x); })) continue;
    auto made = make_figure("error_by_alpha", {{"number", c.number}, {"kind", kind_of(c.id)}});
    auto at = std::ranges::find(p.figures, made.id, &Figure::id);
    if (at == p.figures.end()) {
      made.title = fmt::format("Worst error by alpha, in {}", c.number);
      made.note = fmt::format("{}; a curve breaks where an input has no value", kind_of(c.id));
      made.x = {"alpha", true};
      made.y = {"most relative error over all angles", true};
      made.curves.push_back({"2 %",
                             {c.alpha.front(), c.alpha.back()},
                             {tolerance, tolerance},
                             FigureCurve::Kind::line,
                             true});
      p.figures.push_back(std::move(made));
      at = p.figures.end() - 1;
    }
    at->curves.push_back({key_of(c.id, c.form), c.alpha, c.worst});
    at->curves.back().label = with_form(name_of_form(c.id), c.form);
  }
}

void add_maps(Pictures& p, const StabilityRows& r) {
  for (const auto& m : r.maps) {
    const bool distribution = role_of(m.id) == Role::ndf;
    auto map = make_map("error", {{"form", key_of(m.id, m.form)}, {"number", m.number}});
    map.title = fmt::format("{} in {}", with_form(name_of_form(m.id), m.form), m.number);
    map.note = "the worst of nine inputs a cell; empty where one of them has no value";
    map.x = {"alpha", m.alpha, true};
    map.y = {distribution ? "sin²θ_h" : "NoL = NoV", m.angle, true};
    map.value = "relative error";
    map.values = m.error;
    map.scale = FigureMap::Scale::log;
    map.limit = 1;
    p.maps.push_back(std::move(map));
  }
}

}  // namespace

Pictures pictures(const StabilityRows& r) {
  Pictures p;
  add_by_alpha(p, r);
  add_maps(p, r);
  return p;
}

}  // namespace gonio
