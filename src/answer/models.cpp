#include "answer/models.h"

#include <algorithm>

#include "base/error.h"
#include "base/json/reader.h"
#include "base/letters.h"
#include "brdf/formula/widths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// True where a word stands in a text, whatever its case.
bool holds(std::string_view text, std::string_view word) {
  return std::ranges::search(text, word, {}, lower_case, lower_case).begin() != text.end() ||
         word.empty();
}

Json describe(const Parameter& p) {
  return {{"name", p.name},
          {"low", p.legal.low},
          {"high", p.legal.high},
          {"fit_low", p.fit.low},
          {"fit_high", p.fit.high},
          {"default", p.start},
          {"per_channel", p.per_channel},
          {"meaning", p.meaning}};
}

Json describe(const About& about, std::span<const Parameter> parameters) {
  Json list = Json::array();
  for (const auto& p : parameters) list.push_back(describe(p));
  return {{"id", about.id},
          {"title", about.title},
          {"formula", about.formula},
          {"source", about.source},
          {"ships", about.ships},
          {"approximates", about.approximates},
          {"named_for", about.named_for},
          {"parameters", list}};
}

}  // namespace

CatalogueEntries entries_with(const std::string& word) {
  const auto wanted = [&](const About& a, std::span<const Parameter> parameters) {
    return holds(a.id, word) || holds(a.title, word) || holds(a.source, word) ||
           std::ranges::find(parameters, word, &Parameter::name) != parameters.end();
  };
  CatalogueEntries e;
  for (const auto& t : catalogue())
    if (wanted(*t.about, t.parameters) || (t.anisotropic && word == tangent_parameter.name))
      e.terms.push_back(&t);
  for (const auto& m : maps())
    if (wanted(*m.about, m.parameters)) e.maps.push_back(&m);
  for (const auto& p : presets())
    if (wanted(p.about, p.parameters)) e.presets.push_back(&p);
  for (const auto& by : evaluated_by_commands())
    if (wanted(*by.about, {})) e.evaluated.push_back(&by);
  for (const auto& m : metals())
    if (holds(m.symbol, word) || holds(m.name, word)) e.metals.push_back(&m);
  if (e.terms.empty() && e.maps.empty() && e.presets.empty() && e.evaluated.empty() &&
      e.metals.empty())
    throw wrong_usage(fmt::format(
        "no id, title or source of the catalogue holds '{}', and no parameter is called so", word));
  return e;
}

std::string to_json(const CatalogueEntries& e) {
  Json terms = Json::array(), map = Json::array(), model = Json::array(), metal = Json::array();
  for (const auto* t : e.terms) {
    terms.push_back(describe(*t->about, t->parameters));
    if (t->anisotropic)
      terms.back()["model_parameters"] = Json::array({describe(tangent_parameter)});
  }
  for (const auto* m : e.maps) {
    map.push_back(describe(*m->about, m->parameters));
    map.back()["outputs"] = m->outputs;
  }
  for (const auto* p : e.presets) {
    model.push_back(describe(p->about, p->parameters));
    model.back()["spec"] = p->spec;
  }
  for (const auto* by : e.evaluated) model.push_back(describe(*by->about, {}));
  for (const auto* m : e.metals) {
    Json n = Json::array(), k = Json::array();
    for (const auto& index : m->rgb()) n.push_back(index.n), k.push_back(index.k);
    metal.push_back(
        {{"symbol", m->symbol}, {"name", m->name}, {"n", n}, {"k", k}, {"source", m->source}});
  }
  return text_of({{"terms", terms}, {"maps", map}, {"models", model}, {"metals", metal}});
}

}  // namespace gonio
