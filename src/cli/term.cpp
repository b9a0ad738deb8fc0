// gonio term: one factor of a model, evaluated on its own.
#include <algorithm>

#include "brdf/registry.h"
#include "cli/command.h"

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

Exit run(const Options& o) {
  const std::size_t term = find_term(o.id);
  std::map<std::string, double> parameters;
  for (auto& s : parse_settings(o.set)) {
    if (s.values.size() != 1)
      throw wrong_usage(fmt::format("{}: one number, a term has no channels", s.name));
    if (s.name == "roughness")
      parameters["alpha"] = s.values[0] * s.values[0];
    else
      parameters[s.name] = s.values[0];
  }
  std::map<std::string, std::vector<double>> at;
  for (auto& s : parse_settings(o.at)) at[s.name] = s.values;
  expect_read(catalogue()[term].about->id, at);
  const auto number = static_cast<Number>(index_of(number_names, o.number));
  const auto result = evaluate_term(term, number, parameters, at);

  if (!o.json) {
    for (const double v : result.values) fmt::print("{}\n", v);
    return Exit::done;
  }
  Json used = Json::object(), where = Json::object();
  for (const auto& [name, value] : result.parameters) used[name] = value;
  for (const auto& [name, values] : at) where[name] = values;
  fmt::print("{}\n", Json{{"id", catalogue()[term].about->id},
                          {"number", o.number},
                          {"parameters", used},
                          {"at", where},
                          {"values", result.values}}
                         .dump(2));
  return Exit::done;
}

}  // namespace

void add_term(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(app, action, "term",
                        "Evaluates one term; a masking term gives G2, or G1 when only nov is given",
                        "gonio term ndf.ggx --set alpha=0.25 --at noh=1,0.9 --json", o, run);
  c->add_option("ID", o->id, "Term, as `gonio models` lists it")->required();
  add_set(c, o->set);
  c->add_option(
       "--at", o->at,
       "Cosines: noh, nol, nov, voh or cos; of the tangent frame xoh, yoh, xol, yol, xov, yov; "
       "and sin2_theta_h = values")
      ->expected(1, 64)
      ->required();
  c->add_option("--number", o->number, "Number type: double or float")->check(one_of(number_names));
  add_output(c, *o);
}

}  // namespace gonio::cli
