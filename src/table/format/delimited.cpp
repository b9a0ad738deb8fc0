#include "table/format/delimited.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/blanks.h"
#include "base/csv.h"
#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view kSeparators = ";,\t", kBetween = ";, \t\r";
constexpr char kAnyBlank = ' ';  ///< as a separator: any number of blanks

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// One past the quote that closes the field which s begins with; npos where none does.
std::size_t after_quotes(std::string_view s) {
  for (std::size_t i = s.find('"', 1); i != s.npos; i = s.find('"', i + 2))
    if (!s.substr(i + 1).starts_with('"')) return i + 1;
  return s.npos;
}

/// True where a field may begin behind that character.
bool separates(char c, char separator) {
  return c == separator || (separator == kAnyBlank && is_blank(c));
}

/// End of the field that the line begins with: at a separator that is not in quotes.
std::size_t end_of_field(std::string_view line, char separator) {
  std::size_t from = 0;
  while (from < line.size() && is_blank(line[from]) && line[from] != separator) ++from;
  if (line.substr(from).starts_with('"'))
    if (const auto quoted = after_quotes(line.substr(from)); quoted != line.npos)
      return separator == kAnyBlank ? line.find_first_of(blanks, from + quoted)
                                    : line.find(separator, from + quoted);
  return separator == kAnyBlank ? line.find_first_of(blanks) : line.find(separator);
}

/// Text of a field, out of its quotes.  \param unescaped  keeps what does not stand in the line as it is
std::string_view unquoted(std::string_view s, std::deque<std::string>& unescaped) {
  if (!s.starts_with('"') || after_quotes(s) != s.size()) return s;
  s = s.substr(1, s.size() - 2);
  if (s.find('"') == s.npos) return s;
  std::string& text = unescaped.emplace_back();
  for (std::size_t i = 0; i < s.size(); ++i) {
    text += s[i];
    if (s[i] == '"') ++i;
  }
  return text;
}

/// \param unescaped  see unquoted(); what it held is no longer needed
/// \param most       fields that are kept
/// \return           how many there are
std::size_t split_into(std::vector<std::string_view>& fields,
                       std::deque<std::string>& unescaped,
                       std::string_view line,
                       char separator,
                       std::size_t most = std::string_view::npos) {
  fields.clear();
  unescaped.clear();
  for (std::size_t count = 1;; ++count) {
    const auto end = end_of_field(line, separator);
    if (count <= most) fields.push_back(unquoted(trimmed(line.substr(0, end)), unescaped));
    if (end == line.npos) return count;
    line.remove_prefix(end + 1);
    if (separator == kAnyBlank) line = trimmed(line);
  }
}

/// The line without what it has in quotes.
std::string without_quoted(std::string_view line) {
  std::string out;
  while (!line.empty()) {
    const bool may_begin = out.empty() || kBetween.find(out.back()) != kBetween.npos;
    const auto end = may_begin && line[0] == '"' ? after_quotes(line) : 1;
    if (end == 1) out += line[0];
    line.remove_prefix(std::min(end, line.size()));
  }
  return out;
}

/// A comma may be a decimal sign, so it separates last; blanks may surround any.
char separator_of(std::string_view all) {
  const std::string line = without_quoted(all);
  if (line.find(';') != line.npos) return ';';
  const bool comma = line.find(',') != line.npos;
  const bool around_tabs = line.find(",\t") != line.npos || line.find("\t,") != line.npos;
  if (line.find('\t') != line.npos && !around_tabs) return '\t';
  return comma ? ',' : kAnyBlank;
}

bool is_number(std::string_view field) {
  return number_in(trimmed(field)).has_value();
}

/// Line end of the text: old Macs' where there is no other.
char line_end_of(std::string_view text) {
  return text.find('\n') == text.npos ? '\r' : '\n';
}

/// Next line, trimmed, taken off the text.
std::string_view next_of(std::string_view& text, char line_end) {
  const auto end = std::min(text.find(line_end), text.size());
  const auto line = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// Fields of a line by one separator.
std::vector<std::string> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  std::deque<std::string> unescaped;
  split_into(fields, unescaped, line, separator);
  return {fields.begin(), fields.end()};
}

bool is_unit(const std::string& name) {
  constexpr std::array<std::string_view, 8> all{"deg", "°",    "degrees", "rad",
                                                "sr",  "1/sr", "sr-1",    "sr^-1"};
  return std::ranges::find(all, name) != all.end();
}

