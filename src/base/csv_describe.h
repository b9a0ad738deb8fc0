#pragma once
/// \file
/// Lines of CSV from fields (base/describe.h): what is one number or one text has a column.

#include <concepts>
#include <string>
#include <tuple>

#include "base/csv.h"
#include "base/describe.h"

#include <fmt/format.h>

namespace gonio {

template <class V>
std::string csv_cell(const V& value) {
  if constexpr (std::floating_point<V>)
    return csv_number(value);
  else if constexpr (std::integral<V>)
    return fmt::format("{}", value);
  else
    return csv_text(value);
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
std::string csv_cells(const std::tuple<Fields...>& fields, const T& of) {
  std::string line;
  std::apply([&](const auto&... f) { ((line += "," + csv_cell(value_in(f.get, of))), ...); },
             fields);
  return line.substr(1);
}

}  // namespace gonio
