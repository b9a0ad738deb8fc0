#pragma once
/// \file
/// Parameters of a model as a document gives them: numbers, or a metal's symbol.
/// Dear to compile: for .cpp files only.

#include <string>
#include <utility>
#include <vector>

#include "base/json/form.h"
#include "brdf/model/given_parameter.h"
#include "brdf/model/spec.h"

namespace gonio {

inline void read_own(const JsonReader& j, GivenParameter& g) {
  constexpr Entries channels{1, 3};
  if (j.is_number())
    g.values = {j.number()};
  else if (j.is_array())
    for (const auto& v : entries_in(j, channels)) g.values.push_back(number_in(v, {}));
  else if (j.is_string())
    g.word = text_in(j);
  else
    j.fail("a number, an array of numbers, or a metal's symbol");
}
inline Json own_schema(const GivenParameter&) {
  return {{"anyOf",
           {{{"type", "number"}},
            {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 1}, {"maxItems", 3}},
            {{"type", "string"}, {"minLength", 1}}}}};
}

/// Settings of a model; a word stands for a metal alone.
/// \param at  the object of the parameters
inline std::vector<Setting> settings_of(const GivenParameters& parameters, const JsonReader& at) {
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
