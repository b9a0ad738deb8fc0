// Pictures in the document of a page.
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "reports/picture/figure_scale.h"
#include "reports/picture/json_numbers.h"

#include <fmt/format.h>

namespace gonio {
namespace {

PageJson json(const FigureAxis& a) {
  PageJson out{{"label", a.label}, {"log", a.log}};
  if (std::isfinite(a.from)) out["from"] = a.from;
  if (std::isfinite(a.to)) out["to"] = a.to;
  return out;
}

PageJson json(const FigureMap::Axis& a) {
  const auto edges = cell_edges(a);
  PageJson out{{"label", a.label}, {"log", a.log}, {"edges", page_json(edges)}};
  if (a.names.empty()) {
    const FigureScale scale{edges.front(), edges.back(), a.log};
    out["at"] = page_json(a.at);
    out["ticks"] = page_json(scale_ticks(scale, 7));
    out["few"] = page_json(scale_ticks(scale, 3));
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
PageJson json(const Figure& f, std::size_t i, const CurveStyles& styles) {
  static constexpr std::string_view kinds[]{"line", "points", "both"};
  const auto& c = f.curves[i];
  PageJson out{
      {"name", c.name}, {"kind", kinds[static_cast<std::size_t>(c.kind)]}, {"style", styles.of(c)}};
  if (c.dashed) out["dashed"] = true;
  if (i == 0 || f.curves[i - 1].x != c.x) out[key("x", f.x)] = page_json(c.x);
  out[key("y", f.y)] = page_json(c.y);
  if (!c.labels.empty()) out["labels"] = c.labels;
  if (!c.x_error.empty()) out[key("x_error", f.x)] = page_json(c.x_error);
  if (!c.y_error.empty()) out[key("y_error", f.y)] = page_json(c.y_error);
  return out;
}

PageJson json(const std::vector<std::pair<std::string, std::string>>& choices) {
  PageJson out = PageJson::object();
  for (const auto& [of, chosen] : choices) out[of] = chosen;
  return out;
}

bool is_picture_id(std::string_view id) {
  return !id.empty() && id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == id.npos;
}

}  // namespace

std::vector<std::string> picture_files(std::string_view json, std::string_view report) {
  using Json = nlohmann::json;  // of keys in their order each would be looked for among all
  const auto document = Json::parse(json, nullptr, false);
  const auto text = [](const Json& object, const char* key) -> std::string {
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

PageJson page_json(const Figure& f, const CurveStyles& styles) {
  PageJson curves = PageJson::array();
  for (std::size_t i = 0; i < f.curves.size(); ++i) curves.push_back(json(f, i, styles));
  return {{"id", f.id},       {"family", f.family}, {"choices", json(f.choices)},
          {"title", f.title}, {"note", f.note},     {"x", json(f.x)},
          {"y", json(f.y)},   {"curves", curves}};
}

PageJson page_json(const FigureMap& m) {
  static constexpr std::string_view scales[]{"linear", "root", "log"};
  const auto colours = colour_scale(m);
  PageJson out{{"id", m.id},
               {"family", m.family},
               {"choices", json(m.choices)},
               {"title", m.title},
               {"note", m.note},
               {"x", json(m.x)},
               {"y", json(m.y)},
               {"value", m.value},
               {"diverging", m.diverging},
               {"scale", scales[static_cast<std::size_t>(m.scale)]},
               {"low", page_json(colours.low)},
               {"high", page_json(colours.high)},
               {"ticks", page_json(colours.ticks)},
               {"values", page_json(m.values)}};
  if (!m.slices.empty()) out["slices"] = m.slices;
  return out;
}

void put_pictures(PageJson& document, const Pictures& p) {
  const CurveStyles styles(p.figures);
  PageJson figures = PageJson::array();
  for (const auto& f : p.figures) figures.push_back(page_json(f, styles));
  document["figures"] = std::move(figures);
  document["maps"] = page_json(p.maps);
}

}  // namespace gonio
