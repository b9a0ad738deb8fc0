// gonio models: what there is.
#include "brdf/catalogue/registry.h"
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

struct Options : Common {};

Json describe(const About& about, std::span<const Parameter> parameters) {
  Json list = Json::array();
  for (const auto& p : parameters)
    list.push_back({{"name", p.name},
                    {"low", p.legal.low},
                    {"high", p.legal.high},
                    {"fit_low", p.fit.low},
                    {"fit_high", p.fit.high},
                    {"default", p.start},
                    {"per_channel", p.per_channel},
                    {"meaning", p.meaning}});
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

void print(const About& about, std::span<const Parameter> parameters) {
  fmt::print("{:<{}}{}\n{:{}}{}\n", about.id, indent, about.title, "", indent, about.formula);
  if (!about.reference().empty())
    fmt::print("{:{}}{} {}\n", "", indent, about.named_for.empty() ? "stands for" : "differs from",
               about.reference());
  for (const auto& p : parameters)
    fmt::print("{:{}}{} in [{}, {}]{}, default {}: {}\n", "", indent, p.name, p.legal.low,
               p.legal.high, p.per_channel ? ", per channel" : "", p.start, p.meaning);
}

Exit run(const Options& o) {
  if (o.json) {
    Json terms = Json::array(), map = Json::array(), model = Json::array(), metal = Json::array();
    for (const auto& t : catalogue()) terms.push_back(describe(*t.about, t.parameters));
    for (const auto& m : maps()) {
      map.push_back(describe(*m.about, m.parameters));
      map.back()["outputs"] = m.outputs;
    }
    for (const auto& p : presets()) {
      model.push_back(describe(p.about, p.parameters));
      model.back()["spec"] = p.spec;
    }
    for (const auto& e : evaluated_by_commands()) model.push_back(describe(*e.about, {}));
    for (const auto& m : metals()) {
      Json n = Json::array(), k = Json::array();
      for (const auto& index : m.rgb()) n.push_back(index.n), k.push_back(index.k);
      metal.push_back(
          {{"symbol", m.symbol}, {"name", m.name}, {"n", n}, {"k", k}, {"source", m.source}});
    }
    print_document({{"terms", terms}, {"maps", map}, {"models", model}, {"metals", metal}});
    return Exit::done;
  }
  for (const auto& t : catalogue()) print(*t.about, t.parameters);
  fmt::print("\nMaps from parameters to parameters (`gonio term` evaluates them too):\n");
  for (const auto& m : maps()) print(*m.about, m.parameters);
  fmt::print("\nWhole models, by their id less the prefix (--model gltf):\n");
  for (const auto& p : presets()) {
    print(p.about, p.parameters);
    fmt::print("{:{}}= {}\n", "", indent, p.spec);
  }
  for (const auto& e : evaluated_by_commands()) {
    print(*e.about, {});
    fmt::print("{:{}}= {}\n", "", indent, e.by);
  }
  fmt::print(
      "\nOther models are [DIFFUSE+]NDF/MASKING/FRESNEL[+LOBE…], by these names less their "
      "prefix:\n"
      "  lambert+ggx/smith_ggx.correlated/schlick\n"
      "Metals (metal=Au sets eta and k at 650, 550 and 450 nm):");
  for (const auto& m : metals()) fmt::print(" {}", m.symbol);
  fmt::print("\n");
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
                   "gonio models --json", run);
  add_output(c, *o);
}

}  // namespace gonio::cli
