#pragma once
/// \file
/// Types and their descriptions (base/describe.h) as tables at run time, which compiled code walks: JSON in both directions and
/// its schema (base/json/describe.h), CSV (base/csv_describe.h).  One table is made of each type, by templates that hold no code but
/// the way to a value.
///
/// Options are declared by the same tables: a field's name, unit, meaning and rules, the choices of an enum and the default are those
/// of the command line (cli/line/command_line.h) and of Python's keywords (python/options.cpp).  The key of a kept result is the
/// struct's JSON.
///
/// Light to include.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "base/names.h"

namespace gonio {

/// Function that is called while it lives.
template <class Signature>
class FunctionRef;
template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  template <class F>
  requires(!std::same_as<std::remove_cvref_t<F>, FunctionRef>)
      FunctionRef(F&& f)  // NOLINT: a function is handed as it is
      : of_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
        call_([](void* of, Args... args) -> R {
          return (*static_cast<std::remove_reference_t<F>*>(of))(std::forward<Args>(args)...);
        }) {}
  R operator()(Args... args) const { return call_(of_, std::forward<Args>(args)...); }

 private:
  void* of_;
  R (*call_)(void*, Args...);
};

/// Demand of a description's check(): refuses what was read, at that key, where it does not hold.
using Demand = FunctionRef<void(bool holds, std::string_view key, std::string_view expected)>;

enum class ValueKind {
  truth,
  whole,
  number,
  name,  ///< of an enum's value
  text,
  optional,  ///< list of one entry at most
  list,
  channels,  ///< list, of which one entry stands without the list
  named,     ///< names and values
  record,
  embedded,  ///< document that is text already
  own        ///< with functions of its own
};

struct RecordType;
struct JsonForm;  ///< how a value of its own kind is JSON: base/json/describe.h

/// Type of a value: what it is, and the ways to what it holds.  Those that a kind or a type does not have are null.
struct ValueType {
  ValueKind kind{};
  std::size_t size =
      0;  ///< bytes of a number, or of an enum; entries of a list that has always as many
  bool is_signed = false;                     ///< of a whole number
  std::span<const std::string_view> names{};  ///< of an enum
  const ValueType* of =
      nullptr;  ///< type of entries, of the list of channels, or of an embedded document
  std::string_view (*text)(const void*) = nullptr;
  void (*set_text)(void*, std::string&&) = nullptr;
  /// Each entry, with its name where there are names.
  void (*each)(const void*, FunctionRef<void(std::string_view, const void*)>) = nullptr;
  void* (*append)(void*, std::string&& name) = nullptr;  ///< \returns the new entry
  void (*clear)(void*) = nullptr;
  const RecordType* record = nullptr;
  const JsonForm* own = nullptr;
  /// From the words of a call, where that is a way of its own.
  void (*read_words)(void*, std::span<const std::string>) = nullptr;

  double number(const void*) const;       ///< of a number
  std::int64_t whole(const void*) const;  ///< of a whole number, of truth, and of an enum's value
  std::string_view name(const void* v) const { return names[static_cast<std::size_t>(whole(v))]; }
  void set_number(void*, double) const;
  void set_whole(void*, std::int64_t) const;
};

/// Alternatives of a variant, all of them records.
struct VariantType {
  std::span<const RecordType* const> alternatives;
  std::size_t (*index)(const void*);
  const void* (*value)(const void*);
  void* (*emplace)(void*, std::size_t);
};

enum class FieldRole { value, if_there, inlined, keyed, group, constant, alternatives };

/// Field of a description.
struct RecordField {
  FieldRole role{};
  std::string_view name{}, unit{}, meaning{};
  Rules rules{};
  std::string_view constant{};
  const ValueType* type = nullptr;  ///< of an inlined optional, and of what is left out where it is
                                    ///< empty, that of the optional
  void* (*place)(void* record) = nullptr;  ///< the member itself; null where the value is computed
  void (*show)(const void* record, FunctionRef<void(const void*)>) = nullptr;  ///< a computed value
  std::span<const RecordField> fields{};                                       ///< of a group
  const VariantType* variant = nullptr;
  std::span<const std::string_view> names{};  ///< of alternatives by name

  /// Hands the value that the field has in a record.
  void with_value(const void* record, FunctionRef<void(const void*)> take) const {
    if (place != nullptr)
      take(place(const_cast<void*>(record)));
    else
      show(record, take);
  }
};