/// Lines of words above the table: what is there before the first line of as many names, or numbers, as the two lines
/// of numbers below it have.  0 where the text begins with its table, or where none begins soon.
std::size_t lines_above(std::string_view text) {
  constexpr std::size_t most = 200, least = 3;
  const char line_end = line_end_of(text);
  struct Line {
    std::size_t number;
    std::string_view text;
  };
  std::vector<Line> said;  // what is neither blank nor a comment
  for (std::size_t k = 0; k < most && !text.empty(); ++k)
    if (const auto line = next_of(text, line_end); !line.empty() && line[0] != '#') {
      constexpr std::size_t long_line = 1 << 20;
      if (line.size() > long_line || line.find('"') != line.npos) break;  // quotes hold line ends
      said.push_back({k, line});
    }
  const auto are_numbers = [](const std::vector<std::string>& fields) {
    const auto numbers = std::ranges::count_if(fields, [](const auto& f) { return is_number(f); });
    return numbers >= static_cast<std::ptrdiff_t>(least) &&
           std::ranges::all_of(fields,
                               [](const auto& f) { return is_number(f) || is_gap(trimmed(f)); });
  };
  for (std::size_t k = 0; k + 2 < said.size(); ++k) {
    const char separator = separator_of(said[k].text);
    const auto names = fields_of(said[k].text, separator);
    const std::size_t columns = names.size();
    const auto follows = [&](std::size_t row) {
      const auto fields = fields_of(said[row].text, separator);
      return fields.size() == columns && are_numbers(fields);
    };
    if (columns < least || !follows(k + 1) || !follows(k + 2)) continue;
    if (k == 0) return 0;
    // A line above that looks like names of other columns is a mistake to be reported, and one of
    // units has them above.
    const std::size_t above = fields_of(said[k - 1].text, separator).size();
    const bool names_it =
        !are_numbers(names) && !(above == columns && std::ranges::any_of(names, is_unit));
    return names_it || above < least ? said[k].number : 0;
  }
  return 0;
}

}  // namespace

std::optional<double> number_in(std::string_view field) {
  if (const auto v = number_from<double>(field)) return v;
  std::array<char, 64> with_point;
  const auto comma = field.find(',');
  if (comma == field.npos || field.size() > with_point.size() || field.find('.') != field.npos)
    return {};
  std::ranges::copy(field, with_point.begin());
  with_point[comma] = '.';
  return number_from<double>({with_point.data(), field.size()});
}

bool is_gap(std::string_view field) {
  constexpr std::array<std::string_view, 7> gaps{"", "-", "--", "NA", "na", "n/a", "N/A"};
  return std::ranges::find(gaps, field) != gaps.end();
}

bool looks_delimited(std::string_view head, int least) {
  std::vector<std::string_view> fields;
  std::deque<std::string> unescaped;
  head = without_mark(head);
  const char line_end = line_end_of(head);
  for (int lines = 0; lines < 200 && !head.empty(); ++lines) {
    const auto line = next_of(head, line_end);
    if (line.empty() || line[0] == '#') continue;
    for (const char separator : {';', '\t', ',', kAnyBlank}) {
      split_into(fields, unescaped, line, separator);
      if (std::ranges::count_if(fields, is_number) >= least) return true;
    }
  }
  return false;
}

std::vector<std::string> first_fields(std::string_view head) {
  std::vector<std::string_view> fields;
  std::deque<std::string> unescaped;
  head = without_mark(head);
  const char line_end = line_end_of(head);
  while (!head.empty() && fields.empty()) {
    const auto line = next_of(head, line_end);
    if (!line.empty() && line[0] != '#') split_into(fields, unescaped, line, separator_of(line));
  }
  return {fields.begin(), fields.end()};
}

std::string comma_field(std::string_view name) {
  if (trimmed(name) == name && name.find_first_of(",;\"\t\r\n") == name.npos)
    return std::string(name);
  return csv_quoted(name);
}

std::vector<std::string> comma_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  std::deque<std::string> unescaped;
  split_into(fields, unescaped, line, ',');
  return {fields.begin(), fields.end()};
}

void expect_no_utf16(const std::string& file, std::string_view head) {
  const auto refuse = [&] { throw bad_input(file, "byte 0", "text in UTF-16", "UTF-8"); };
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")) refuse();
  // Without a mark: what stands in such a file is ASCII for the most, every other byte 0.
  const std::size_t pairs = std::min<std::size_t>(head.size() / 2, 64);
  for (const std::size_t low : {0, 1}) {
    std::size_t ascii = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
      const char c = head[2 * i + low];
      ascii += head[2 * i + 1 - low] == 0 && ((c >= ' ' && c <= '~') || c == '\n' || is_blank(c));
    }
    if (pairs >= 4 && ascii > pairs / 2) refuse();
  }
}

Delimited::Delimited(std::string path, std::string_view text, std::size_t skip)
    : path_(std::move(path)), rest_(without_mark(text)), line_end_(line_end_of(text)) {
  expect_no_utf16(path_, text);
  auto& [lines, first, last] = passed_over_;
  const auto pass_over = [&](std::size_t more) {
    for (; more > 0 && !rest_.empty(); --more, ++lines)
      if (const auto line = next_of(rest_, line_end_); !line.empty()) {
        if (first.empty()) first = line;
        last = line;
      }
  };
  pass_over(skip);
  pass_over(lines_above(rest_));
  line_number_ = lines;
  header();
}

