#pragma once
/// \file
/// Lines of CSV from fields (base/describe.h): what is one number, one text or one name of an enum has a column.

#include <string>
#include <vector>

#include "base/csv.h"
#include "base/record.h"

namespace gonio {

/// One value; an optional without one is empty.
std::string csv_cell(const ValueRef&, Digits digits = Digits::all);
/// "path,model,log_rms"
std::string csv_columns(std::span<const RecordField>);
/// Cells of a record under those columns.
std::string csv_cells(std::span<const RecordField>,
                      const void* record,
                      Digits digits = Digits::all);

/// The same of fields that stand in a list of their own.
template <class... Fields>
std::string csv_columns(const FieldList<Fields...>& fields) {
  std::string line;
  with_fields([&](const auto&... f) { ((line += "," + csv_text(f.name)), ...); }, fields);
  return line.substr(1);
}
template <class T, class... Fields>
std::string csv_cells(const FieldList<Fields...>& fields,
                      const T& of,
                      Digits digits = Digits::all) {
  std::string line;
  with_fields(
      [&](const auto&... f) { ((line += "," + csv_cell(value_in(f.get, of), digits)), ...); },
      fields);
  return line.substr(1);
}

/// Lines of structs under the columns of their description.
template <Described T>
std::string csv_of(const std::vector<T>& rows, Digits digits = Digits::all) {
  const auto fields = record_of<T>.fields;
  std::string lines = csv_columns(fields) + "\n";
  for (const auto& row : rows) lines += csv_cells(fields, &row, digits) + "\n";
  return lines;
}

}  // namespace gonio
