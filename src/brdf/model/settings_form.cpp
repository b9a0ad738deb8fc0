#include "brdf/model/settings_form.h"

#include <nlohmann/json.hpp>

namespace gonio {
namespace {

Json write(const void* value) {
  const auto& g = *static_cast<const GivenParameter*>(value);
  return g.word.empty() ? Json(g.values) : Json(g.word);
}

void read(const JsonReader& j, void* value) {
  auto& g = *static_cast<GivenParameter*>(value);
  if (j.is_number())
    g.values = {j.number()};
  else if (j.is_array()) {
    expect_array(j, {1, 3});
    for (std::size_t k = 0; k < j.size(); ++k) g.values.push_back(number_in(j.at(k), {}));
  } else if (j.is_string())
    g.word = text_in(j);
  else
    j.fail("a number, an array of numbers, or a metal's symbol");
}

Json schema() {
  return {{"anyOf",
           {{{"type", "number"}},
            {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 1}, {"maxItems", 3}},
            {{"type", "string"}, {"minLength", 1}}}}};
}

}  // namespace

const JsonForm given_parameter_json{write, read, schema};

std::vector<Setting> settings_of(const GivenParameters& parameters, const JsonReader& at) {
  std::vector<Setting> settings;
  for (const auto& [name, given] : parameters) {
    const bool is_metal = name == "metal";
    if (given.word.empty() == is_metal)
      at.at(name).fail(is_metal ? "a metal's symbol" : "a number, or one per channel");
    settings.push_back({name, given.values, given.word});
  }
  return settings;
}

}  // namespace gonio
