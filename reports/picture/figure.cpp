#include "reports/picture/figure.h"

#include <algorithm>

namespace gonio {
namespace {

template <class Picture>
Picture made(std::string family, FigureChoices choices) {
  Picture p;
  p.id = picture_id(family, choices);
  p.family = std::move(family);
  p.choices = std::move(choices);
  return p;
}

}  // namespace

std::string picture_id(std::string_view family, const FigureChoices& choices) {
  std::string out;
  const auto add = [&](std::string_view part) {
    if (!out.empty() && out.back() != '_') out += '_';
    for (const char c : part)
      if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z'))
        out += c;
      else if (c >= 'A' && c <= 'Z')
        out += static_cast<char>(c - 'A' + 'a');
      else if (!out.empty() && out.back() != '_')
        out += '_';
  };
  add(family);
  for (const auto& [of, chosen] : choices) add(chosen);
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

Figure make_figure(std::string family, FigureChoices choices) {
  return made<Figure>(std::move(family), std::move(choices));
}
FigureMap make_map(std::string family, FigureChoices choices) {
  return made<FigureMap>(std::move(family), std::move(choices));
}

FigureCurve& curve_named(Figure& f, std::string_view name, FigureCurve::Kind kind) {
  const auto at = std::ranges::find(f.curves, name, &FigureCurve::name);
  if (at != f.curves.end()) return *at;
  return f.curves.emplace_back(FigureCurve{std::string(name), {}, {}, kind});
}

}  // namespace gonio
