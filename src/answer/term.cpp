#include "answer/term.h"

#include <algorithm>

#include "base/error.h"
#include "base/json/reader.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "brdf/model/roughness.h"
#include "integrate/light/split_sum.h"
#include "integrate/scattering/compensation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// An angle that no formula of the term's role reads would be ignored without a word.
void expect_read(std::string_view id, const std::map<std::string, std::vector<double>>& at) {
  static const std::map<Role, std::vector<std::string>> read{
      {Role::ndf, {"noh", "sin2_theta_h", "xoh", "yoh"}},
      {Role::masking, {"nol", "nov", "noh", "voh", "xol", "yol", "xov", "yov"}},
      {Role::fresnel, {"cos", "voh"}},
      {Role::diffuse, {"nol", "nov", "noh", "cos", "voh"}}};
  const auto& names = read.at(role_of(id));
  for (const auto& [name, values] : at)
    if (std::ranges::find(names, name) == names.end())
      throw wrong_usage(fmt::format("{} does not read '{}'; terms of its kind read: {}", id, name,
                                    fmt::join(names, ", ")));
}

/// The parameters with alpha in place of roughness, where the term has none of that name.
std::map<std::string, double> with_alpha(const TermEntry& entry,
                                         std::map<std::string, double> parameters) {
  const bool has_roughness =
      std::ranges::find(entry.parameters, "roughness", &Parameter::name) != entry.parameters.end();
  if (const auto r = parameters.find("roughness"); r != parameters.end() && !has_roughness) {
    if (!parameters.emplace(alpha_name(r->first), alpha_of(r->second)).second)
      throw wrong_usage("alpha and roughness are the same parameter");
    parameters.erase(r);
  }
  return parameters;
}

}  // namespace

TermAnswer answer(const TermQuestion& q) {
  const auto number = value_of<Number>(q.number, "number");
  if (const auto map = find_map(q.id)) {
    const auto& entry = maps()[*map];
    auto result = evaluate_map(*map, number, q.parameters, q.at);
    return {entry.about, std::move(result.parameters), entry.outputs, std::move(result.values)};
  }
  for (const auto& e : evaluated_by_commands())
    if (q.id == e.about->id)
      throw wrong_usage(
          fmt::format("{} is no formula of a few numbers: {} evaluates it", q.id, e.by));
  const std::size_t term = find_term(q.id);
  const auto& entry = catalogue()[term];
  const auto parameters = with_alpha(entry, q.parameters);
  if (q.at.empty()) throw wrong_usage(fmt::format("{} needs --at with angles", entry.about->id));
  expect_read(entry.about->id, q.at);
  auto result = evaluate_term(term, number, parameters, q.at);
  TermAnswer a{entry.about, std::move(result.parameters), {}, {}};
  for (const double v : result.values) a.values.push_back({v});
  return a;
}

std::string to_json(const TermAnswer& a, const TermQuestion& q) {
  Json used = Json::object(), where = Json::object(), values = Json::array();
  for (const auto& [name, value] : a.parameters) used[name] = value;
  for (const auto& [name, column] : q.at) where[name] = column;
  for (const auto& row : a.values) values.push_back(row.size() == 1 ? Json(row[0]) : Json(row));
  Json document{{"id", a.about->id}, {"number", q.number}, {"parameters", used}, {"at", where}};
  if (!a.outputs.empty()) document["outputs"] = a.outputs;
  document["values"] = values;
  return text_of(document);
}

std::span<const Evaluated> evaluated_by_commands() {
  static constexpr Evaluated all[] = {
      {&split_sum_about, "gonio split_sum"},
      {&walk_about, "gonio albedo --scattering walk"},
      {&deterministic_about, "gonio albedo --scattering deterministic"}};
  return all;
}

}  // namespace gonio
