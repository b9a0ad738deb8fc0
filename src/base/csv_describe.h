#pragma once
/// \file
/// Lines of CSV from fields (base/describe.h): what is one number, one text or one name of an enum has a column.

#include <cmath>
#include <concepts>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "base/csv.h"
#include "base/describe.h"
#include "base/names.h"

#include <fmt/format.h>

namespace gonio {

template <class V>
std::string csv_cell(const V& value, Digits digits = Digits::all) {
  if constexpr (requires { value.has_value(); }) {
    return value ? csv_cell(*value, digits) : "";
  } else if constexpr (std::floating_point<V>) {
    if (digits == Digits::all) return csv_number(value);
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
  } else if constexpr (std::integral<V>) {
    return fmt::format("{}", value);
  } else if constexpr (std::is_enum_v<V>) {
    return csv_text(name_of(value));
  } else {
    return csv_text(value);
  }
}

/// "path,model,log_rms"
template <class... Fields>
std::string csv_columns(const std::tuple<Fields...>& fields) {
  std::string line;
  std::apply([&](const auto&... f) { ((line += "," + csv_text(f.name)), ...); }, fields);
  return line.substr(1);
}

/// Cells of a struct under those columns.
template <class T, class... Fields>
std::string csv_cells(const std::tuple<Fields...>& fields,
                      const T& of,
                      Digits digits = Digits::all) {
  std::string line;
  std::apply(
      [&](const auto&... f) { ((line += "," + csv_cell(value_in(f.get, of), digits)), ...); },
      fields);
  return line.substr(1);
}

/// Lines of structs under the columns of their description.
template <Described T>
std::string csv_of(const std::vector<T>& rows, Digits digits = Digits::all) {
  const auto fields = Description<T>::fields();
  std::string lines = csv_columns(fields) + "\n";
  for (const auto& row : rows) lines += csv_cells(fields, row, digits) + "\n";
  return lines;
}

}  // namespace gonio
