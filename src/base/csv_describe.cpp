#include "base/csv_describe.h"

#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace gonio {

std::string csv_cell(const ValueRef& value, Digits digits) {
  const ValueType& t = value.type;
  switch (t.kind) {
    case ValueKind::optional: {
      std::string cell;
      t.each(value.at, [&](std::string_view, const void* v) {
        cell = csv_cell({*t.of, v}, digits);
      });
      return cell;
    }
    case ValueKind::number: {
      const double v = t.number(value.at);
      if (digits == Digits::all) return csv_number(v);
      return std::isfinite(v) ? fmt::format("{:.6g}", v) : "";
    }
    case ValueKind::truth:
      return t.whole(value.at) != 0 ? "true" : "false";
    case ValueKind::whole:
      return t.is_signed ? fmt::format("{}", t.whole(value.at))
                         : fmt::format("{}", static_cast<std::uint64_t>(t.whole(value.at)));
    case ValueKind::name:
      return csv_text(t.name(value.at));
    case ValueKind::text:
      return csv_text(t.text(value.at));
    default:
      assert(!"a column of one value");
      return "";
  }
}

std::string csv_columns(std::span<const RecordField> fields) {
  std::string line;
  for (const auto& f : fields) line += "," + csv_text(f.name);
  return line.substr(1);
}

std::string csv_cells(std::span<const RecordField> fields, const void* record, Digits digits) {
  std::string line;
  for (const auto& f : fields)
    f.with_value(record, [&](const void* v) { line += "," + csv_cell({*f.type, v}, digits); });
  return line.substr(1);
}

}  // namespace gonio
