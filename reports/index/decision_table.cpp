// Decisions as a terminal shows them.
#include <algorithm>
#include <array>

#include "reports/index/decisions.h"

namespace gonio {
namespace {

/// Columns that a text takes at a terminal: its letters.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}
/// Lines of at most so many columns, broken at blanks.
std::vector<std::string> lines_of(std::string_view text, std::size_t most) {
  std::vector<std::string> out{""};
  for (std::size_t from = 0; from <= text.size();) {
    const auto to = std::min(text.find(' ', from), text.size());
    const auto word = text.substr(from, to - from);
    if (!out.back().empty() && width_of(out.back()) + 1 + width_of(word) > most) out.emplace_back();
    out.back() += (out.back().empty() ? "" : " ") + std::string(word);
    from = to + 1;
  }
  return out;
}

}  // namespace

std::string decision_table(std::span<const Decision> all, std::size_t width) {
  constexpr std::size_t columns = 4, gap = 2;
  std::vector<std::array<std::string, columns>> rows{{"for", "take", "error left", "costs"}};
  for (const auto& d : all)
    rows.push_back(
        {without_aside(d.subject), d.take, without_aside(d.error), without_aside(d.cost)});
  std::array<std::size_t, columns> widths{};
  for (const auto& r : rows)
    for (std::size_t k = 0; k < columns; ++k) widths[k] = std::max(widths[k], width_of(r[k]));
  // None of the figures takes more than a quarter; then the first two give way: they are names.
  for (const std::size_t k : {2U, 3U}) widths[k] = std::min(widths[k], width / columns);
  const std::size_t rest = widths[2] + widths[3] + (columns - 1) * gap;
  if (widths[0] + widths[1] + rest > width) {
    const std::size_t room = width - rest;
    widths[0] = std::max(std::min(widths[0], room / 2), room - std::min(widths[1], room));
    widths[1] = room - widths[0];
  }
  std::string out;
  for (const auto& r : rows) {
    std::array<std::vector<std::string>, columns> cells;
    std::size_t lines = 0;
    for (std::size_t k = 0; k < columns; ++k) {
      cells[k] = lines_of(r[k], widths[k]);
      lines = std::max(lines, cells[k].size());
    }
    for (std::size_t i = 0; i < lines; ++i) {
      std::string line;
      for (std::size_t k = 0; k < columns; ++k) {
        const std::string text = i < cells[k].size() ? cells[k][i] : "";
        line += text;
        if (k + 1 < columns)
          line.append(std::max(widths[k] + gap, width_of(text) + 1) - width_of(text), ' ');
      }
      out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  }
  return out;
}

}  // namespace gonio
