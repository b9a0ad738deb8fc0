#include "base/json_reader.h"

#include <algorithm>
#include <limits>

#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr int kDeepest = 64;  ///< nested brackets; the contract's documents need 5

/// The byte where brackets nest deeper than that, or npos.
std::size_t too_deep(std::string_view bytes) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (in_string)
      continue;
    else if (c == '[' || c == '{')
      ++depth;
    else if (c == ']' || c == '}')
      --depth;
    if (depth > kDeepest) return i;
  }
  return bytes.npos;
}

std::string place_of(std::string_view bytes, std::size_t at) {
  const auto before = bytes.substr(0, at);
  const auto column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  return fmt::format("line {}, column {}", 1 + std::ranges::count(before, '\n'), column);
}

/// A simple value as it is written, of others the kind: they may hold anything.
std::string name_of(const Json& j) {
  if (j.is_structured())
    return fmt::format("{} {}", j.empty() ? "an empty" : "an", j.is_object() ? "object" : "array");
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string text_of(const Json& j) {
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json per_channel(const std::vector<double>& v) {
  return per_channel(v.size(), [&](std::size_t c) { return Json(v[c]); });
}

Json per_name(const std::vector<std::pair<std::string, std::vector<double>>>& all) {
  Json out = Json::object();
  for (const auto& [name, values] : all) out[name] = per_channel(values);
  return out;
}

Json parse_json(const std::string& file, const std::string& bytes) {
  if (const auto at = too_deep(bytes); at != bytes.npos)
    throw bad_input(file, place_of(bytes, at), fmt::format("{} levels of brackets", kDeepest + 1),
                    fmt::format("at most {}", kDeepest));
  try {
    return Json::parse(bytes);
  } catch (const Json::parse_error& e) {
    const auto end = std::min(bytes.size(), e.byte > 0 ? e.byte - 1 : 0);
    throw bad_input(file, place_of(bytes, end),
                    end < bytes.size() ? bytes.substr(end, 12) : "the end of the file", "JSON");
  } catch (const Json::exception& e) {
    throw bad_input(file, "JSON", e.what(), "values that can be held");
  }
}

void JsonReader::fail(const std::string& expected) const {
  throw bad_input(file_, place_.empty() ? "the document" : place_, name_of(value_), expected);
}

void JsonReader::expect_object() const {
  if (!value_.is_object()) fail("an object");
}

bool JsonReader::has(const std::string& key) const {
  return value_.is_object() && value_.contains(key);
}

JsonReader JsonReader::at(const std::string& key) const {
  expect_object();
  const auto place = place_.empty() ? key : place_ + "." + key;
  const auto found = value_.find(key);
  if (found == value_.end()) throw bad_input(file_, place, "nothing", "a value");
  return {file_, *found, place};
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
  expect_object();
  std::vector<std::pair<std::string, JsonReader>> out;
  for (const auto& [key, value] : value_.items()) out.emplace_back(key, at(key));
  return out;
}

std::vector<JsonReader> JsonReader::elements() const {
  if (!value_.is_array()) return {*this};
  std::vector<JsonReader> out;
  for (std::size_t i = 0; i < value_.size(); ++i)
    out.emplace_back(file_, value_[i], fmt::format("{}[{}]", place_, i));
  return out;
}

std::string JsonReader::string() const {
  if (!value_.is_string()) fail("a string");
  return value_.get<std::string>();
}

bool JsonReader::boolean() const {
  if (!value_.is_boolean()) fail("true or false");
  return value_.get<bool>();
}

double JsonReader::number() const {
  if (value_.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!value_.is_number()) fail("a number or null");
  return value_.get<double>();
}

std::uint64_t JsonReader::whole_number() const {
  if (!value_.is_number_unsigned()) fail("a whole number");
  return value_.get<std::uint64_t>();
}

std::vector<double> JsonReader::numbers() const {
  std::vector<double> out;
  for (const auto& e : elements()) out.push_back(e.number());
  if (out.empty()) fail("at least one number");
  return out;
}

}  // namespace gonio
