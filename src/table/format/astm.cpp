#include "table/format/astm.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "base/blanks.h"
#include "base/error.h"
#include "base/numbers.h"
#include "table/format/delimited.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view kNames = "VARS", kCount = "NUM_POINTS";
constexpr std::array<std::string_view, 4> kAstmAngles{"theta_i", "phi_i", "theta_s", "phi_s"};

/// Line that begins there, without its end.
std::string_view line_at(std::string_view text, std::size_t at) {
  return text.substr(at, std::min(text.find('\n', at), text.size()) - at);
}
bool has_key(std::string_view line, std::string_view key) {
  return line.starts_with(key) && line.size() > key.size() &&
         blanks.find(line[key.size()]) != blanks.npos;
}

struct AstmHeader {
  std::size_t lines = 0;       ///< above VARS
  std::size_t names = 0;       ///< where VARS begins
  std::string_view count{};    ///< value of NUM_POINTS
  std::size_t count_line = 0;  ///< 0: there is none
};

std::optional<AstmHeader> header_of(std::string_view text) {
  AstmHeader h;
  for (std::size_t at = 0; at < text.size(); ++h.lines) {
    const auto line = line_at(text, at);
    if (has_key(line, kNames)) {
      h.names = at;
      return h;
    }
    if (has_key(line, kCount)) {
      h.count = trimmed(line.substr(kCount.size()));
      h.count_line = h.lines + 1;
    }
    at += line.size() + 1;
  }
  return {};
}

std::string channel_name(const std::string& name, std::size_t channels) {
  if (channels == 1) return "f";
  if (name == "R" || name == "G" || name == "B") return {static_cast<char>(name[0] - 'A' + 'a')};
  return name;
}

}  // namespace

bool is_astm(std::string_view head) {
  const auto h = header_of(head);
  return h && line_at(head, h->names).find(kAstmAngles[0]) != head.npos;
}

Table read_astm(InputFile& in) {
  std::string text = in.read_rest(std::uint64_t{1} << 29);
  const auto header = header_of(text);
  if (!header) throw bad_input(in.path(), "line 1", "no VARS", "one above the numbers");
  // The names alone are left of that line, so that lines are counted as the file has them.
  text.replace(header->names, kNames.size(), kNames.size(), ' ');
  Delimited rows(in.path(), text, header->lines);

  std::array<std::size_t, kAstmAngles.size()> angle{};
  std::vector<std::size_t> values;
  const auto& names = rows.names();
  for (std::size_t k = 0; k < kAstmAngles.size(); ++k) {
    const auto at = std::ranges::find(names, kAstmAngles[k]);
    if (at == names.end())
      rows.fail("", fmt::format("no {} in VARS", kAstmAngles[k]), "theta_i, phi_i, theta_s, phi_s");
    angle[k] = static_cast<std::size_t>(at - names.begin());
  }
  std::unordered_set<std::string_view> known;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!known.insert(names[k]).second)
      rows.fail("", fmt::format("'{}' twice in VARS", names[k]), "each once");
    if (std::ranges::find(angle, k) == angle.end()) values.push_back(k);
  }
  if (values.empty()) rows.fail("", "no values in VARS", "one after the angles");
  if (values.size() > most_channels)
    rows.fail("", fmt::format("{} channels", values.size()),
              fmt::format("at most {}", most_channels));

  Table t;
  t.format = "astm";
  for (const auto k : values) t.channels.push_back(channel_name(names[k], values.size()));
  t.values.resize(values.size());
  std::array<std::vector<double>, kAstmAngles.size()> columns;
  double largest = 0;
  while (rows.next()) {
    if ((columns[0].size() + 1) * (kAstmAngles.size() + values.size()) > most_values)
      rows.fail("", "more samples", fmt::format("at most {} numbers", most_values));
    for (std::size_t k = 0; k < kAstmAngles.size(); ++k) {
      const double x = rows.number(angle[k]);
      // Degrees at most; whether they are radians is known at the end.
      if (!(std::abs(x) <= (k % 2 == 0 ? 90 : 360)))
        rows.fail(rows.label(angle[k]), fmt::format("{}", x), "an angle");
      columns[k].push_back(x);
      largest = std::max(largest, std::abs(x));
    }
    for (std::size_t c = 0; c < values.size(); ++c) t.values[c].push_back(rows.number(values[c]));
  }
  const std::size_t n = columns[0].size();
  if (n == 0) rows.fail("", "no rows", "one at least");
  if (header->count_line > 0 && number_from<std::size_t>(header->count) != n)
    throw bad_input(in.path(), fmt::format("line {}", header->count_line),
                    fmt::format("{} {}", kCount, header->count),
                    fmt::format("{}, as there are rows", n));

  const bool radians = largest <= 2 * std::numbers::pi * (1 + 1e-6);
  for (std::size_t k = 0; k < kAstmAngles.size(); k += 2)
    for (std::size_t i = 0; i < n; ++i) {
      double &theta = columns[k][i], &phi = columns[k + 1][i];
      if (radians && std::abs(theta) > std::numbers::pi / 2 * (1 + 1e-6))
        throw bad_input(in.path(), fmt::format("row {}", i + 1),
                        fmt::format("{} {}", kAstmAngles[k], theta),
                        "at most π/2, as no angle in the file is beyond 2π");
      if (radians) theta /= degree, phi /= degree;
      if (theta < 0) theta = -theta, phi += 180;
    }
  t.where = DirectionList{std::move(columns[0]), std::move(columns[1]), std::move(columns[2]),
                          std::move(columns[3])};
  t.notes.emplace_back("angles", radians ? "radians" : "degrees");
  return t;
}

}  // namespace gonio
