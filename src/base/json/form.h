#pragma once
/// \file
/// Form of a document that is read: each key once, with the values that it takes.  Reading, which refuses anything else by its
/// place, writing, and the JSON Schema follow from it.
///
///   struct Width {
///     double alpha = 0.1;
///     std::string of;
///   };
///   template <class Form>
///   void keys(Form& f, Width& w) {
///     f.optional("alpha", w.alpha, "width of the distribution", Numbers{0, 1});
///     f.required("of", w.of, "its name");
///   }
///   Width w;
///   read_form(JsonReader(file, document), w);     form_schema<Width>("Width of a distribution")     form_json(w)
///
/// A value is a number, a whole number, true or false, text, the name of an enum's value, an array of numbers, a struct of three of them x, y
/// and z, a list, a list of pairs (an object of any names), an optional, or a struct with keys.  What a document leaves out
/// keeps the value that it has in the struct.
/// Dear to compile: for .cpp files only.

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/json/describe.h"
#include "base/json/reader.h"
#include "base/names.h"

#include <nlohmann/json.hpp>

namespace gonio {

/// Adds a key without looking whether it is there.
inline void put(Json& object, std::string_view name, Json value) {
  object.get_ref<Json::object_t&>().emplace_back(std::string(name), std::move(value));
}
void put_meaning(Json& schema, std::string_view meaning, std::string_view unit);
/// Object of exactly those keys; `properties` and `required` are filled in.
Json object_schema();
std::string schema_file_text(Json schema, std::string_view title);
Json numbers_schema(const Numbers&);

namespace form_detail {

template <class V>
inline constexpr bool is_list = false;
template <class E>
inline constexpr bool is_list<std::vector<E>> = true;
template <class V>
inline constexpr bool is_named_list = false;
template <class E>
inline constexpr bool is_named_list<std::vector<std::pair<std::string, E>>> = true;
template <class V>
inline constexpr bool is_numbers = false;
template <std::size_t n>
inline constexpr bool is_numbers<std::array<double, n>> = true;
template <class V>
concept Triple = requires(V v) {
  v.x, v.y, v.z;
};
/// Value with a way of its own to be read, and its schema.
template <class V>
concept Own = requires(const JsonReader& j, V v) {
  read_own(j, v);
  own_schema(v);
};

template <class V>
std::array<double, 3> array_of(const V& v) {
  return {v.x, v.y, v.z};
}

}  // namespace form_detail

template <class T>
void read_form(const JsonReader&, T&);
/// Schema of a struct's form, as a part of another.
template <class T>
Json form_schema_of();

/// Value of a key.  \param rule  Numbers or Entries, where there are any
template <class V, class... Rule>
void read_value(const JsonReader& j, V& value, const Rule&... rule) {
  using namespace form_detail;
  if constexpr (std::same_as<V, double>) {
    value = number_in(j, Numbers{rule...});
  } else if constexpr (std::same_as<V, bool>) {
    value = j.boolean();
  } else if constexpr (std::same_as<V, std::uint64_t>) {
    value = j.whole_number();
  } else if constexpr (std::same_as<V, std::string>) {
    value = text_in(j);
  } else if constexpr (Named<V>) {
    const auto found = find_value<V>(j.string());
    if (!found) j.fail(either({names_of<V>.begin(), names_of<V>.end()}));
    value = *found;
  } else if constexpr (is_numbers<V>) {
    const auto entries = entries_in(j, {value.size(), value.size()});
    for (std::size_t i = 0; i < value.size(); ++i)
      value[i] = number_in(entries[i], Numbers{rule...});
  } else if constexpr (Triple<V>) {
    auto xyz = array_of(value);
    read_value(j, xyz, rule...);
    value = {xyz[0], xyz[1], xyz[2]};
  } else if constexpr (is_named_list<V>) {
    value.clear();
    for (const auto& [name, member] : members_in(j, Entries{rule...})) {
      value.emplace_back(name, typename V::value_type::second_type{});
      read_value(member, value.back().second);
    }
  } else if constexpr (is_list<V>) {
    value.clear();
    for (const auto& entry : entries_in(j, Entries{rule...}))
      read_value(entry, value.emplace_back());
  } else if constexpr (record_detail::is<V, std::optional>) {
    read_value(j, value.emplace(), rule...);
  } else if constexpr (Own<V>) {
    read_own(j, value);
  } else {
    read_form(j, value);
  }
}

/// Schema of a value, with what it is where a document leaves it out.
template <class V, class... Rule>
Json value_schema(const V& value, bool with_default, const Rule&... rule) {
  using namespace form_detail;
  Json out;
  const auto left_out = [&](Json is) {
    if (with_default) put(out, "default", std::move(is));
  };
  if constexpr (std::same_as<V, double>) {
    out = numbers_schema(Numbers{rule...});
    left_out(value);
  } else if constexpr (std::same_as<V, bool>) {
    out = {{"type", "boolean"}};
    left_out(value);
  } else if constexpr (std::same_as<V, std::uint64_t>) {
    out = {{"type", "integer"}, {"minimum", 0}};
    left_out(value);
  } else if constexpr (std::same_as<V, std::string>) {
    out = {{"type", "string"}, {"minLength", 1}};
  } else if constexpr (Named<V>) {
    out = schema_of<V>();
    left_out(std::string(name_of(value)));
  } else if constexpr (is_numbers<V>) {
    out = {{"type", "array"}, {"items", numbers_schema(Numbers{rule...})}};
    out.update({{"minItems", value.size()}, {"maxItems", value.size()}});
    left_out(value);
  } else if constexpr (Triple<V>) {
    out = value_schema(array_of(value), with_default, rule...);
  } else if constexpr (is_named_list<V>) {
    const Entries n{rule...};
    out = {{"type", "object"},
           {"propertyNames", {{"minLength", 1}}},
           {"minProperties", n.least},
           {"additionalProperties", value_schema(typename V::value_type::second_type{}, false)}};
    if (n.most < Entries{}.most) put(out, "maxProperties", n.most);
  } else if constexpr (is_list<V>) {
    const Entries n{rule...};
    out = {{"type", "array"},
           {"items", value_schema(typename V::value_type{}, false)},
           {"minItems", n.least}};
    if (n.most < Entries{}.most) put(out, "maxItems", n.most);
  } else if constexpr (record_detail::is<V, std::optional>) {
    out = value_schema(typename V::value_type{}, false, rule...);
  } else if constexpr (Own<V>) {
    out = own_schema(value);
  } else {
    out = form_schema_of<V>();
  }
  return out;
}

/// Reader of an object by its form.
class FormReader {
 public:
  explicit FormReader(const JsonReader& object) : at_(object) { at_.expect_object(); }

