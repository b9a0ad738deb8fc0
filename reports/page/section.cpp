#include "reports/page/section.h"

#include <algorithm>

#include "base/text.h"
#include "reports/finding/names.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

/// \param use  called with each picture of the family and its choices
template <class Use>
void each_of(const Pictures& p, std::string_view family, Use use) {
  for (const auto& f : p.figures)
    if (f.family == family) use(f.choices);
  for (const auto& m : p.maps) {
    if (m.family != family) continue;
    if (m.slices.empty()) use(m.choices);
    for (const auto& slice : m.slices) {
      auto choices = m.choices;
      choices.emplace_back("at", slice);
      use(choices);
    }
  }
}
bool has_all(const FigureChoices& own, const FigureChoices& asked) {
  return std::ranges::all_of(asked,
                             [&](const auto& c) { return std::ranges::find(own, c) != own.end(); });
}
std::string value_of_key(const FigureChoices& choices, std::string_view key) {
  const auto at = std::ranges::find(choices, key, [](const auto& c) { return c.first; });
  return at == choices.end() ? std::string() : at->second;
}

}  // namespace

std::vector<Column> columns(std::string_view names) {
  std::vector<Column> out;
  for (auto& name : split(names, '|')) {
    const bool number = name.starts_with('>');
    out.push_back({number ? name.substr(1) : std::move(name), number});
  }
  return out;
}

Cell form_cell(std::string_view form) {
  const auto name = name_of_form(form);
  if (name == form) return fmt::format("`{}`", form);
  return {name, {}, fmt::format("`{}`", form.substr(form.find('.') + 1)), "form"};
}

std::string bar(double part) {
  return fmt::format(R"(<span class="bar" style="width:{:.0f}px"></span>)", 80 * part);
}

Slot slot_of(const Pictures& p,
             std::string_view family,
             const std::vector<Control>& controls,
             double height,
             const FigureChoices& fixed) {
  Slot out;
  each_of(p, family, [&](const FigureChoices& choices) {
    if (!has_all(choices, fixed)) return;
    Alternative one;
    for (const auto& c : controls) one.chosen.push_back(value_of_key(choices, c.key));
    one.parts.emplace_back(Shown{std::string(family), choices, height});
    out.each.push_back(std::move(one));
  });
  return out;
}
std::vector<Part> opening(const Pictures& p,
                          std::string_view family,
                          FigureChoices choices,
                          double height) {
  std::vector<Part> out;
  each_of(p, family, [&](const FigureChoices& own) {
    if (out.empty() && has_all(own, choices))
      out.emplace_back(Shown{std::string(family), own, height, {}, true});
  });
  return out;
}
bool has_family(const Pictures& p, std::string_view family) {
  bool is = false;
  each_of(p, family, [&](const auto&) { is = true; });
  return is;
}
std::vector<std::string> values_of(const Pictures& p,
                                   std::string_view family,
                                   std::string_view key) {
  std::vector<std::string> out;
  each_of(p, family, [&](const FigureChoices& choices) {
    auto value = value_of_key(choices, key);
    if (std::ranges::find(out, value) == out.end()) out.push_back(std::move(value));
  });
  return out;
}

}  // namespace gonio::page
