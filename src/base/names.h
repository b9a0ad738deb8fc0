#pragma once
/// \file
/// Names of the values of enumerations, as files, options and pages have them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

#include "base/nearest_names.h"

namespace gonio {

/// Names of an enumeration's values 0, 1, 2 …  An enumeration that has names specialises this beside itself.
template <class E>
inline constexpr std::array<std::string_view, 0> names_of{};

template <class E>
concept Named = std::is_enum_v<E> && names_of<E>
.size() > 0;

template <Named E>
constexpr std::string_view name_of(E value) {
  return names_of<E>[static_cast<std::size_t>(value)];
}

/// Value of that name, if there is one.
template <Named E>
constexpr std::optional<E> find_value(std::string_view name) {
  const auto& names = names_of<E>;
  const auto at = std::ranges::find(names, name);
  return at == names.end() ? std::nullopt : std::optional(static_cast<E>(at - names.begin()));
}

/// Value of that name; of none it is wrong usage that names the nearest.
/// \param what  the names stand for, as in refuse_name
template <Named E>
E value_of(std::string_view name, std::string_view what) {
  if (const auto value = find_value<E>(name)) return *value;
  refuse_name(name, names_of<E>, what);
}

}  // namespace gonio
