#pragma once
/// \file
/// Words whatever their case: the letters of ASCII, which names of formats and materials have.

#include <algorithm>
#include <string_view>

namespace gonio {

constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
constexpr bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower_case, lower_case);
}

}  // namespace gonio
