// Pictures in the document of a page.
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "reports/picture/document.h"
#include "reports/picture/figure_scale.h"
#include "reports/picture/figure_style.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Six digits: more than a picture shows, a third of the bytes.  What is not known is null.
Json page_json(double v) {
  return number_json(v, Digits::six);
}
Json page_json(const std::vector<double>& v) {
  Json out = Json::array();
  for (const double x : v) out.push_back(page_json(x));
  return out;
}

Json json(const FigureScale& s, std::size_t most) {
  return {{"low", page_json(s.low)},
          {"high", page_json(s.high)},
          {"ticks", page_json(scale_ticks(s, most))},
          {"few", page_json(scale_ticks(s, ticks_few))}};
}

/// An axis with the scales that it may be drawn on.
Json json(const FigureAxis& a, const Json& scales) {
  Json out{{"label", a.label}, {"log", a.log}};
  if (std::isfinite(a.from)) out["from"] = a.from;
  if (std::isfinite(a.to)) out["to"] = a.to;
  out["scales"] = scales;
  return out;
}
/// Scales of x and y of a figure; logarithmic ones where a reader may choose them, too: of x where it is one at first and all
/// lie above 0, of y where nothing lies below.
std::pair<Json, Json> scales(Figure f) {
  bool x_positive = true, y_positive = false, y_negative = false;
  for (const auto& c : f.curves)
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      x_positive = x_positive && !(c.x[i] <= 0);
      y_positive = y_positive || c.y[i] > 0;
      y_negative = y_negative || c.y[i] < 0;
    }
  const bool x_log = f.x.log, y_log = f.y.log;
  Json x = Json::object(), y = Json::object();
  const auto put = [&](Json& scales, const char* name, FigureAxis& axis, bool log, bool at_first,
                       FigureScale (*scale)(const Figure&), std::size_t most) {
    axis.log = log;
    scales[name] = json(scale(f), most);
    axis.log = at_first;
  };
  put(x, "linear", f.x, false, x_log, x_scale, x_ticks_most);
  if (x_log && x_positive) put(x, "log", f.x, true, x_log, x_scale, x_ticks_most);
  put(y, "linear", f.y, false, y_log, y_scale, y_ticks_most);
  if (y_log || (y_positive && !y_negative)) {
    if (f.y.from <= 0) f.y.from = std::numeric_limits<double>::quiet_NaN();
    put(y, "log", f.y, true, y_log, y_scale, y_ticks_most);
  }
  return {std::move(x), std::move(y)};
}

Json json(const FigureMap::Axis& a) {
  const auto edges = cell_edges(a);
  Json out{{"label", a.label}, {"log", a.log}, {"edges", page_json(edges)}};
  if (a.names.empty()) {
    const FigureScale scale{edges.front(), edges.back(), a.log};
    out["at"] = page_json(a.at);
    out["ticks"] = page_json(scale_ticks(scale, map_ticks_most));
    out["few"] = page_json(scale_ticks(scale, map_ticks_few));
  } else {
    out["names"] = a.names;
  }
  return out;
}

/// Keys of what is measured in time end in its unit: no run repeats them, unlike everything else.
std::string key(const char* name, const FigureAxis& axis) {
  for (const char* unit : {"_ns", "_ms"})
    if (axis.label.ends_with(fmt::format("[{}]", unit + 1))) return std::string(name) + unit;
  return name;
}

/// A curve; x only where it is not the same as of the curve before.
Json json(const Figure& f, std::size_t i, const CurveStyles& styles) {
  const auto& c = f.curves[i];
  const auto look = look_of(c, styles);
  Json out{{"name", c.name},
           {"kind", name_of(c.kind)},
           {"colour", look.colour},
           {"dash", look.dash},
           {"width", look.width}};
  if (!c.label.empty()) out["label"] = c.label;
  if (c.dashed) out["dashed"] = true;
  if (i == 0 || f.curves[i - 1].x != c.x) out[key("x", f.x)] = page_json(c.x);
  out[key("y", f.y)] = page_json(c.y);
  if (!c.labels.empty()) out["labels"] = c.labels;
  if (!c.x_error.empty()) out[key("x_error", f.x)] = page_json(c.x_error);
  if (!c.y_error.empty()) out[key("y_error", f.y)] = page_json(c.y_error);
  return out;
}

Json json(const std::vector<std::pair<std::string, std::string>>& choices) {
  Json out = Json::object();
  for (const auto& [of, chosen] : choices) out[of] = chosen;
  return out;
}

Json json(const Figure& f, const CurveStyles& styles) {
  Json curves = Json::array();
  for (std::size_t i = 0; i < f.curves.size(); ++i) curves.push_back(json(f, i, styles));
  const auto [x, y] = scales(f);
  return {{"id", f.id},     {"family", f.family}, {"choices", json(f.choices)}, {"title", f.title},
          {"note", f.note}, {"x", json(f.x, x)},  {"y", json(f.y, y)},          {"curves", curves}};
}

Json json(const FigureMap& m) {
  const auto colours = colour_scale(m);
  Json out{{"id", m.id},
           {"family", m.family},
           {"choices", json(m.choices)},
           {"title", m.title},
           {"note", m.note},
           {"x", json(m.x)},
           {"y", json(m.y)},
           {"value", m.value},
           {"diverging", m.diverging},
           {"scale", name_of(m.scale)},
           {"low", page_json(colours.low)},
           {"high", page_json(colours.high)},
           {"ticks", page_json(colours.ticks)},
           {"colours", json_of(colours_of(m))},
           {"values", page_json(m.values)}};
  if (std::isfinite(m.line)) out["line"] = page_json(m.line);
  if (!m.slices.empty()) out["slices"] = m.slices;
  return out;
}

bool is_picture_id(std::string_view id) {
  return !id.empty() && id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == id.npos;
}

}  // namespace

std::vector<std::string> picture_files(std::string_view json, std::string_view report) {
  using Sorted = nlohmann::json;  // of keys in their order each would be looked for among all
  const auto document = Sorted::parse(json, nullptr, false);
  const auto text = [](const Sorted& object, const char* key) -> std::string {
    if (!object.is_object()) return "";
    const auto it = object.find(key);
    return it != object.end() && it->is_string() ? it->get<std::string>() : "";
  };
  std::vector<std::string> names;
  if (!text(document, "schema").starts_with(fmt::format("gonio.report.{}/", report))) return names;
  const auto add = [&](const char* pictures, std::initializer_list<std::string_view> endings) {
    const auto list = document.find(pictures);
    if (list == document.end() || !list->is_array()) return;
    for (const auto& picture : *list)
      if (const std::string id = text(picture, "id"); is_picture_id(id))
        for (const auto ending : endings) names.push_back(id + std::string(ending));
  };
  add("figures", {".svg", ".csv"});
  add("maps", {".svg", ".csv", ".exr"});
  return names;
}

Json figures_json(const Pictures& p) {
  const CurveStyles styles(p.figures);
  Json out = Json::array();
  for (const auto& f : p.figures) out.push_back(json(f, styles));
  return out;
}
Json maps_json(const Pictures& p) {
  Json out = Json::array();
  for (const auto& m : p.maps) out.push_back(json(m));
  return out;
}

}  // namespace gonio
