#pragma once
/// \file
/// JSON and its JSON Schema from descriptions (base/describe.h).
/// Dear to compile: for .cpp files only.

#include <array>
#include <concepts>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/json/reader.h"
#include "base/names.h"

namespace gonio {

/// Number, or null where it is not finite.
Json number_json(double, Digits);

/// Pairs of a key and a value that stand among the fields of the struct around them.
template <class V>
struct Keyed {
  V entries;
};
/// \param pattern  regular expression of their keys
template <class Get>
constexpr Field<As<Keyed, Get>> keyed(std::string_view pattern, Get get, std::string_view meaning) {
  return {pattern, "", {get}, meaning};
}

/// JSON of any value that has a form: numbers, text, names of enums, optionals, arrays, maps and lists of pairs (objects),
/// described structs, and the forms of base/describe.h.
template <class V>
Json json_of(const V& value, Digits digits = Digits::all);

/// JSON Schema of the same.
template <class V>
Json schema_of();

/// Schema of a document as a file of its own (draft 7).
template <class T>
std::string schema_text(std::string_view title);

// --- How ---

/// Traits that tell the forms of values apart.
namespace form {

template <class T, template <class> class Form>
inline constexpr bool is = false;
template <class V, template <class> class Form>
inline constexpr bool is<Form<V>, Form> = true;

template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;

template <class T>
inline constexpr std::size_t array_size = 0;
template <class T, std::size_t N>
inline constexpr std::size_t array_size<std::array<T, N>> = N;

template <class T>
concept Text = std::convertible_to<const T&, std::string_view>;
/// Map, or list of pairs of a name and a value.
template <class T>
concept Names = std::ranges::input_range<const T> && requires(const T& all) {
  { std::ranges::begin(all)->first } -> Text;
  std::ranges::begin(all)->second;
};

template <class List>
using Entry = std::remove_cvref_t<decltype(*std::ranges::begin(std::declval<const List&>()))>;

}  // namespace form

/// Adds a key without looking whether it is there.
inline void put(Json& object, std::string_view name, Json value) {
  object.get_ref<Json::object_t&>().emplace_back(std::string(name), std::move(value));
}

template <class T>
void put_fields(Json& object, const T& of, Digits digits);

template <class T, class Get>
void put_field(Json& object, const T& of, const Field<Get>& f, Digits digits) {
  const auto& value = value_in(f.get, of);
  using V = std::remove_cvref_t<decltype(value)>;
  if constexpr (form::is<V, Inlined>) {
    if constexpr (form::is<std::remove_cvref_t<decltype(value.value)>, std::optional>) {
      if (value.value) put_fields(object, *value.value, digits);
    } else {
      put_fields(object, value.value, digits);
    }
  } else if constexpr (form::is<V, Keyed>) {
    for (const auto& [key, entry] : value.entries) put(object, key, json_of(entry, digits));
  } else if constexpr (form::is<V, IfThere>) {
    if (value.value) put(object, f.name, json_of(*value.value, digits));
  } else {
    put(object, f.name, json_of(value, digits));
  }
}
template <class T>
void put_field(Json& object, const T&, const ConstantText& c, Digits) {
  put(object, c.name, std::string(c.value));
}
template <class T, class... Fields>
void put_field(Json& object, const T& of, const Group<Fields...>& g, Digits digits) {
  Json inner = Json::object();
  std::apply([&](const auto&... f) { (put_field(inner, of, f, digits), ...); }, g.fields);
  put(object, g.name, std::move(inner));
}
template <class T>
void put_fields(Json& object, const T& of, Digits digits) {
  std::apply([&](const auto&... f) { (put_field(object, of, f, digits), ...); },
             Description<T>::fields());
}

template <class V>
Json json_of(const V& value, Digits digits) {
  if constexpr (std::same_as<V, Json>) {
    return value;
  } else if constexpr (std::floating_point<V>) {
    return number_json(value, digits);
  } else if constexpr (std::same_as<V, bool> || std::integral<V>) {
    return value;
  } else if constexpr (std::is_enum_v<V>) {
    return std::string(name_of(value));
  } else if constexpr (form::Text<V>) {
    return std::string(std::string_view(value));
  } else if constexpr (form::is<V, std::optional>) {
    return value ? json_of(*value, digits) : Json(nullptr);
  } else if constexpr (form::is<V, Embedded>) {
    return Json::parse(value.text);
  } else if constexpr (form::is<V, PerChannel>) {
    if (value.entries.size() == 1) return json_of(value.entries[0], digits);
    return json_of(value.entries, digits);
  } else if constexpr (form::is<V, PerName>) {
    Json out = Json::object();
    for (const auto& [name, values] : value.entries)
      put(out, name, json_of(PerChannel<decltype((values))>{values}, digits));
    return out;
  } else if constexpr (form::is<V, ByName>) {
    Json out = Json::object();
    for (const auto& e : value.entries) put(out, e.name, json_of(e, digits));
    return out;
  } else if constexpr (form::Names<V>) {
    Json out = Json::object();
    for (const auto& [name, e] : value) put(out, name, json_of(e, digits));
    return out;
  } else if constexpr (std::ranges::input_range<const V>) {
    Json out = Json::array();
    for (const auto& e : value)
      out.push_back(json_of<form::Entry<V>>(e, digits));  // so that vector<bool> has bools
    return out;
  } else {
    static_assert(Described<V>, "a value of no known form: describe its type");
    Json out = Json::object();
    put_fields(out, value, digits);
    return out;
  }
}

/// Schema that allows null too.
Json or_null(Json schema);
/// "what it is [unit]"
void put_meaning(Json& schema, std::string_view meaning, std::string_view unit);
/// Object of exactly those keys; `properties` and `required` are filled in.
Json object_schema();
std::string schema_file_text(Json schema, std::string_view title);

template <class T>
void put_schemas(Json& object, bool required);

template <class T, class Get>
void put_schema(Json& object, const Field<Get>& f, bool required) {
  using V = std::remove_cvref_t<decltype(value_in(f.get, std::declval<const T&>()))>;
  if constexpr (form::is<V, Inlined>) {
    using Inner = std::remove_cvref_t<decltype(std::declval<V>().value)>;
    if constexpr (form::is<Inner, std::optional>)
      put_schemas<typename Inner::value_type>(object, false);
    else
      put_schemas<Inner>(object, required);
  } else if constexpr (form::is<V, Keyed>) {
    using Pairs = std::remove_cvref_t<decltype(std::declval<V>().entries)>;
    Json schema = schema_of<typename form::Entry<Pairs>::second_type>();
    put_meaning(schema, f.meaning, f.unit);
    object["patternProperties"] = {{std::string(f.name), std::move(schema)}};
  } else {
    Json schema;
    if constexpr (form::is<V, IfThere>) {
      schema = schema_of<std::remove_cvref_t<decltype(*std::declval<V>().value)>>();
      required = false;
    } else {
      schema = schema_of<V>();
    }
    put_meaning(schema, f.meaning, f.unit);
    put(object["properties"], f.name, std::move(schema));
    if (required) object["required"].push_back(std::string(f.name));
  }
}
template <class T>
void put_schema(Json& object, const ConstantText& c, bool required) {
  put(object["properties"], c.name, {{"const", std::string(c.value)}});
  if (required) object["required"].push_back(std::string(c.name));
}
template <class T, class... Fields>
void put_schema(Json& object, const Group<Fields...>& g, bool required) {
  Json inner = object_schema();
  std::apply([&](const auto&... f) { (put_schema<T>(inner, f, true), ...); }, g.fields);
  put_meaning(inner, g.meaning, "");
  put(object["properties"], g.name, std::move(inner));
  if (required) object["required"].push_back(std::string(g.name));
}
template <class T>
void put_schemas(Json& object, bool required) {
  std::apply([&](const auto&... f) { (put_schema<T>(object, f, required), ...); },
             Description<T>::fields());
}

template <class V>
Json schema_of() {
  if constexpr (std::same_as<V, Json>) {
    return Json::object();
  } else if constexpr (std::floating_point<V>) {
    return {{"type", {"number", "null"}}};
  } else if constexpr (std::same_as<V, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::integral<V>) {
    Json out{{"type", "integer"}};
    if constexpr (std::unsigned_integral<V>) out["minimum"] = 0;
    return out;
  } else if constexpr (std::is_enum_v<V>) {
    Json names = Json::array();
    for (const auto& name : names_of<V>) names.push_back(std::string(name));
    return {{"enum", names}};
  } else if constexpr (form::Text<V>) {
    return {{"type", "string"}};
  } else if constexpr (form::is<V, std::optional>) {
    return or_null(schema_of<typename V::value_type>());
  } else if constexpr (form::is<V, Embedded>) {
    return []<class T>(std::type_identity<Embedded<T>>) {
      return schema_of<T>();
    }(std::type_identity<V>());
  } else if constexpr (form::is<V, PerChannel>) {
    using List = std::remove_cvref_t<decltype(std::declval<V>().entries)>;
    return {{"anyOf", {schema_of<form::Entry<List>>(), schema_of<List>()}}};
  } else if constexpr (form::is<V, PerName>) {
    return {{"type", "object"},
            {"additionalProperties", schema_of<PerChannel<std::vector<double>>>()}};
  } else if constexpr (form::is<V, ByName>) {
    using List = std::remove_cvref_t<decltype(std::declval<V>().entries)>;
    return {{"type", "object"}, {"additionalProperties", schema_of<form::Entry<List>>()}};
  } else if constexpr (form::Names<V>) {
    using Value = std::remove_cvref_t<decltype(std::declval<form::Entry<V>>().second)>;
    return {{"type", "object"}, {"additionalProperties", schema_of<Value>()}};
  } else if constexpr (std::ranges::input_range<const V>) {
    Json out{{"type", "array"}, {"items", schema_of<form::Entry<V>>()}};
    if constexpr (form::array_size < V >> 0)
      out.update({{"minItems", form::array_size<V>}, {"maxItems", form::array_size<V>}});
    return out;
  } else {
    static_assert(Described<V>, "a value of no known form: describe its type");
    Json out = object_schema();
    put_schemas<V>(out, true);
    return out;
  }
}

template <class T>
std::string schema_text(std::string_view title) {
  return schema_file_text(schema_of<T>(), title);
}

}  // namespace gonio