  /// Key that is the same in every document, as its schema's name.
  void constant(const std::string& key, std::string_view is);
  template <class V, class... Rule>
  void required(const std::string& key, V& value, std::string_view, const Rule&... rule) {
    known_.push_back(key);
    read_value(at_.at(key), value, rule...);
  }
  template <class V, class... Rule>
  void optional(const std::string& key, V& value, std::string_view, const Rule&... rule) {
    known_.push_back(key);
    if (at_.has(key)) read_value(at_.at(key), value, rule...);
  }
  /// Alternative that a key names; its own keys stand beside that.
  template <class... A>
  void by_name(const std::string& key,
               std::variant<A...>& value,
               const std::array<std::string_view, sizeof...(A)>& names) {
    known_.push_back(key);
    read_alternative(value, place_among(names, at_.at(key)));
  }
  /// Alternative that there is a key of.
  template <class... A>
  void by_key(std::variant<A...>& value, const std::array<std::string_view, sizeof...(A)>& names) {
    read_alternative(value, place_of_one({names.begin(), names.end()}));
  }
  /// Object whose keys are members of the struct around it.  \param fill  of a form
  template <class Fill>
  void group(const std::string& key, std::string_view, Fill&& fill) {
    known_.push_back(key);
    FormReader within(at_.at(key));
    fill(within);
    within.done();
  }
  /// Further demand on what was read; a key that the document leaves out fails for all of it.
  void expect(bool holds, const std::string& key, const std::string& expected) const {
    if (!holds) (at_.has(key) ? at_.at(key) : at_).fail(expected);
  }
  /// Refuses keys that the form has not.
  void done() const;

 private:
  static std::size_t place_among(const std::vector<std::string_view>& names, const JsonReader&);
  template <std::size_t n>
  static std::size_t place_among(const std::array<std::string_view, n>& names,
                                 const JsonReader& j) {
    return place_among(std::vector(names.begin(), names.end()), j);
  }
  std::size_t place_of_one(const std::vector<std::string_view>& names) const;
  template <class... A>
  void read_alternative(std::variant<A...>& value, std::size_t index) {
    std::size_t i = 0;
    ((i++ == index ? keys(*this, value.template emplace<A>()) : void()), ...);
  }