struct RecordType {
  std::span<const RecordField> fields;
  bool has_others = false;
  void (*check)(void*, Demand) = nullptr;
  const void* (*example)() =
      nullptr;  ///< a record as it is when nothing is said; null where there is none
};

// --- How tables are made ---

/// Way of a type of its own kind to be JSON: a pointer, whose type tells, for under sanitizers its value is no constant.
template <class V>
inline constexpr std::nullptr_t json_form = nullptr;

namespace record_detail {

template <class T, template <class...> class Of>
inline constexpr bool is = false;
template <template <class...> class Of, class... V>
inline constexpr bool is<Of<V...>, Of> = true;

template <class T>
inline constexpr std::size_t array_size = 0;
template <class T, std::size_t n>
inline constexpr std::size_t array_size<std::array<T, n>> = n;

template <class T>
concept Text = std::convertible_to<const T&, std::string_view>;
/// Map, or list of pairs of a name and a value.
template <class T>
concept Names = std::ranges::input_range<const T> && requires(const T& all) {
  { std::ranges::begin(all)->first } -> Text;
  std::ranges::begin(all)->second;
};
/// Vector of three coordinates.
template <class T>
concept Triple = !Described<T> && requires(T v) {
  { v.x } -> std::same_as<double&>;
  { v.y } -> std::same_as<double&>;
  { v.z } -> std::same_as<double&>;
};
template <class V>
concept Form = is<V, PerChannel> || is<V, PerName> || is<V, ByName> || is<V, Keyed>;

template <class List>
using Entry = std::remove_cvref_t<decltype(*std::ranges::begin(std::declval<const List&>()))>;

/// Value without the form in which it is shown.
template <class V>
const auto& bare(const V& v) {
  if constexpr (Form<V>)
    return bare(v.entries);
  else if constexpr (is<V, Inlined> || is<V, IfThere>)
    return bare(v.value);
  else
    return v;
}
template <class V>
using Bare = std::remove_cvref_t<decltype(bare(std::declval<const V&>()))>;
template <class V>
const void* address(const V& v) {
  return std::addressof(bare(v));
}

template <class V>
constexpr ValueType make_type();
template <class T>
constexpr RecordType make_record();

}  // namespace record_detail

template <class V>
inline constexpr ValueType type_of = record_detail::make_type<V>();
template <class T>
inline constexpr RecordType record_of = record_detail::make_record<T>();