/// End of the text's first line, at a line end that is not in quotes.
std::size_t Delimited::end_of_record() const {
  const auto end = rest_.find(line_end_);
  if (rest_.substr(0, end).find('"') == rest_.npos) return end;
  bool may_begin = true;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const char c = rest_[i];
    if (c == '"' && may_begin) {
      const auto quoted = after_quotes(rest_.substr(i));
      if (quoted == rest_.npos)
        fail("", "a quote that does not end", "one at the end of its field too, doubled within");
      i += quoted - 1;
      may_begin = false;
    } else if (c == line_end_) {
      return i;
    } else if (separator_ ? separates(c, separator_) : kSeparators.find(c) != kSeparators.npos) {
      may_begin = true;
    } else if (!is_blank(c)) {
      may_begin = false;
    }
  }
  return rest_.npos;
}

bool Delimited::next_line() {
  while (!rest_.empty()) {
    line_number_ += std::exchange(lines_, 1);
    const auto first = rest_.find_first_not_of(blanks);
    if (first != rest_.npos && rest_[first] == '#') {
      comment_ = trimmed(next_of(rest_, line_end_).substr(1));
      continue;
    }
    const auto end = std::min(end_of_record(), rest_.size());
    line_ = rest_.substr(0, end);
    lines_ += static_cast<std::size_t>(std::ranges::count(line_, line_end_));
    line_ = trimmed(line_);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!line_.empty()) return true;
  }
  return false;
}

void Delimited::header() {
  if (!next_line()) fail("", "no line with names or numbers", "a table");
  separator_ = separator_of(line_);
  constexpr std::ptrdiff_t most_columns = 1 << 20;
  if (std::ranges::count_if(line_, [&](char c) { return separates(c, separator_); }) >=
      most_columns)
    fail("", fmt::format("more than {} columns", most_columns), "fewer");
  split_into(fields_, unescaped_, line_, separator_);
  const auto are_numbers = [](const auto& fields) {
    return std::ranges::all_of(fields, is_number);
  };
  if (separator_ == '\t' && !are_numbers(fields_)) {
    std::vector<std::string_view> by_blanks;
    std::deque<std::string> unescaped;
    split_into(by_blanks, unescaped, line_, kAnyBlank);
    if (are_numbers(by_blanks)) {
      separator_ = kAnyBlank;
      split_into(fields_, unescaped_, line_, separator_);
    }
  }
  const std::size_t columns = fields_.size();
  pending_ = std::ranges::any_of(fields_, is_number) && std::ranges::all_of(fields_, [](auto f) {
               return is_number(f) || is_gap(trimmed(f));
             });
  if (pending_) split_into(fields_, unescaped_, comment_, separator_);
  constexpr std::size_t longest_name = 1 << 16;
  if (const auto longest = std::ranges::max(fields_, {}, &std::string_view::size).size();
      longest > longest_name)
    fail("", fmt::format("a name of {} bytes", longest), fmt::format("at most {}", longest_name));
  if (fields_.size() == columns)
    names_.assign(fields_.begin(), fields_.end());
  else
    names_.assign(columns, "");
}

bool Delimited::next() {
  if (!pending_ && !next_line()) return false;
  pending_ = false;
  const auto count = split_into(fields_, unescaped_, line_, separator_, names_.size());
  for (auto& field : fields_) field = trimmed(field);
  if (count != names_.size()) {
    const bool commas = separator_ == ',' && count > names_.size() && line_.find('.') == line_.npos;
    fail("", fmt::format("{} fields", count),
         fmt::format("{}{}", names_.size(),
                     commas      ? " (a decimal comma needs ; or a tab between the fields)"
                     : !any_row_ ? " (--skip N passes over lines above the names)"
                                 : ""));
  }
  any_row_ = true;
  return true;
}

std::vector<Delimited> Delimited::parts() const {
  constexpr std::size_t least = std::size_t{1} << 20;
  std::vector<Delimited> all;
  if (pending_ || rest_.size() < 2 * least || rest_.find('"') != rest_.npos) return all;
  std::size_t size = comment_.size();  // each has the names, too
  for (const auto& name : names_) size += sizeof name + name.size();
  size = std::max(least, 32 * size);
  for (auto rest = rest_; !rest.empty();) {
    const auto end = rest.find(line_end_, std::min(size, rest.size()));
    all.push_back(*this);
    all.back().rest_ = rest.substr(0, end);
    rest.remove_prefix(std::min(end, rest.size() - 1) + 1);
  }
  return all;
}

double Delimited::number(std::size_t column) {
  const auto field = fields_[column];
  const auto v = number_in(field);
  if (!v) fail(label(column), in_quotes(field), "a number");
  saw_points_ = saw_points_ || field.find('.') != field.npos;
  saw_commas_ = saw_commas_ || field.find(',') != field.npos;
  if (saw_points_ && saw_commas_)
    fail(label(column), field, "decimal points or decimal commas, not both");
  return *v;
}

std::string Delimited::label(std::size_t column) const {
  return names_[column].empty() ? fmt::format("#{}", column + 1) : names_[column];
}

void Delimited::fail(std::string_view column,
                     std::string_view found,
                     const std::string& expected) const {
  const std::string name = column.empty() ? "" : fmt::format(", column {}", column);
  throw bad_input(path_, fmt::format("line {}{}", line_number_, name),
                  std::string(beginning(found, 100)), expected);
}

}  // namespace gonio
