#pragma once
/// \file
/// JSON out in the contract's form, and in from others: every value read knows its place, so an
/// error can name it.
/// Dear to compile: for .cpp files only.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace gonio {

using Json = nlohmann::ordered_json;

/// The text of a document for people and programs alike: indented, ends with a new line.
std::string text_of(const Json&);
/// The bytes as a document; bytes that are not JSON, or nest deeper than 64 levels, are bad_input
/// with line and column.
Json parse_json(const std::string& file, const std::string& bytes);

/// One entry as itself, several as an array: how the contract writes what may have channels.
template <class Entry>
Json per_channel(std::size_t n, Entry entry) {
  if (n == 1) return entry(0);
  Json all = Json::array();
  for (std::size_t c = 0; c < n; ++c) all.push_back(entry(c));
  return all;
}
Json per_channel(const std::vector<double>&);
/// {NAME: number or array}
Json per_name(const std::vector<std::pair<std::string, std::vector<double>>>&);

/// A value of a document and where it stands ("parameters.alpha.value"); the document must outlive
/// it.  A value that is not what is asked for is bad_input.
class JsonReader {
 public:
  JsonReader(const std::string& file, const Json& value, std::string place = "")
      : file_(file), value_(value), place_(std::move(place)) {}

  JsonReader at(const std::string& key) const;  ///< of an object; must be there
  bool has(const std::string& key) const;
  std::vector<std::pair<std::string, JsonReader>> members() const;
  std::vector<JsonReader> elements() const;  ///< of an array, which may be empty; else it alone
  bool is_null() const { return value_.is_null(); }
  std::string string() const;
  bool boolean() const;
  double number() const;  ///< NaN where null
  std::uint64_t whole_number() const;
  std::vector<double> numbers() const;  ///< one number or an array of at least one

  [[noreturn]] void fail(const std::string& expected) const;

 private:
  void expect_object() const;
  std::string place_of(const std::string& key) const;
  const std::string& file_;
  const Json& value_;
  std::string place_;
};

}  // namespace gonio