namespace record_detail {

using Each = FunctionRef<void(std::string_view, const void*)>;

/// Ways to hand an entry of a container, and to add one.
struct Listed {
  static void hand(const auto& e, Each take) { take({}, address(e)); }
  static void* add(auto& c, std::string&&) requires requires { &c.emplace_back(); }
  { return &c.emplace_back(); }
};
/// Pairs of a name and a value.
struct Paired {
  static void hand(const auto& e, Each take) { take(e.first, address(e.second)); }
  static void* add(auto& c, std::string&& name) requires requires {
    c.emplace_back().first = std::move(name);
  }
  {
    auto& e = c.emplace_back();
    e.first = std::move(name);
    return &e.second;
  }
  static void* add(auto& map, std::string&& name) requires requires {
    map[std::move(name)] = {};
  }
  { return &map[std::move(name)]; }
};
/// Entries by their member `name`.
struct OwnNamed {
  static void hand(const auto& e, Each take) { take(e.name, address(e)); }
  static void* add(auto& c, std::string&& name) requires requires {
    c.emplace_back().name = std::move(name);
  }
  {
    auto& e = c.emplace_back();
    e.name = std::move(name);
    return &e;
  }
};
template <class C, class Way>
constexpr void add_entries(ValueType& t) {
  t.each = [](const void* c, Each take) {
    for (const Entry<C>& e : *static_cast<const C*>(c)) Way::hand(e, take);
  };
  if constexpr (requires(C & c) { Way::add(c, {}); }) {
    t.append = [](void* c, std::string&& name) -> void* {
      return Way::add(*static_cast<C*>(c), std::move(name));
    };
    t.clear = [](void* c) { static_cast<C*>(c)->clear(); };
  }
}

template <class V>
constexpr ValueType make_type() {
  ValueType t;
  if constexpr (!std::same_as<decltype(json_form<V>), const std::nullptr_t>) {
    t = {.kind = ValueKind::own, .own = json_form<V>};
  } else if constexpr (is<V, PerChannel> && is<Bare<V>, std::optional>) {
    t = type_of<Bare<V>>;
    t.of = &type_of<PerChannel<typename Bare<V>::value_type>>;
  } else if constexpr (is<V, PerChannel>) {
    t = {.kind = ValueKind::channels, .of = &type_of<Bare<V>>};
  } else if constexpr (is<V, PerName>) {
    using Values = std::remove_cvref_t<decltype(std::declval<Entry<Bare<V>>>().second)>;
    t = {.kind = ValueKind::named, .of = &type_of<PerChannel<Values>>};
    add_entries<Bare<V>, Paired>(t);
  } else if constexpr (is<V, ByName>) {
    t = {.kind = ValueKind::named, .of = &type_of<Entry<Bare<V>>>};
    add_entries<Bare<V>, OwnNamed>(t);
  } else if constexpr (is<V, Keyed>) {
    t = type_of<std::remove_cvref_t<decltype(V::entries)>>;
  } else if constexpr (is<V, Inlined> || is<V, IfThere>) {
    t = type_of<std::remove_cvref_t<decltype(V::value)>>;
  } else if constexpr (is<V, Embedded>) {
    []<class T>(std::type_identity<Embedded<T>>, ValueType& e) {
      e = {.kind = ValueKind::embedded, .of = &type_of<T>};
    }(std::type_identity<V>(), t);
    t.text = [](const void* v) { return static_cast<const V*>(v)->text; };
  } else if constexpr (std::same_as<V, bool>) {
    t = {.kind = ValueKind::truth, .size = sizeof(V)};
  } else if constexpr (std::floating_point<V>) {
    t = {.kind = ValueKind::number, .size = sizeof(V)};
  } else if constexpr (std::integral<V>) {
    t = {.kind = ValueKind::whole, .size = sizeof(V), .is_signed = std::signed_integral<V>};
  } else if constexpr (std::is_enum_v<V>) {
    t = {.kind = ValueKind::name, .size = sizeof(V), .names = names_of<V>};
  } else if constexpr (Text<V>) {
    t = {.kind = ValueKind::text};
    t.text = [](const void* v) { return std::string_view(*static_cast<const V*>(v)); };
    if constexpr (std::same_as<V, std::string>)
      t.set_text = [](void* v, std::string&& to) { *static_cast<V*>(v) = std::move(to); };
  } else if constexpr (is<V, std::optional>) {
    t = {.kind = ValueKind::optional, .of = &type_of<typename V::value_type>};
    t.each = [](const void* v, Each take) {
      if (const auto& value = *static_cast<const V*>(v)) take({}, address(*value));
    };
    if constexpr (std::default_initializable<typename V::value_type>) {
      t.append = [](void* v, std::string&&) -> void* {
        return std::addressof(static_cast<V*>(v)->emplace());
      };
      t.clear = [](void* v) { static_cast<V*>(v)->reset(); };
    }
  } else if constexpr (Described<V>) {
    t = {.kind = ValueKind::record, .record = &record_of<V>};
  } else if constexpr (Triple<V>) {
    // The type as V has it: clang would look up that of double before this function is whole.
    t = {.kind = ValueKind::list, .size = 3, .of = &type_of<decltype(V::x)>};
    t.each = [](const void* v, Each take) {
      const V& at = *static_cast<const V*>(v);
      for (const double* x : {&at.x, &at.y, &at.z}) take({}, x);
    };
  } else if constexpr (Names<V>) {
    using Value = std::remove_cvref_t<decltype(std::declval<Entry<V>>().second)>;
    t = {.kind = ValueKind::named, .of = &type_of<Value>};
    add_entries<V, Paired>(t);
  } else {
    static_assert(std::ranges::input_range<const V>, "a value of no known form: describe its type");
    t = {.kind = ValueKind::list, .size = array_size<V>, .of = &type_of<Entry<V>>};
    add_entries<V, Listed>(t);
  }
  if constexpr (!std::is_null_pointer_v<std::remove_cv_t<decltype(from_words<V>)>>)
    t.read_words = [](void* v, std::span<const std::string> words) {
      *static_cast<V*>(v) = from_words<V>(words);
    };
  return t;
}

template <class T>
inline constexpr auto fields_of = described_fields<T>();

/// Field of a description, by its number and those of the groups around it.
template <class T, std::size_t i, std::size_t... within>
constexpr const auto& field_at(const auto& fields) {
  if constexpr (sizeof...(within) == 0)
    return field_of<i>(fields);
  else
    return field_at<T, within...>(field_of<i>(fields).fields);
}
template <class T, std::size_t... path>
constexpr const auto& field_at() {
  return field_at<T, path...>(fields_of<T>);
}

template <class V>
struct AlternativesOf;
template <class... A>
struct AlternativesOf<std::variant<A...>> {
  using V = std::variant<A...>;
  static constexpr std::array records{&record_of<A>...};
  static void* emplace(void* v, std::size_t index) {
    std::size_t i = 0;
    void* made = nullptr;
    ((i++ == index ? void(made = std::addressof(static_cast<V*>(v)->template emplace<A>()))
                   : void()),
     ...);
    return made;
  }
  static constexpr VariantType type{
      records, [](const void* v) { return static_cast<const V*>(v)->index(); },
      [](const void* v) -> const void* {
        return std::visit([](const auto& a) -> const void* { return std::addressof(a); },
                          *static_cast<const V*>(v));
      },
      emplace};
};

/// The way to a value, as a member or as it is computed.
template <class T, std::size_t... path>
constexpr void add_way(RecordField& to) {
  using Get = decltype(field_at<T, path...>().get);
  if constexpr (!std::is_void_v<decltype(place_in(std::declval<const Get&>(), std::declval<T&>()))>)
    to.place = [](void* record) -> void* {
      return std::addressof(place_in(field_at<T, path...>().get, *static_cast<T*>(record)));
    };
  else
    to.show = [](const void* record, FunctionRef<void(const void*)> take) {
      const auto& value = value_in(field_at<T, path...>().get, *static_cast<const T*>(record));
      take(address(value));
    };
}

template <class T, std::size_t... path>
constexpr auto make_fields(const auto& fields);
template <class T, std::size_t... path>
inline constexpr auto field_table = make_fields<T, path...>(field_at<T, path...>().fields);
template <class T>
inline constexpr auto field_table<T> = make_fields<T>(fields_of<T>);

template <class T, std::size_t... path, class Get>
constexpr RecordField make_field(const Field<Get>& f) {
  using V = std::remove_cvref_t<decltype(value_in(f.get, std::declval<const T&>()))>;
  RecordField to{.name = f.name, .unit = f.unit, .meaning = f.meaning, .rules = f.rules};
  if constexpr (is<V, Inlined>)
    to.role = FieldRole::inlined;
  else if constexpr (is<V, Keyed>)
    to.role = FieldRole::keyed;
  else if constexpr (is<V, IfThere>)
    to.role = FieldRole::if_there;
  to.type = &type_of<V>;
  add_way<T, path...>(to);
  return to;
}
template <class T, std::size_t... path>
constexpr RecordField make_field(const ConstantText& c) {
  return {.role = FieldRole::constant, .name = c.name, .constant = c.value};
}
template <class T, std::size_t... path, class... Fields>
constexpr RecordField make_field(const Group<Fields...>& g) {
  return {.role = FieldRole::group,
          .name = g.name,
          .meaning = g.meaning,
          .fields = field_table<T, path...>};
}
template <class T, std::size_t... path, class Get, std::size_t n>
constexpr RecordField make_field(const Alternatives<Get, n>& a) {
  using V = std::remove_cvref_t<decltype(value_in(a.get, std::declval<const T&>()))>;
  RecordField to{.role = FieldRole::alternatives,
                 .name = a.key,
                 .variant = &AlternativesOf<V>::type,
                 .names = field_at<T, path...>().names};
  add_way<T, path...>(to);
  return to;
}

template <class T, std::size_t... path>
constexpr auto make_fields(const auto& fields) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return std::array<RecordField, sizeof...(i)>{make_field<T, path..., i>(field_of<i>(fields))...};
  }
  (std::make_index_sequence<std::remove_cvref_t<decltype(fields)>::size>());
}

template <class T>
constexpr RecordType make_record() {
  RecordType r{field_table<T>};
  if constexpr (requires { Description<T>::has_others; }) r.has_others = true;
  if constexpr (requires(T & t, Demand d) { Description<T>::check(t, d); })
    r.check = [](void* t, Demand d) { Description<T>::check(*static_cast<T*>(t), d); };
  if constexpr (requires { T{}; } && std::is_aggregate_v<T>)
    r.example = []() -> const void* {
      static const T example{};
      return &example;
    };
  return r;
}

}  // namespace record_detail

/// Any value of a known form, as an argument: it and the table of its type.
struct ValueRef {
  template <class V>
  requires(!std::same_as<V, ValueRef>) ValueRef(const V& v)  // NOLINT: any value stands for itself
      : type(type_of<V>), at(record_detail::address(v)) {}
  ValueRef(const ValueType& t, const void* value) : type(t), at(value) {}

  const ValueType& type;
  const void* at;
};

}  // namespace gonio
