#pragma once
/// \file
/// Description of a struct that is shown or read: each of its members once, with name, unit, meaning and the values that it takes.
/// JSON in both directions, its JSON Schema and the lines of CSV follow from it (base/json/describe.h, base/csv_describe.h).
///
///   struct Width {
///     double alpha;
///     std::vector<double> of_channels;
///   };
///   template <>
///   inline constexpr auto description<Width> = FieldList{
///       Field{"alpha", &Width::alpha, "width of the distribution"},
///       Field{"channels", per_channel(&Width::of_channels), "that of each channel"}};
///
/// A struct that is read needs a member, not a computed value, for each key; what a key takes stands behind its meaning:
///
///   Field{"alpha", &Width::alpha, "width of the distribution", Numbers{0, 1}, or_default}
///
/// Light to include: descriptions stand in headers, beside their structs or in the .cpp that shows them.

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

namespace gonio {

struct NotDescribed {};
/// Specialised for each struct that is shown or read: a FieldList of field(), group(), by_key(), by_name() and constant_text(), in the
/// order in which they are shown.
template <class T>
inline constexpr NotDescribed description;
/// The same for a struct of which more is to be said: `static constexpr auto fields()`, that list, and beside it
///
///   static void check(T&, Demand)               further demands on what was read; it may also put that in order
///   static constexpr bool has_others = true     keys that are not described, here or below, are passed over, not refused
template <class T>
struct Description;

template <class T>
concept Described = !std::is_same_v<decltype(description<T>), const NotDescribed> || requires {
  Description<T>::fields();
};
/// The list, wherever it stands.
template <Described T>
constexpr auto described_fields() {
  if constexpr (requires { Description<T>::fields(); })
    return Description<T>::fields();
  else
    return description<T>;
}

/// Numbers that a key takes.  Without them it takes any number, and null for NaN.
struct Numbers {
  static constexpr double any = std::numeric_limits<double>::max();
  double low = -any, high = any;
  bool above_low = false, below_high = false;  ///< the end itself is not taken

  constexpr bool holds(double v) const {
    return (above_low ? v > low : v >= low) && (below_high ? v < high : v <= high);
  }
};
/// Number of a list's entries.
struct Entries {
  std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();
};
/// Key that a document may leave out: it keeps the value that it has in the struct.
inline constexpr struct OrDefault {
} or_default;
/// Text that is not empty, as names and paths.
inline constexpr struct NotEmpty {
} not_empty;

/// Words that say a truth in a call: of false, and of true.  Without them true is a flag.
struct Either {
  std::string_view no{}, yes{};
};
/// Field that no call may give: an option of the library only.
inline constexpr struct NotAsked {
} not_asked;

/// Way of a type to be read from the words of a call, where it has one of its own: Value (*)(std::span<const std::string>).
template <class Value>
inline constexpr std::nullptr_t from_words = nullptr;

/// What a key takes; numbers and text in lists and lists of lists are held to the same.
struct Rules {
  Numbers numbers{};
  bool has_numbers = false;
  Entries entries{};
  Either either{};
  bool or_default = false, not_empty = false, not_asked = false;

  constexpr void add(const Numbers& n) {
    numbers = n;
    has_numbers = true;
  }
  constexpr void add(const Entries& e) { entries = e; }
  constexpr void add(const Either& e) { either = e; }
  constexpr void add(NotAsked) { not_asked = true; }
  constexpr void add(OrDefault) { or_default = true; }
  constexpr void add(NotEmpty) { not_empty = true; }
};

/// One key: where its value comes from, and what it is.
/// \tparam Get  pointer to a member, or a function of the struct, such as those below
template <class Get>
struct Field {
  std::string_view name, unit;
  Get get;
  std::string_view meaning;
  Rules rules{};

