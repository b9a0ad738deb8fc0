#pragma once
/// \file
/// Numbers out of text, the same for files and options.

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>
#include <system_error>

namespace gonio {

template <class T>
concept Parsed = std::integral<T> || std::floating_point<T>;

/// Number that the whole text is: "2", "-1.5e-3", "+2"; with a point whatever the locale.  No value for anything
/// else, blanks around it and what the type cannot hold included; "nan" and "inf" are floating-point numbers.
template <Parsed T>
std::optional<T> number_from(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T value{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

}  // namespace gonio
