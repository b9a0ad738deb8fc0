#include "reports/picture/figure_style.h"

#include <algorithm>
#include <array>
#include <map>
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

const std::string& look_name(const FigureCurve& c) {
  return c.look.empty() ? c.name : c.look;
}

/// Numbers taken by the curves of a picture, or of a family of pictures.
struct Taken {
  std::set<std::size_t> numbers;
  std::size_t least_free = 0;
  void take(std::size_t i) {
    numbers.insert(i);
    while (numbers.contains(least_free)) ++least_free;
  }
};

/// The least number that is free in all of them.
std::size_t least_free(const std::set<Taken*>& in) {
  std::size_t i = 0;
  for (const Taken* t : in) i = std::max(i, t->least_free);
  while (std::ranges::any_of(in, [&](const Taken* t) { return t->numbers.contains(i); })) ++i;
  return i;
}

/// Each takes the least number that none of its neighbours has taken before it.
/// \param most  numbers beyond go by neighbours in a picture, the others by those in a family of pictures
CurveStyles::Numbers numbered(std::span<const Figure> figures, bool dashed, std::size_t most) {
  struct Where {
    std::set<Taken*> pictures, families;
  };
  std::vector<Taken> pictures(figures.size());
  std::map<std::string, Taken> families;
  std::map<std::string, Where> where;
  std::vector<std::string> names;  // as they appear
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const Figure& f = figures[k];
    for (const auto& c : f.curves) {
      if (c.dashed != dashed) continue;
      const auto [at, is_new] = where.try_emplace(look_name(c));
      if (is_new) names.push_back(at->first);
      at->second.pictures.insert(&pictures[k]);
      at->second.families.insert(&families[f.family.empty() ? f.id : f.family]);
    }
  }

  CurveStyles::Numbers out;
  const auto take = [&](const std::string& name, std::size_t i) {
    out[name] = i;
    for (const auto* all : {&where[name].pictures, &where[name].families})
      for (Taken* t : *all) t->take(i);
  };
  if (!dashed && where.contains("r") && where.contains("g") && where.contains("b"))
    for (const auto& [name, i] : {std::pair{"b", 0U}, {"r", 1U}, {"g", 2U}})
      take(name, i);  // channels have their own colours
  for (const auto& name : names) {
    if (out.contains(name)) continue;
    const std::size_t i = least_free(where[name].families);
    take(name, i < most ? i : least_free(where[name].pictures));
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
