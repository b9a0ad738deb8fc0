#include "table/csv.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::array<std::string_view, 4> kAngles{"theta_i", "phi_i", "theta_o", "phi_o"};
constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view s) {
  const auto from = s.find_first_not_of(kBlank);
  return from == s.npos ? "" : s.substr(from, s.find_last_not_of(kBlank) - from + 1);
}

/// The lines that say something.
class Lines {
 public:
  explicit Lines(std::string_view all) : rest_(all) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }
  bool next() {
    while (!rest_.empty()) {
      ++number;
      const auto end = std::min(rest_.find('\n'), rest_.size());
      text = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (!text.empty() && text[0] != '#') return true;
    }
    return false;
  }
  std::string_view text;
  std::size_t number = 0;

 private:
  std::string_view rest_;
};

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> all;
  for (;;) {
    const auto end = line.find(',');
    all.push_back(trimmed(line.substr(0, end)));
    if (end == line.npos) return all;
    line.remove_prefix(end + 1);
  }
}

struct Column {
  std::string name;
  bool is_value = false;
  double low = 0, high = std::numeric_limits<double>::max();  ///< of what is not a value
  std::vector<double> data = {};
};

/// "" if the name is not that of a column with values.
std::string channel_of(std::string_view name) {
  if (name == "f") return "f";
  return std::string(name.starts_with("f_") ? name.substr(2) : "");
}

class Reader {
 public:
  Reader(InputFile& in, bool needs_values)
      : needs_values_(needs_values),
        path_(in.path()),
        text_(in.read_rest(std::uint64_t{1} << 30)),
        lines_(text_) {}

  Table table() {
    header();
    while (lines_.next()) row();
    if (columns_[0].data.empty()) fail("", "no samples", "at least one line of numbers");
    Table t;
    t.format = "csv";
    t.where = DirectionList{take("theta_i"), take("phi_i"), take("theta_o"), take("phi_o")};
    for (auto& column : columns_)
      if (column.is_value) {
        t.channels.push_back(channel_of(column.name));
        t.values.emplace_back(column.data.begin(), column.data.end());
      }
    t.weights = take("weight");
    return t;
  }

 private:
  [[noreturn]] void fail(std::string_view column,
                         std::string_view found,
                         const std::string& expected) const {
    const std::string name = column.empty() ? "" : fmt::format(", column {}", column);
    throw bad_input(path_, fmt::format("line {}{}", lines_.number, name), std::string(found),
                    expected);
  }

  void header() {
    lines_.next();
    for (const auto name : fields(lines_.text)) {
      Column c{std::string(name), !channel_of(name).empty()};
      if (name.starts_with("theta_")) c.high = 180;
      if (name.starts_with("phi_")) c.low = -360, c.high = 360;
      if (!c.is_value && name != "weight" && std::ranges::find(kAngles, name) == kAngles.end())
        fail(name, "an unknown column", "theta_i, phi_i, theta_o, phi_o, f, f_NAME or weight");
      const auto same = [&](const Column& o) {
        return o.name == name ||
               (c.is_value && o.is_value && channel_of(o.name) == channel_of(name));
      };
      if (std::ranges::any_of(columns_, same)) fail(name, "a second column of that name", "one");
      columns_.push_back(std::move(c));
    }
    for (const auto name : kAngles)
      if (std::ranges::find(columns_, name, &Column::name) == columns_.end())
        fail(name, "no such column", "theta_i, phi_i, theta_o, phi_o");
    if (needs_values_ && std::ranges::none_of(columns_, &Column::is_value))
      fail("f", "no such column", "f or f_NAME");
  }

  void row() {
    std::string_view rest = lines_.text;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const bool last = k + 1 == columns_.size();
      const auto end = rest.find(',');
      if ((end == rest.npos) != last)
        fail("", fmt::format("{} fields", fields(lines_.text).size()),
             fmt::format("{}", columns_.size()));
      number(columns_[k], trimmed(rest.substr(0, end)));
      if (!last) rest.remove_prefix(end + 1);
    }
  }

  void number(Column& c, std::string_view field) const {
    double v = 0;
    const char* last = field.data() + field.size();
    const auto [end, error] = std::from_chars(field.data(), last, v);
    if (error != std::errc() || end != last) fail(c.name, fmt::format("'{}'", field), "a number");
    if (!c.is_value && !(v >= c.low && v <= c.high))
      fail(c.name, field, fmt::format("a number in [{:.4g}, {:.4g}]", c.low, c.high));
    c.data.push_back(v);
  }

  std::vector<double> take(std::string_view name) {
    const auto found = std::ranges::find(columns_, name, &Column::name);
    return found == columns_.end() ? std::vector<double>{} : std::move(found->data);
  }

  bool needs_values_;
  std::string path_, text_;
  Lines lines_;
  std::vector<Column> columns_;
};

void append(std::string& text, double v) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), v).ptr);
}

/// [degrees], in the order of kAngles
std::array<double, 4> angles_of(const Table& t, const SampleAngles& at, std::size_t i) {
  if (const auto* l = t.list())
    return {l->theta_i_deg[i], l->phi_i_deg[i], l->theta_o_deg[i], l->phi_o_deg[i]};
  const auto [wi, wo] = at.directions(i);
  return {theta_of(wi) / degree, phi_of(wi) / degree, theta_of(wo) / degree, phi_of(wo) / degree};
}

}  // namespace

bool is_csv(std::string_view head) {
  Lines lines(head);
  if (!lines.next()) return false;
  return std::ranges::any_of(fields(lines.text), [](std::string_view name) {
    return std::ranges::find(kAngles, name) != kAngles.end();
  });
}

Table read_csv(InputFile& in) {
  return Reader(in, true).table();
}

Table read_directions_csv(InputFile& in) {
  return Reader(in, false).table();
}

void write_csv(const Table& t, OutputFile& out) {
  std::string text = "theta_i,phi_i,theta_o,phi_o";
  for (const auto& channel : t.channels) text += channel == "f" ? ",f" : ",f_" + channel;
  text += t.weights.empty() ? "\n" : ",weight\n";
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (const double angle : angles_of(t, at, i)) {
      append(text, angle);
      text += ',';
    }
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      if (c > 0) text += ',';
      const double v = t.values[c][i];
      append(text, v < 0 && !t.negative_is_noise ? std::numeric_limits<double>::quiet_NaN() : v);
    }
    if (!t.weights.empty()) {
      text += ',';
      append(text, t.weights[i]);
    }
    text += '\n';
    if (text.size() > 1 << 16) {
      out.write(text);
      text.clear();
    }
  }
  out.write(text);
}

}  // namespace gonio
