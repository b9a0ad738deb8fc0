#pragma once
/// \file
/// JSON out in the contract's form, and in from others: every value read knows its place, so an
/// error can name it.
/// Light to include; who makes or takes apart a Json itself includes <nlohmann/json.hpp>.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace gonio {

using Json = nlohmann::ordered_json;

/// The text of a document for people and programs alike: indented, ends with a new line.  Bytes that are no text are replaced, and
/// its strings leave a terminal alone.
std::string text_of(const Json&);
/// The same in one line, without its end.
std::string line_of(const Json&);
/// The bytes as a document; bytes that are not JSON, or nest deeper than 64 levels, are bad_input
/// with line and column.
Json parse_json(const std::string& file, const std::string& bytes);
/// A document of a file; one of more bytes than that is refused before it is read.
Json read_json(const std::string& file);
inline constexpr std::uint64_t most_document_bytes = std::uint64_t{1} << 26;

/// Way to write where a value stands: "parameters.alpha[0]", or "/parameters/alpha/0" [RFC 6901].
enum class Places { dotted, pointer };

/// A value of a document and where it stands; document and file name must outlive it.  A value that is
/// not what is asked for is bad_input.
class JsonReader {
 public:
  JsonReader(const std::string& file,
             const Json& value,
             std::string place = "",
             Places places = Places::dotted)
      : file_(&file), value_(&value), place_(std::move(place)), places_(places) {}

  const std::string& file() const { return *file_; }
  JsonReader at(const std::string& key) const;  ///< of an object; must be there
  JsonReader at(std::size_t index) const;       ///< of an array; must be there
  bool has(const std::string& key) const;
  bool is_array() const;
  bool is_number() const;
  bool is_negative() const;  ///< and a whole number
  bool is_string() const;
  std::size_t size() const;  ///< of an array or an object
  /// Visits each member of an object.  Nobody keeps readers of all members, or of all elements of an array: each takes many times the
  /// two bytes that its value may have in a file.
  void visit_members(const std::function<void(const std::string&, const JsonReader&)>&) const;
  bool is_null() const;
  const Json& json() const { return *value_; }
  std::string string() const;
  bool boolean() const;
  double number() const;  ///< NaN where null
  std::uint64_t whole_number() const;
  std::int64_t negative_number() const;
  std::vector<double> numbers() const;  ///< one number or an array of at least one

  void expect_object() const;
  [[noreturn]] void fail(const std::string& expected) const;
  /// Failure whose words for what was found say more than the value itself.
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  JsonReader within(const Json& value, std::string step) const;
  const std::string* file_;
  const Json* value_;
  std::string place_;
  Places places_;
};

/// A document and what it is read by.
class JsonDocument {
 public:
  /// \throws Error  as parse_json
  JsonDocument(std::string file, const std::string& bytes, Places places = Places::dotted);
  explicit JsonDocument(std::string file, Places places = Places::dotted);  ///< of a file
  ~JsonDocument();
  JsonDocument(const JsonDocument&) = delete;

  const JsonReader& root() const { return root_; }

 private:
  const std::string file_;
  const std::unique_ptr<Json> document_;
  const JsonReader root_;
};

}  // namespace gonio
