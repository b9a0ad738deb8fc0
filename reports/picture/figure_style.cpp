// Which of the looks of curves a name has.
#include <algorithm>
#include <set>

#include "reports/picture/figure.h"

namespace gonio {
namespace {

using Names = std::set<std::string, std::less<>>;

const std::string& look_of(const FigureCurve& c) {
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
      const auto& name = *own.insert(look_of(c)).first;
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
  for (const auto& name : names) {
    const std::size_t i = least_free(of_family[name]);
    out[name] = i < most ? i : least_free(of_picture[name]);
  }
  return out;
}

}  // namespace

CurveStyles::CurveStyles(std::span<const Figure> figures)
    : lines_(numbered(figures, false, 12)), references_(numbered(figures, true, 3)) {}

std::size_t CurveStyles::of(const FigureCurve& c) const {
  return (c.dashed ? references_ : lines_).at(look_of(c));
}

}  // namespace gonio
