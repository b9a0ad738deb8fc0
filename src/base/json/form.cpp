#include "base/json/form.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

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

Json numbers_schema(const Numbers& n) {
  Json out{{"type", "number"}};
  if (n.low > -Numbers::any) put(out, n.above_low ? "exclusiveMinimum" : "minimum", n.low);
  if (n.high < Numbers::any) put(out, n.below_high ? "exclusiveMaximum" : "maximum", n.high);
  return out;
}

void FormReader::constant(const std::string& key, std::string_view is) {
  known_.push_back(key);
  const JsonReader j = at_.at(key);
  if (j.string() != is) j.fail(std::string(is));
}

void FormReader::done() const {
  at_.visit_members([&](const std::string& key, const JsonReader& value) {
    if (std::ranges::find(known_, key) == known_.end())
      value.fail("no such key; " + either({known_.begin(), known_.end()}));
  });
}

std::size_t FormReader::place_among(const std::vector<std::string_view>& names,
                                    const JsonReader& j) {
  const auto found = std::ranges::find(names, j.string());
  if (found == names.end()) j.fail(either(names));
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t FormReader::place_of_one(const std::vector<std::string_view>& names) const {
  std::vector<std::string_view> there;
  for (const auto name : names)
    if (at_.has(std::string(name))) there.push_back(name);
  if (there.size() != 1)
    at_.fail(there.empty() ? "none of its keys" : fmt::format("{}", fmt::join(there, " and ")),
             "one of " + either(names));
  return static_cast<std::size_t>(std::ranges::find(names, there[0]) - names.begin());
}

void FormSchema::add(const std::string& key, Json schema, std::string_view meaning, bool required) {
  put_meaning(schema, meaning, "");
  for (Json& object : alternatives_) {
    put(object["properties"], key, schema);
    if (required) object["required"].push_back(key);
  }
}

}  // namespace gonio
