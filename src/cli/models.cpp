// gonio models: what there is.
#include "brdf/registry.h"
#include "cli/command.h"
#include "optics/refractive_index.h"

#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : Common {};

Json describe(const TermKernels<double>& t) {
  Json parameters = Json::array();
  for (const auto& p : t.parameters)
    parameters.push_back({{"name", p.name},
                          {"low", p.legal.low},
                          {"high", p.legal.high},
                          {"fit_low", p.fit.low},
                          {"fit_high", p.fit.high},
                          {"default", p.start},
                          {"per_channel", p.per_channel},
                          {"meaning", p.meaning}});
  return {{"id", t.about->id},
          {"title", t.about->title},
          {"formula", t.about->formula},
          {"source", t.about->source},
          {"parameters", parameters}};
}

Exit run(const Options& o) {
  if (o.json) {
    Json terms = Json::array(), metal = Json::array();
    for (const auto& t : catalogue()) terms.push_back(describe(t));
    for (const auto& m : metals())
      metal.push_back(
          {{"symbol", m.symbol}, {"name", m.name}, {"n", m.n}, {"k", m.k}, {"source", m.source}});
    fmt::print("{}\n", Json{{"terms", terms}, {"metals", metal}}.dump(2));
    return Exit::done;
  }
  for (const auto& t : catalogue()) {
    fmt::print("{:<30}{}\n{:30}{}\n", t.about->id, t.about->title, "", t.about->formula);
    for (const auto& p : t.parameters)
      fmt::print("{:30}{} in [{}, {}]{}, default {}: {}\n", "", p.name, p.legal.low, p.legal.high,
                 p.per_channel ? ", per channel" : "", p.start, p.meaning);
  }
  fmt::print(
      "\nA model is [DIFFUSE+]NDF/MASKING/FRESNEL[+LOBE…], by these names less their prefix:\n"
      "  lambert+ggx/smith_ggx.correlated/schlick\n"
      "Metals (metal=Au sets eta and k at 650, 550 and 450 nm):");
  for (const auto& m : metals()) fmt::print(" {}", m.symbol);
  fmt::print("\n");
  return Exit::done;
}

}  // namespace

void add_models(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(app, action, "models", "The terms that models are composed of",
                        "gonio models --json", o, run);
  add_output(c, *o);
}

}  // namespace gonio::cli