  /// \param unit  left out for pure numbers and words
  /// \param rule  Numbers, Entries, or_default, not_empty; of an option Either, not_asked
  template <class... Rule>
  constexpr Field(std::string_view name_,
                  std::string_view unit_,
                  Get get_,
                  std::string_view meaning_,
                  const Rule&... rule)
      : name(name_), unit(unit_), get(get_), meaning(meaning_) {
    (rules.add(rule), ...);
  }
  template <class... Rule>
  constexpr Field(std::string_view name_, Get get_, std::string_view meaning_, const Rule&... rule)
      : Field(name_, "", get_, meaning_, rule...) {}
};
template <class... Args>
constexpr auto field(const Args&... args) {
  return Field(args...);
}

template <std::size_t i, class F>
struct FieldAt {
  F field;
};
template <class Indices, class... F>
struct FieldsAt;
template <std::size_t... i, class... F>
struct FieldsAt<std::index_sequence<i...>, F...> : FieldAt<i, F>... {
  constexpr FieldsAt(const F&... f) : FieldAt<i, F>{f}... {}
};
/// Fields in their order: a tuple that asks nothing of its types, for std::tuple's questions take most of a description's time in
/// the compiler.
template <class... F>
struct FieldList : FieldsAt<std::index_sequence_for<F...>, F...> {
  static constexpr std::size_t size = sizeof...(F);
  constexpr FieldList(const F&... f) : FieldsAt<std::index_sequence_for<F...>, F...>(f...) {}
};
template <std::size_t i, class F>
constexpr const F& field_of(const FieldAt<i, F>& at) {
  return at.field;
}
template <class Take, std::size_t... i, class... F>
constexpr auto with_fields(const Take& take, const FieldsAt<std::index_sequence<i...>, F...>& all) {
  return take(field_of<i>(all)...);
}
/// The fields of one list, then those of another.
template <class... A, class... B>
constexpr FieldList<A..., B...> joined(const FieldList<A...>& a, const FieldList<B...>& b) {
  return with_fields(
      [&](const auto&... of_a) {
        return with_fields(
            [&](const auto&... of_b) { return FieldList<A..., B...>(of_a..., of_b...); }, b);
      },
      a);
}

/// Object of fields of the same struct.
template <class... Fields>
struct Group {
  std::string_view name, meaning;
  FieldList<Fields...> fields;