  JsonReader at_;
  std::vector<std::string> known_;
};

/// JSON Schema of an object by its form.
class FormSchema {
 public:
  FormSchema() : alternatives_{object_schema()} {}

  void constant(const std::string& key, std::string_view is) {
    add(key, {{"const", std::string(is)}}, "", true);
  }
  template <class V, class... Rule>
  void required(const std::string& key,
                const V& value,
                std::string_view meaning,
                const Rule&... rule) {
    add(key, value_schema(value, false, rule...), meaning, true);
  }
  template <class V, class... Rule>
  void optional(const std::string& key,
                const V& value,
                std::string_view meaning,
                const Rule&... rule) {
    add(key, value_schema(value, true, rule...), meaning, false);
  }
  template <class... A>
  void by_name(const std::string& key,
               std::variant<A...>&,
               const std::array<std::string_view, sizeof...(A)>& names) {
    std::size_t i = 0;
    multiply<A...>([&](FormSchema& s) { s.constant(key, names[i++]); });
  }
  template <class... A>
  void by_key(std::variant<A...>&, const std::array<std::string_view, sizeof...(A)>&) {
    multiply<A...>([](FormSchema&) {});
  }
  template <class Fill>
  void group(const std::string& key, std::string_view meaning, Fill&& fill) {
    FormSchema within;
    fill(within);
    add(key, within.schema(), meaning, true);
  }
  void expect(bool, const std::string&, const std::string&) const {}  // a schema cannot say it
  Json schema() const {
    return alternatives_.size() == 1 ? alternatives_[0] : Json{{"anyOf", alternatives_}};
  }

 private:
  void add(const std::string& key, Json schema, std::string_view meaning, bool required);
  /// Objects that there are so far, each with each alternative's keys.
  template <class... A, class Before>
  void multiply(Before&& before) {
    std::vector<Json> all;
    const auto with = [&]<class Alternative>(Alternative value) {
      FormSchema s = *this;
      before(s);
      keys(s, value);
      all.insert(all.end(), s.alternatives_.begin(), s.alternatives_.end());
    };
    (with(A{}), ...);
    alternatives_ = std::move(all);
  }

  std::vector<Json> alternatives_;
};

/// Writer of an object by its form; an optional without a value is left out.
class FormWriter {
 public:
  void constant(const std::string& key, std::string_view is) { put(json_, key, std::string(is)); }
  template <class V, class... Rule>
  void required(const std::string& key, const V& value, std::string_view, const Rule&...) {
    put(json_, key, value_json(value));
  }
  template <class V, class... Rule>
  void optional(const std::string& key, const V& value, std::string_view, const Rule&...) {
    if constexpr (record_detail::is<V, std::optional>) {
      if (value) put(json_, key, value_json(*value));
    } else {
      put(json_, key, value_json(value));
    }
  }
  template <class... A>
  void by_key(std::variant<A...>& value, const std::array<std::string_view, sizeof...(A)>&) {
    std::visit([&](auto& alternative) { keys(*this, alternative); }, value);
  }
  void expect(bool, const std::string&, const std::string&) const {}
  Json json() && { return std::move(json_); }

  template <class V>
  static Json value_json(const V& value) {
    using namespace form_detail;
    if constexpr (is_named_list<V>) {
      Json object = Json::object();
      for (const auto& [name, member] : value) put(object, name, value_json(member));
      return object;
    } else if constexpr (is_list<V>) {
      Json array = Json::array();
      for (const auto& entry : value) array.push_back(value_json(entry));
      return array;
    } else if constexpr (std::is_arithmetic_v<V> || Named<V> || std::same_as<V, std::string> ||
                         is_numbers<V>) {
      return json_of(value);
    } else if constexpr (Triple<V>) {
      return json_of(array_of(value));
    } else {
      FormWriter f;
      V copy = value;
      keys(f, copy);
      return std::move(f).json();
    }
  }

 private:
  Json json_ = Json::object();
};

/// JSON of a struct by its form.
template <class T>
Json form_json(const T& value) {
  return FormWriter::value_json(value);
}

template <class T>
void read_form(const JsonReader& j, T& value) {
  FormReader f(j);
  keys(f, value);
  f.done();
}

template <class T>
Json form_schema_of() {
  FormSchema s;
  T value{};
  keys(s, value);
  return s.schema();
}

/// Schema of a document as a file of its own (draft 7).
template <class T>
std::string form_schema(std::string_view title) {
  return schema_file_text(form_schema_of<T>(), title);
}

}  // namespace gonio
