#include "scene/surface/effect.h"

#include <algorithm>

namespace gonio::scene {

std::span<const Form> forms_of(Effect effect) {
  static constexpr auto all = [] {
    std::array<Form, names_of<Form>.size()> forms;
    for (std::size_t i = 0; i < forms.size(); ++i) forms[i] = static_cast<Form>(i);
    return forms;
  }();
  const auto e = static_cast<std::size_t>(effect);
  const auto first = static_cast<std::size_t>(cheapest_forms[e]);
  const auto end =
      e + 1 < effect_count ? static_cast<std::size_t>(cheapest_forms[e + 1]) : all.size();
  return std::span(all).subspan(first, end - first);
}

std::optional<Form> find_form(Effect e, std::string_view name) {
  const auto all = forms_of(e);
  const auto at = std::ranges::find(all, name, name_of<Form>);
  return at == all.end() ? std::nullopt : std::optional(*at);
}

}  // namespace gonio::scene
