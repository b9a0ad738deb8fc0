#include "base/csv.h"

#include <cmath>

#include "base/text.h"

#include <fmt/format.h>

namespace gonio {

std::string csv_quoted(std::string_view text) {
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += c;
    cell += c;
  }
  return cell + '"';
}

std::string csv_text(std::string_view raw) {
  constexpr std::string_view quoted = ",\"", formula = "=+-@";
  const std::string text = printable(raw);
  const bool guarded = !text.empty() && formula.find(text.front()) != formula.npos;
  if (!guarded && text.find_first_of(quoted) == text.npos) return text;
  return csv_quoted(guarded ? "'" + text : text);
}

std::string csv_number(double v) {
  return std::isfinite(v) ? fmt::format("{}", v) : "";
}

}  // namespace gonio