  constexpr Group(std::string_view name_, std::string_view meaning_, Fields... all)
      : name(name_), meaning(meaning_), fields(all...) {}
};
template <class... Fields>
constexpr Group<Fields...> group(std::string_view name,
                                 std::string_view meaning,
                                 Fields... fields) {
  return {name, meaning, fields...};
}

/// Key that is the same in every document, as its schema's name.
struct ConstantText {
  std::string_view name, value;
};
constexpr ConstantText constant_text(std::string_view name, std::string_view value) {
  return {name, value};
}

/// Alternatives of a std::variant; the keys of the one that is there stand among those of the struct around it.
template <class Get, std::size_t n>
struct Alternatives {
  std::string_view key;  ///< that names the one that is there; "": its first key does
  Get get;
  std::array<std::string_view, n> names;
};
template <class Get, class... Name>
constexpr Alternatives<Get, sizeof...(Name)> by_name(std::string_view key, Get get, Name... name) {
  return {key, get, {name...}};
}
template <class Get>
constexpr Alternatives<Get, 0> by_key(Get get) {
  return {"", get, {}};
}

/// Digits of the numbers of a document: all that tell a double from its neighbours, or the six that a page shows, a third
/// of the bytes.
enum class Digits { all, six };

/// Value of a field's `get` in a struct.
template <class Get, class T>
constexpr decltype(auto) value_in(const Get& get, const T& of) {
  if constexpr (std::is_member_object_pointer_v<Get>)
    return (of.*get);
  else
    return get(of);
}

// --- How a value is shown that says so by more than its type ---

/// One entry as itself, several as an array: how documents write what may have channels.
template <class V>
struct PerChannel {
  V entries;
};
/// Object of pairs of a name and values, or structs of these two: {NAME: one number, or one per channel}.
template <class V>
struct PerName {
  V entries;
};
/// Object of entries by their member `name`, which is not repeated within.
template <class V>
struct ByName {
  V entries;
};
/// Fields of the value among those of the struct around it; of an optional without value none.
template <class V>
struct Inlined {
  V value;
};
/// Key that is left out where its value says nothing: an optional without value, a number that is not finite, an empty text or
/// list.  These alone are null or empty there.
template <class V>
struct IfThere {
  V value;
};
/// Pairs of a key and a value that stand among the fields of the struct around them.
template <class V>
struct Keyed {
  V entries;
};
/// Document of a described T that is text already.
template <class T>
struct Embedded {
  std::string_view text;
};
/// The struct itself: what a description of a variant gets.
inline constexpr struct Itself {
  template <class T>
  constexpr T& operator()(T& of) const {
    return of;
  }
} itself;

/// Function that shows what another gets in one of these forms.
template <template <class> class Form, class Get>
struct As {
  Get get;
  template <class T>
  constexpr auto operator()(const T& of) const {
    return Form<decltype(value_in(get, of))>{value_in(get, of)};
  }
};
template <class Get>
constexpr As<PerChannel, Get> per_channel(Get get) {
  return {get};
}
template <class Get>
constexpr As<PerName, Get> per_name(Get get) {
  return {get};
}
template <class Get>
constexpr As<ByName, Get> by_name(Get get) {
  return {get};
}
template <class Get>
constexpr As<IfThere, Get> if_there(Get get) {
  return {get};
}
/// \param pattern  regular expression of their keys
template <class Get>
constexpr Field<As<Keyed, Get>> keyed(std::string_view pattern, Get get, std::string_view meaning) {
  return {pattern, "", As<Keyed, Get>{get}, meaning};
}
/// Field without a name of its own.
template <class Get>
constexpr Field<As<Inlined, Get>> inlined(Get get) {
  return {"", "", As<Inlined, Get>{get}, ""};
}
/// Member of a member: at(&CostRow::time, &Timing::ns).
template <class Outer, class Inner>
struct At {
  Outer outer;
  Inner inner;
  template <class T>
  constexpr decltype(auto) operator()(const T& of) const {
    return value_in(inner, value_in(outer, of));
  }
};
template <class Outer, class Inner>
constexpr At<Outer, Inner> at(Outer outer, Inner inner) {
  return {outer, inner};
}

/// Member that a field's `get` names, to be written to; void where it computes.
template <class T, class Get>
constexpr decltype(auto) place_in(const Get& get, T& of) {
  if constexpr (std::is_member_object_pointer_v<Get>)
    return (of.*get);
  else if constexpr (std::is_same_v<Get, Itself>)
    return (of);
}
template <class T, template <class> class Form, class Get>
constexpr decltype(auto) place_in(const As<Form, Get>& as, T& of) {
  return place_in(as.get, of);
}
template <class T, class Outer, class Inner>
constexpr decltype(auto) place_in(const At<Outer, Inner>& at, T& of) {
  if constexpr (!std::is_void_v<decltype(place_in(at.outer, of))>)
    return place_in(at.inner, place_in(at.outer, of));
}

// --- Whether a description is whole ---

/// Anything, where only the number of members is asked for.
struct AnyMember {
  template <class T>
  operator T() const;  // NOLINT: a member of any type is made of it
};
/// Number of members of an aggregate without base classes and arrays.
template <class T, class... Known>
consteval std::size_t member_count() {
  if constexpr (requires { T{Known{}..., AnyMember{}}; })
    return member_count<T, Known..., AnyMember>();
  else
    return sizeof...(Known);
}

template <class Get>
struct IsMember : std::is_member_object_pointer<Get> {};
template <template <class> class Form, class Get>
struct IsMember<As<Form, Get>> : IsMember<Get> {};

template <class Get>
constexpr std::size_t members_shown(const Field<Get>&) {
  return IsMember<Get>::value;
}
constexpr std::size_t members_shown(const ConstantText&) {
  return 0;
}
template <class Get, std::size_t n>
constexpr std::size_t members_shown(const Alternatives<Get, n>&) {
  return IsMember<Get>::value;
}
template <class... Fields>
constexpr std::size_t members_shown(const Group<Fields...>& g) {
  return with_fields([](const auto&... f) { return (members_shown(f) + ... + 0); }, g.fields);
}
/// True where each member of an aggregate has its field: for what must not be forgotten, in a static_assert beside the
/// description.
template <Described T>
consteval bool describes_every_member() {
  return with_fields([](const auto&... f) { return (members_shown(f) + ... + 0); },
                     described_fields<T>()) == member_count<T>();
}

}  // namespace gonio
