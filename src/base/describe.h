#pragma once
/// \file
/// Description of a struct that is shown: each of its members once, with name, unit and meaning.  JSON, its JSON Schema and
/// the lines of CSV follow from it (base/json/describe.h, base/csv_describe.h).
///
///   struct Width {
///     double alpha;
///     std::vector<double> of_channels;
///   };
///   template <>
///   struct Description<Width> {
///     static constexpr auto fields() {
///       return std::tuple{field("alpha", "", &Width::alpha, "width of the distribution"),
///                         field("channels", "", per_channel(&Width::of_channels), "that of each channel")};
///     }
///   };
///
/// Light to include: descriptions stand in headers, beside their structs or in the .cpp that shows them.

#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace gonio {

/// Specialised for each struct that is shown: `static constexpr auto fields()`, a tuple of field(), group() and constant_text(),
/// in the order in which they are shown.
template <class T>
struct Description;

template <class T>
concept Described = requires {
  Description<T>::fields();
};

/// One key: where its value comes from, and what it is.
/// \tparam Get  pointer to a member, or a function of the struct, such as those below
template <class Get>
struct Field {
  std::string_view name, unit;
  Get get;
  std::string_view meaning;
};
/// \param unit  "" for pure numbers and words
template <class Get>
constexpr Field<Get> field(std::string_view name,
                           std::string_view unit,
                           Get get,
                           std::string_view meaning) {
  return {name, unit, get, meaning};
}

/// Object of fields of the same struct.
template <class... Fields>
struct Group {
  std::string_view name, meaning;
  std::tuple<Fields...> fields;
};
template <class... Fields>
constexpr Group<Fields...> group(std::string_view name,
                                 std::string_view meaning,
                                 Fields... fields) {
  return {name, meaning, std::tuple{fields...}};
}

/// Key that is the same in every document, as its schema's name.
struct ConstantText {
  std::string_view name, value;
};
constexpr ConstantText constant_text(std::string_view name, std::string_view value) {
  return {name, value};
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
/// Key that is left out where the optional has no value; an optional alone is null there.
template <class V>
struct IfThere {
  V value;
};
/// Document of a described T that is text already.
template <class T>
struct Embedded {
  std::string_view text;
};

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
/// Field without a name of its own.
template <class Get>
constexpr Field<As<Inlined, Get>> inlined(Get get) {
  return {"", "", {get}, ""};
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
template <class... Fields>
constexpr std::size_t members_shown(const Group<Fields...>& g) {
  return std::apply([](const auto&... f) { return (members_shown(f) + ... + 0); }, g.fields);
}
/// True where each member of an aggregate has its field: for what must not be forgotten, in a static_assert beside the
/// description.
template <Described T>
consteval bool describes_every_member() {
  return std::apply([](const auto&... f) { return (members_shown(f) + ... + 0); },
                    Description<T>::fields()) == member_count<T>();
}

}  // namespace gonio
