// gonio models: what there is.
#include "answer/models.h"

#include "answer/file_functions.h"
#include "brdf/formula/widths.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct ModelsCall : Common {
  std::string word;
  ReadingWords reading;
};

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

Exit run(const ModelsCall& o) {
  if (foreign::is_name(o.word)) {
    const auto all = file_functions(read_as(o.word, o.reading));
    fmt::print("{}", o.json ? to_json(all) : text_of(all));
    return Exit::done;
  }
  const CatalogueEntries found = entries_with(o.word);
  if (o.json) {
    fmt::print("{}", to_json(found));
    return Exit::done;
  }
  if (o.word.empty()) {
    print_all();
    return Exit::done;
  }
  for (const auto* t : found.terms) print(*t);
  for (const auto* m : found.maps) print(*m->about, m->parameters);
  for (const auto* p : found.presets) print(*p);
  for (const auto* e : found.evaluated) print(*e);
  for (const auto* m : found.metals)
    fmt::print("{:<{}}{} (metal={})\n", m->symbol, indent, m->name, m->symbol);
  return Exit::done;
}

}  // namespace

void add_models(CommandLine& line) {
  auto [c, o] = line.command<ModelsCall>(
      "models", "The terms that models are composed of, maps and whole models",
      "gonio models ggx --json", run);
  c.option(
      "WORD", o->word,
      "Only those that hold it in their id, title or source, or have a parameter of that name; or "
      "a shader, FILE[:FUNCTION], whose functions are listed");
  add_reading(c, o->reading);
  add_output(c, *o);
}

}  // namespace gonio::cli
