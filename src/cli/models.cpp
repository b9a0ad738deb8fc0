// gonio models: what there is.
#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/widths.h"
#include "brdf/model/presets.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "integrate/light/split_sum.h"
#include "integrate/scattering/compensation.h"
#include "optics/refractive_index.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : Common {
  std::string word;
};

/// True where a word stands in a text, whatever its case.
bool holds(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return std::ranges::search(text, word, same).begin() != text.end() || word.empty();
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
          {"seed", about.seed},
          {"ships", about.ships},
          {"approximates", about.approximates},
          {"named_for", about.named_for},
          {"parameters", list}};
}

/// Where the texts begin, right of the ids.
constexpr int indent = 40;

void print(const Parameter& p, std::string_view of = "") {
  fmt::print("{:{}}{} in [{}, {}]{}, default {}: {}{}\n", "", indent, p.name, p.legal.low,
             p.legal.high, p.per_channel ? ", per channel" : "", p.start, p.meaning, of);
}

void print(const About& about, std::span<const Parameter> parameters) {
  fmt::print("{:<{}}{}\n{:{}}{}\n", about.id, indent, about.title, "", indent, about.formula);
  if (!about.reference().empty())
    fmt::print("{:{}}{} {}\n", "", indent, about.named_for.empty() ? "stands for" : "differs from",
               about.reference());
  if (!about.source.empty()) fmt::print("{:{}}from {}\n", "", indent, about.source);
  if (!about.ships.empty()) fmt::print("{:{}}shipped by {}\n", "", indent, about.ships);
  for (const auto& p : parameters) print(p);
}

/// A term, and what a model that has it gets beside the term's own parameters.
void print(const TermEntry& t) {
  print(*t.about, t.parameters);
  if (t.anisotropic) print(tangent_parameter, ", of a whole model");
}

void print(const Preset& p) {
  print(p.about, p.parameters);
  fmt::print("{:{}}= {}\n", "", indent, p.spec);
}
void print(const Evaluated& e) {
  print(*e.about, {});
  fmt::print("{:{}}= {}\n", "", indent, e.by);
}

void print_all() {
  for (const auto& t : catalogue()) print(t);
  fmt::print("\nMaps from parameters to parameters (`gonio term` evaluates them too):\n");
  for (const auto& m : maps()) print(*m.about, m.parameters);
  fmt::print("\nWhole models, by their id less the prefix (--model gltf):\n");
  for (const auto& p : presets()) print(p);
  for (const auto& e : evaluated_by_commands()) print(e);
  fmt::print(
      "\nOther models are [DIFFUSE+]NDF/MASKING/FRESNEL[+LOBE…], by these names less their "
      "prefix:\n"
      "  lambert+ggx/smith_ggx.correlated/schlick\n"
      "Metals (metal=Au sets eta and k at 650, 550 and 450 nm):");
  for (const auto& m : metals()) fmt::print(" {}", m.symbol);
  fmt::print("\n");
}

Exit run(const Options& o) {
  const auto wanted = [&](const About& a, std::span<const Parameter> parameters) {
    return holds(a.id, o.word) || holds(a.title, o.word) || holds(a.source, o.word) ||
           std::ranges::find(parameters, o.word, &Parameter::name) != parameters.end();
  };
  const auto wanted_term = [&](const TermEntry& t) {
    return wanted(*t.about, t.parameters) || (t.anisotropic && o.word == tangent_parameter.name);
  };
  const auto wanted_metal = [&](const Material& m) {
    return holds(m.symbol, o.word) || holds(m.name, o.word);
  };
  std::size_t found = 0;
  for (const auto& t : catalogue()) found += wanted_term(t);
  for (const auto& m : maps()) found += wanted(*m.about, m.parameters);
  for (const auto& p : presets()) found += wanted(p.about, p.parameters);
  for (const auto& e : evaluated_by_commands()) found += wanted(*e.about, {});
  for (const auto& m : metals()) found += wanted_metal(m);
  if (found == 0)
    throw wrong_usage(fmt::format(
        "no id, title or source of the catalogue holds '{}', and no parameter is called so",
        o.word));
  if (o.json) {
    Json terms = Json::array(), map = Json::array(), model = Json::array(), metal = Json::array();
    for (const auto& t : catalogue())
      if (wanted_term(t)) {
        terms.push_back(describe(*t.about, t.parameters));
        if (t.anisotropic)
          terms.back()["model_parameters"] = Json::array({describe(tangent_parameter)});
      }
    for (const auto& m : maps()) {
      if (!wanted(*m.about, m.parameters)) continue;
      map.push_back(describe(*m.about, m.parameters));
      map.back()["outputs"] = m.outputs;
    }
    for (const auto& p : presets()) {
      if (!wanted(p.about, p.parameters)) continue;
      model.push_back(describe(p.about, p.parameters));
      model.back()["spec"] = p.spec;
    }
    for (const auto& e : evaluated_by_commands())
      if (wanted(*e.about, {})) model.push_back(describe(*e.about, {}));
    for (const auto& m : metals()) {
      if (!wanted_metal(m)) continue;
      Json n = Json::array(), k = Json::array();
      for (const auto& index : m.rgb()) n.push_back(index.n), k.push_back(index.k);
      metal.push_back(
          {{"symbol", m.symbol}, {"name", m.name}, {"n", n}, {"k", k}, {"source", m.source}});
    }
    print_document({{"terms", terms}, {"maps", map}, {"models", model}, {"metals", metal}});
    return Exit::done;
  }
  if (o.word.empty()) {
    print_all();
    return Exit::done;
  }
  for (const auto& t : catalogue())
    if (wanted_term(t)) print(t);
  for (const auto& m : maps())
    if (wanted(*m.about, m.parameters)) print(*m.about, m.parameters);
  for (const auto& p : presets())
    if (wanted(p.about, p.parameters)) print(p);
  for (const auto& e : evaluated_by_commands())
    if (wanted(*e.about, {})) print(e);
  for (const auto& m : metals())
    if (wanted_metal(m)) fmt::print("{:<{}}{} (metal={})\n", m.symbol, indent, m.name, m.symbol);
  return Exit::done;
}

}  // namespace

std::span<const Evaluated> evaluated_by_commands() {
  static constexpr Evaluated all[] = {
      {&split_sum_about, "gonio split_sum"},
      {&walk_about, "gonio albedo --scattering walk"},
      {&deterministic_about, "gonio albedo --scattering deterministic"}};
  return all;
}

void add_models(CommandLine& line) {
  auto [c, o] =
      line.command("models", "The terms that models are composed of, maps and whole models",
                   "gonio models ggx --json", run);
  c.option(
      "WORD", o->word,
      "Only those that hold it in their id, title or source, or have a parameter of that name");
  add_output(c, *o);
}

}  // namespace gonio::cli
