// gonio term: one factor of a model, evaluated on its own.
#include <algorithm>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "brdf/model/roughness.h"
#include "cli/command.h"
#include "cli/terminal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : Common {
  std::string id, number = "double";
  std::vector<std::string> set, at;
};

/// An angle that no formula of the term's role reads would be ignored without a word.
void expect_read(std::string_view id, const std::map<std::string, std::vector<double>>& at) {
  static const std::map<Role, std::vector<std::string>> read{
      {Role::ndf, {"noh", "sin2_theta_h", "xoh", "yoh"}},
      {Role::masking, {"nol", "nov", "noh", "voh", "xol", "yol", "xov", "yov"}},
      {Role::fresnel, {"cos", "voh"}},
      {Role::diffuse, {"nol", "nov", "cos", "voh"}}};
  const auto& names = read.at(role_of(id));
  for (const auto& [name, values] : at)
    if (std::ranges::find(names, name) == names.end())
      throw wrong_usage(fmt::format("{} does not read '{}'; terms of its kind read: {}", id, name,
                                    fmt::join(names, ", ")));
}

using Named = std::vector<std::pair<std::string, double>>;
using Columns = std::map<std::string, std::vector<double>>;

void print(const Options& o,
           const About& about,
           const Named& parameters,
           const Columns& at,
           const std::vector<std::string>& lines,
           const Json& values,
           std::span<const std::string_view> outputs = {}) {
  if (!o.json) {
    for (const auto& line : lines) fmt::print("{}\n", line);
    return;
  }
  Json used = Json::object(), where = Json::object();
  for (const auto& [name, value] : parameters) used[name] = value;
  for (const auto& [name, column] : at) where[name] = column;
  Json document{{"id", about.id}, {"number", o.number}, {"parameters", used}, {"at", where}};
  if (!outputs.empty()) document["outputs"] = outputs;
  document["values"] = values;
  print_document(document);
}

Exit run(const Options& o) {
  std::map<std::string, double> parameters;
  for (auto& s : parse_settings(o.set)) {
    if (s.values.size() != 1)
      throw wrong_usage(fmt::format("{}: one number, a term has no channels", s.name));
    parameters[s.name] = s.values[0];
  }
  Columns at;
  for (auto& s : parse_settings(o.at)) at[s.name] = s.values;
  const auto number = value_of<Number>(o.number, "number");

  std::vector<std::string> lines;
  if (const auto map = find_map(o.id)) {
    const auto& entry = maps()[*map];
    const auto result = evaluate_map(*map, number, parameters, at);
    Json values = Json::array();  // of a map with one output: numbers
    for (const auto& row : result.values) {
      lines.push_back(fmt::format("{}", fmt::join(row, " ")));
      values.push_back(row.size() == 1 ? Json(row[0]) : Json(row));
    }
    print(o, *entry.about, result.parameters, at, lines, values, entry.outputs);
    return Exit::done;
  }

  for (const auto& e : evaluated_by_commands())
    if (o.id == e.about->id)
      throw wrong_usage(
          fmt::format("{} is no formula of a few numbers: {} evaluates it", o.id, e.by));
  const std::size_t term = find_term(o.id);
  const auto& entry = catalogue()[term];
  const auto has = [&](std::string_view name) {
    return std::ranges::find(entry.parameters, name, &Parameter::name) != entry.parameters.end();
  };
  if (const auto r = parameters.find("roughness"); r != parameters.end() && !has("roughness")) {
    if (!parameters.emplace(alpha_name(r->first), alpha_of(r->second)).second)
      throw wrong_usage("alpha and roughness are the same parameter");
    parameters.erase(r);
  }
  if (at.empty()) throw wrong_usage(fmt::format("{} needs --at with angles", entry.about->id));
  expect_read(entry.about->id, at);
  const auto result = evaluate_term(term, number, parameters, at);
  for (const double v : result.values) lines.push_back(fmt::format("{}", v));
  print(o, *entry.about, result.parameters, at, lines, result.values);
  return Exit::done;
}

}  // namespace

void add_term(CommandLine& line) {
  auto [c, o] = line.command(
      "term", "Evaluates one term or map; a masking term gives G2, or G1 when only nov is given",
      "gonio term ndf.ggx --set alpha=0.25 --at noh=1,0.9 --json", run);
  c.option("ID", o->id, "Term or map, as `gonio models` lists it").required();
  add_set(c, o->set);
  c.option("--at", o->at,
           "Cosines: noh, nol, nov, voh or cos; of the tangent frame xoh, yoh, xol, yol, xov, yov; "
           "and sin2_theta_h = values")
      .at_most(64);
  c.option("--number", o->number,
           "Number type: double; float; half, rounded after every operation; wide, fifty "
           "digits; mixed, half parameters and float angles")
      .one_of(names_of<Number>);
  add_output(c, *o);
}

}  // namespace gonio::cli
