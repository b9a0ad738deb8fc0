#include "base/json/form.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

/// "at least 1", "3", "1 to 1000"
std::string words_of(const Entries& n) {
  if (n.most == Entries{}.most) return fmt::format("at least {}", n.least);
  return n.least == n.most ? std::to_string(n.least) : fmt::format("{} to {}", n.least, n.most);
}

std::string words_of(const Numbers& n) {
  if (n.low == -Numbers::any && n.high == Numbers::any) return "a number";
  if (n.high == Numbers::any)
    return n.above_low ? fmt::format("a number above {:g}", n.low)
                       : fmt::format("a number from {:g} on", n.low);
  return fmt::format("a number in {}{:g}, {:g}{}", n.above_low ? '(' : '[', n.low, n.high,
                     n.below_high ? ')' : ']');
}

/// \param of  "an array of", "an object of"
void expect_entries(const JsonReader& j, const Entries& n, const char* of) {
  if (j.size() < n.least || j.size() > n.most)
    j.fail(fmt::format("{} {}", of, j.size()), fmt::format("{} {}", of, words_of(n)));
}

}  // namespace

std::string either(const std::vector<std::string_view>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all.append(i == 0 ? "" : i + 1 < names.size() ? ", " : " or ").append(names[i]);
  return all;
}

double number_in(const JsonReader& j, const Numbers& n) {
  if (!j.is_number() || !n.holds(j.number())) j.fail(words_of(n));
  return j.number();
}

std::vector<JsonReader> entries_in(const JsonReader& j, const Entries& n) {
  if (!j.is_array()) j.fail("an array of " + words_of(n));
  expect_entries(j, n, "an array of");
  return j.elements();
}

std::vector<std::pair<std::string, JsonReader>> members_in(const JsonReader& j, const Entries& n) {
  j.expect_object();
  expect_entries(j, n, "an object of");
  auto all = j.members();
  for (const auto& [name, value] : all)
    if (name.empty()) value.fail("a key without a name", "a name");
  return all;
}

std::string text_in(const JsonReader& j) {
  std::string text = j.string();
  if (text.empty() || text.find('\0') != text.npos) j.fail("a string that is not empty");
  return text;
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
