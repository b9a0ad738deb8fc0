#include "brdf/model/model_names.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "brdf/catalogue/registry.h"
#include "brdf/model/model.h"
#include "brdf/model/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

/// Words for the terms that are fitted often; others go by their title.
constexpr std::pair<std::string_view, std::string_view> words[] = {
    {"ndf.gtr", "GTR"},
    {"ndf.student_t", "Student's t"},
    {"fresnel.schlick", "Schlick"},
    {"fresnel.schlick.f90", "Schlick with F90"},
    {"fresnel.schlick.weighted", "weighted Schlick"},
    {"fresnel.dielectric", "dielectric"},
    {"fresnel.conductor", "conductor"},
    {"diffuse.lambert.coupled", "Lambert (coupled)"},
    {"diffuse.disney.coupled", "Disney's diffuse (coupled)"}};

/// Title without what follows in brackets or after a comma.
std::string word_of(std::size_t term) {
  const About& about = *catalogue()[term].about;
  const auto at = std::ranges::find(words, about.id, [](const auto& w) { return w.first; });
  if (at != std::end(words)) return std::string(at->second);
  return std::string(
      about.title.substr(0, std::min(about.title.find(','), about.title.find(" ("))));
}

std::string lobe_name(const Lobe& l, bool masking) {
  const std::string in_brackets =
      masking ? fmt::format("; {}", catalogue()[l.masking.term].about->title) : "";
  return fmt::format("{} ({}{})", word_of(l.ndf.term), word_of(l.fresnel.term), in_brackets);
}

std::string name_of_model(const std::string& model, bool masking) {
  if (const Preset* preset = find_preset(model)) return std::string(preset->about.title);
  const Model m = compose(model, 1);
  std::vector<std::string> parts;
  for (const auto& d : m.diffuse) parts.push_back(word_of(d.term));
  std::vector<std::pair<std::string, std::size_t>> lobes;
  for (std::size_t i = 0; i < m.lobes.size(); ++i) {
    const Lobe& l = m.lobes[i];
    const bool again = i > 0 && m.lobes[i - 1].ndf.term == l.ndf.term &&
                       m.lobes[i - 1].masking.term == l.masking.term &&
                       m.lobes[i - 1].fresnel.term == l.fresnel.term;
    if (again)
      ++lobes.back().second;
    else
      lobes.emplace_back(lobe_name(l, masking), 1);
  }
  constexpr std::array<std::string_view, 4> counts{"", "two ", "three ", "four "};
  for (const auto& [name, n] : lobes)
    parts.push_back(n <= counts.size() ? std::string(counts[n - 1]) + name
                                       : fmt::format("{} {}", n, name));
  return fmt::to_string(fmt::join(parts, " + "));
}

}  // namespace

std::vector<std::string> model_names(std::span<const std::string> models) {
  std::vector<std::string> names;
  for (const auto& m : models) names.push_back(name_of_model(m, false));
  const auto first = names;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::ranges::count(first, first[k]) > 1) names[k] = name_of_model(models[k], true);
  const auto second = names;
  for (std::size_t k = 0; k < names.size(); ++k)  // forms of one title
    if (std::ranges::count(second, second[k]) > 1) names[k] = models[k];
  return names;
}

}  // namespace gonio
