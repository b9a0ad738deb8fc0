#include "reports/picture/figure_style.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::array<std::string_view, 6> line_colours{"accent", "red",  "green",
                                                       "extra",  "grey", "warn"};
/// Dashes of curves that share a colour: the first six, the next …
constexpr std::array<std::string_view, 6> rounds{"",     "2 3", "9 3 2 3",
                                                 "12 4", "1 4", "6 2 1 2 1 2"};
constexpr std::array<std::string_view, 3> reference_dashes{"6 4", "2 4", "10 3 2 3"};

constexpr std::array<std::string_view, 5> diverging{"low-2", "low-1", "zero", "high-1", "high-2"};
constexpr std::array<std::string_view, 3> sequential{"zero", "rms-1", "rms-2"};

constexpr std::pair<std::string_view, std::string_view> paper[] = {
    {"ink", "#1c1f23"},   {"accent", "#0b5fa5"}, {"red", "#c4500a"},    {"green", "#00795a"},
    {"extra", "#8b3f86"}, {"grey", "#4a4f55"},   {"warn", "#8a4b00"},   {"low-2", "#1b5fa8"},
    {"low-1", "#8fbfe0"}, {"zero", "#e9e7e0"},   {"high-1", "#f0a868"}, {"high-2", "#b3470b"},
    {"rms-1", "#a98fc4"}, {"rms-2", "#4c1f78"}};

using Names = std::set<std::string, std::less<>>;

const std::string& look_name(const FigureCurve& c) {
  return c.look.empty() ? c.name : c.look;
}

/// Each takes the least number that none of its neighbours has taken before it.
/// \param most  numbers beyond go by neighbours in a picture, the others by those in a family of pictures
CurveStyles::Numbers numbered(std::span<const Figure> figures, bool dashed, std::size_t most) {
  std::vector<std::string> names;  // as they appear
  std::map<std::string, Names> families, of_picture, of_family;
  for (const auto& f : figures) {
    Names own;
    for (const auto& c : f.curves) {
      if (c.dashed != dashed) continue;
      const auto& name = *own.insert(look_name(c)).first;
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    for (const auto& name : own) of_picture[name].insert(own.begin(), own.end());
    families[f.family.empty() ? f.id : f.family].insert(own.begin(), own.end());
  }
  for (const auto& [family, own] : families)
    for (const auto& name : own) of_family[name].insert(own.begin(), own.end());

  CurveStyles::Numbers out;
  const auto least_free = [&](const Names& neighbours) {
    std::set<std::size_t> taken;
    for (const auto& name : neighbours)
      if (const auto at = out.find(name); at != out.end()) taken.insert(at->second);
    std::size_t i = 0;
    while (taken.contains(i)) ++i;
    return i;
  };
  if (!dashed && of_picture.contains("r") && of_picture.contains("g") && of_picture.contains("b"))
    out = {{"b", 0}, {"r", 1}, {"g", 2}};  // channels have their own colours
  for (const auto& name : names) {
    if (out.contains(name)) continue;
    const std::size_t i = least_free(of_family[name]);
    out[name] = i < most ? i : least_free(of_picture[name]);
  }
  return out;
}

}  // namespace

CurveStyles::CurveStyles(std::span<const Figure> figures)
    : lines_(numbered(figures, false, 12)), references_(numbered(figures, true, 3)) {}

std::size_t CurveStyles::of(const FigureCurve& c) const {
  return (c.dashed ? references_ : lines_).at(look_name(c));
}

CurveLook look_of(const FigureCurve& c, const CurveStyles& styles) {
  const std::size_t i = styles.of(c);
  if (c.dashed) return {"ink", reference_dashes[i % reference_dashes.size()], 1.4};
  return {line_colours[i % line_colours.size()], rounds[i / line_colours.size() % rounds.size()],
          1.8};
}

std::string look_class(const FigureCurve& c, const CurveStyles& styles) {
  return fmt::format("{}{}", c.dashed ? 'r' : 'k', styles.of(c));
}

namespace {
std::string look_rule(std::string_view name, const CurveLook& look, std::string_view colour) {
  const auto dash =
      look.dash.empty() ? std::string() : fmt::format(";stroke-dasharray:{}", look.dash);
  return fmt::format(".{0}{{stroke:{1};stroke-width:{2}{3}}}", name, colour, look.width, dash);
}
}  // namespace

std::string paper_look(const FigureCurve& c, const CurveStyles& styles) {
  const auto look = look_of(c, styles);
  return look_rule(look_class(c, styles), look, paper_colour(look.colour));
}

std::string page_looks(const CurveStyles& styles, std::span<const Figure> figures) {
  std::map<std::string, std::string> rules;
  for (const auto& f : figures)
    for (const auto& c : f.curves) {
      const auto look = look_of(c, styles);
      const auto name = look_class(c, styles);
      rules.emplace(name, look_rule(name, look, fmt::format("var(--{})", look.colour)));
    }
  std::string out;
  for (const auto& [name, rule] : rules) out += rule;
  return out;
}

std::span<const std::string_view> colours_of(const FigureMap& m) {
  if (m.diverging) return diverging;
  return sequential;
}

std::string_view paper_colour(std::string_view name) {
  return std::ranges::find(paper, name, [](const auto& c) { return c.first; })->second;
}

}  // namespace gonio
