#pragma once
/// \file
/// Parameters of a model as a document gives them: numbers, or a metal's symbol.

#include <vector>

#include "base/json/describe.h"
#include "brdf/model/given_parameter.h"
#include "brdf/model/spec.h"

namespace gonio {

extern const JsonForm given_parameter_json;
template <>
inline constexpr const JsonForm* json_form<GivenParameter> = &given_parameter_json;

/// Settings of a model; a word stands for a metal alone.
/// \param at  the object of the parameters
std::vector<Setting> settings_of(const GivenParameters&, const JsonReader& at);

}  // namespace gonio
