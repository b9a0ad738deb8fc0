#pragma once
/// \file
/// JSON in both directions, and its JSON Schema, from tables of descriptions (base/describe.h, base/record.h).
/// Light to include.

#include <string>
#include <string_view>

#include "base/json/reader.h"
#include "base/record.h"

namespace gonio {

/// JSON of any value that has a form: numbers, which are null where they are not finite, text, names of enums, optionals, arrays,
/// maps and lists of pairs (objects), variants, described structs, and the forms of base/describe.h.
Json json_of(const ValueRef&, Digits digits = Digits::all);
/// Text of the same, indented as documents for people are, and in one line.
std::string json_text(const ValueRef&, Digits digits = Digits::all);
std::string json_line(const ValueRef&, Digits digits = Digits::all);

/// Reads a value, of a key with such rules.  What is not as described is bad_input with its place; what a document leaves out, where it may, keeps the
/// value that it has.
void read_value(const JsonReader&, const ValueType&, void* value, const Rules& = {});
template <class T>
void read_record(const JsonReader& j, T& value) {
  read_value(j, type_of<T>, &value);
}

/// Reads the value of a key of an object, if it is there, where nothing else of that object is described.
template <class V, class... Rule>
void read_key(const JsonReader& object, const std::string& key, V& value, const Rule&... rule) {
  object.expect_object();
  Rules rules;
  (rules.add(rule), ...);
  if (object.has(key)) read_value(object.at(key), type_of<V>, &value, rules);
}

/// JSON Schema of the same.
Json schema_of(const ValueType&);
template <class T, class J = Json>
J schema_of() {
  return schema_of(type_of<T>);
}
/// Schema of a document as a file of its own (draft 7).
std::string schema_text(const ValueType&, std::string_view title);
template <class T>
std::string schema_text(std::string_view title) {
  return schema_text(type_of<T>, title);
}

/// Functions of a value that is JSON in a way of its own; a type names them by json_form (base/record.h).
struct JsonForm {
  Json (*write)(const void*);
  void (*read)(const JsonReader&, void*);
  Json (*schema)();
};
/// JSON as it is.
extern const JsonForm any_json;
template <>
inline constexpr const JsonForm* json_form<Json> = &any_json;

/// "a, b or c"
std::string either(const std::vector<std::string_view>& names);
/// Number that is taken; null is none.
double number_in(const JsonReader&, const Numbers&);
/// Refuses what is no array of so many entries.
void expect_array(const JsonReader&, const Entries&);
/// Visits the members of an object that has so many, each with a name.
void visit_members_in(const JsonReader&,
                      const Entries&,
                      const std::function<void(const std::string&, const JsonReader&)>&);
std::string text_in(const JsonReader&);  ///< not empty, without zero bytes, which end a path

/// Number, or null where it is not finite.
Json number_json(double, Digits);

}  // namespace gonio
