#include "base/json/describe.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace gonio {

Json number_json(double v, Digits digits) {
  if (!std::isfinite(v)) return nullptr;
  return digits == Digits::all ? v : std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr);
}

Json or_null(Json schema) {
  if (schema.contains("enum"))
    schema["enum"].push_back(nullptr);
  else if (!schema.contains("type"))
    schema = {{"anyOf", {schema, {{"type", "null"}}}}};
  else if (Json& type = schema["type"]; type.is_string())
    type = {type, "null"};
  return schema;
}

void put_meaning(Json& schema, std::string_view meaning, std::string_view unit) {
  std::string text(meaning);
  if (!unit.empty()) text += fmt::format("{}[{}]", text.empty() ? "" : " ", unit);
  if (!text.empty()) put(schema, "description", text);
}

Json object_schema() {
  return {{"type", "object"},
          {"properties", Json::object()},
          {"required", Json::array()},
          {"additionalProperties", false}};
}

std::string schema_file_text(Json schema, std::string_view title) {
  Json out{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", std::string(title)}};
  out.update(schema);
  return text_of(out);
}

}  // namespace gonio
