#include "table/format/delimited.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view kBlank = " \t\r";
constexpr char kAnyBlank = ' ';  ///< as a separator: any number of blanks

std::string_view trimmed(std::string_view s) {
  const auto from = s.find_first_not_of(kBlank);
  return from == s.npos ? "" : s.substr(from, s.find_last_not_of(kBlank) - from + 1);
}

std::string_view unquoted(std::string_view s) {
  return s.size() >= 2 && s.front() == '"' && s.back() == '"' ? trimmed(s.substr(1, s.size() - 2))
                                                              : s;
}

/// Where the field that the line begins with ends: at the separator, unless that is quoted.
std::size_t end_of_field(std::string_view line, char separator) {
  const auto end = separator == kAnyBlank ? line.find_first_of(kBlank) : line.find(separator);
  if (line.substr(0, end).find('"') == line.npos) return end;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    const bool separates =
        line[i] == separator || (separator == kAnyBlank && kBlank.find(line[i]) != kBlank.npos);
    if (separates && !quoted) return i;
  }
  return line.npos;
}

void split_into(std::vector<std::string_view>& fields, std::string_view line, char separator) {
  fields.clear();
  for (;;) {
    const auto end = end_of_field(line, separator);
    fields.push_back(unquoted(trimmed(line.substr(0, end))));
    if (end == line.npos) return;
    line.remove_prefix(end + 1);
    if (separator == kAnyBlank) line = trimmed(line);
  }
}

/// A comma may be a decimal sign, so it separates last; blanks may surround any.
char separator_of(std::string_view line) {
  if (line.find(';') != line.npos) return ';';
  const bool comma = line.find(',') != line.npos;
  const bool around_tabs = line.find(",\t") != line.npos || line.find("\t,") != line.npos;
  if (line.find('\t') != line.npos && !around_tabs) return '\t';
  return comma ? ',' : kAnyBlank;
}

bool is_number(std::string_view field) {
  return number_in(field).has_value();
}

/// The next line, trimmed, taken off the text.
std::string_view next_of(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const auto line = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

}  // namespace

std::optional<double> number_in(std::string_view field) {
  std::array<char, 64> with_point;
  if (const auto comma = field.find(','); comma != field.npos) {
    if (field.size() > with_point.size() || field.find('.') != field.npos) return {};
    std::ranges::copy(field, with_point.begin());
    with_point[comma] = '.';
    field = {with_point.data(), field.size()};
  }
  if (field.starts_with('+')) field.remove_prefix(1);
  double v = 0;
  const char* const last = field.data() + field.size();
  const auto [end, error] = std::from_chars(field.data(), last, v);
  return error == std::errc() && end == last ? std::optional(v) : std::nullopt;
}

bool is_gap(std::string_view field) {
  constexpr std::array<std::string_view, 7> gaps{"", "-", "--", "NA", "na", "n/a", "N/A"};
  return std::ranges::find(gaps, field) != gaps.end();
}

bool looks_delimited(std::string_view head) {
  std::vector<std::string_view> fields;
  head = without_mark(head);
  for (int lines = 0; lines < 200 && !head.empty(); ++lines) {
    const auto line = next_of(head);
    if (line.empty() || line[0] == '#') continue;
    for (const char separator : {';', '\t', ',', kAnyBlank}) {
      split_into(fields, line, separator);
      if (std::ranges::count_if(fields, is_number) >= 3) return true;
    }
  }
  return false;
}

std::vector<std::string_view> first_fields(std::string_view head) {
  std::vector<std::string_view> fields;
  head = without_mark(head);
  while (!head.empty()) {
    const auto line = next_of(head);
    if (line.empty() || line[0] == '#') continue;
    split_into(fields, line, separator_of(line));
    break;
  }
  return fields;
}

Delimited::Delimited(std::string path, std::string_view text, std::size_t skip)
    : path_(std::move(path)), rest_(without_mark(text)) {
  for (; skip > 0 && !rest_.empty(); --skip) {
    ++line_number_;
    next_of(rest_);
  }
  header();
}

bool Delimited::next_line() {
  while (!rest_.empty()) {
    ++line_number_;
    line_ = next_of(rest_);
    if (line_.starts_with('#'))
      comment_ = trimmed(line_.substr(1));
    else if (!line_.empty())
      return true;
  }
  return false;
}

void Delimited::header() {
  if (!next_line()) fail("", "no line with names or numbers", "a table");
  separator_ = separator_of(line_);
  split_into(fields_, line_, separator_);
  if (separator_ == '\t' && !std::ranges::all_of(fields_, is_number)) {
    std::vector<std::string_view> by_blanks;
    split_into(by_blanks, line_, kAnyBlank);
    if (std::ranges::all_of(by_blanks, is_number)) separator_ = kAnyBlank, fields_ = by_blanks;
  }
  const std::size_t columns = fields_.size();
  pending_ = std::ranges::any_of(fields_, is_number) &&
             std::ranges::all_of(fields_, [](auto f) { return is_number(f) || is_gap(f); });
  if (pending_) split_into(fields_, comment_, separator_);
  if (fields_.size() == columns)
    names_.assign(fields_.begin(), fields_.end());
  else
    names_.assign(columns, "");
}

bool Delimited::next() {
  if (!pending_ && !next_line()) return false;
  pending_ = false;
  split_into(fields_, line_, separator_);
  if (fields_.size() != names_.size()) {
    const bool commas =
        separator_ == ',' && fields_.size() > names_.size() && line_.find('.') == line_.npos;
    fail("", fmt::format("{} fields", fields_.size()),
         fmt::format("{}{}", names_.size(),
                     commas      ? " (a decimal comma needs ; or a tab between the fields)"
                     : !any_row_ ? " (--skip N passes over lines above the names)"
                                 : ""));
  }
  any_row_ = true;
  return true;
}

double Delimited::number(std::size_t column) {
  const auto field = fields_[column];
  const auto v = number_in(field);
  if (!v) fail(label(column), fmt::format("'{}'", field), "a number");
  points_ = points_ || field.find('.') != field.npos;
  commas_ = commas_ || field.find(',') != field.npos;
  if (points_ && commas_) fail(label(column), field, "decimal points or decimal commas, not both");
  return *v;
}

std::string Delimited::label(std::size_t column) const {
  return names_[column].empty() ? fmt::format("#{}", column + 1) : names_[column];
}

void Delimited::fail(std::string_view column,
                     std::string_view found,
                     const std::string& expected) const {
  const std::string name = column.empty() ? "" : fmt::format(", column {}", column);
  throw bad_input(path_, fmt::format("line {}{}", line_number_, name), std::string(found),
                  expected);
}

}  // namespace gonio
