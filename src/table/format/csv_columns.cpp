#include "table/format/csv_columns.h"

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "base/error.h"
#include "base/few.h"
#include "base/numbers.h"
#include "table/format/in_memory.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr const char* hint = "where names or angles differ: gonio columns FILE --map …";

/// Channel of a column with values; of other names none.
std::optional<std::string> channel_of(std::string_view name) {
  if (name == "f") return "f";
  if (name.starts_with("f_")) return std::string(name.substr(2));
  return {};
}

std::string_view without_blanks(std::string_view name) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto from = name.find_first_not_of(blanks);
  return from == name.npos ? "" : name.substr(from, name.find_last_not_of(blanks) - from + 1);
}

/// The role that a column's name is: the blanks that a channel ends with are its own.
std::string role_of(std::string_view name) {
  const auto bare = without_blanks(name);
  return std::string(bare.starts_with("f_") ? name.substr(name.find("f_")) : bare);
}

std::string bracketed(double low, double high) {
  return fmt::format("a number in [{:.4g}, {:.4g}]", low, high);
}

/// Columns by their names, blanks around them apart.
class Names {
 public:
  explicit Names(const std::vector<std::string>& names) {
    for (const auto& name : names) names_.push_back(without_blanks(name));
    order_.resize(names_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, {}, [&](std::size_t k) { return names_[k]; });
  }
  /// Ascending.
  std::span<const std::size_t> columns(std::string_view name) const {
    const auto of = [&](std::size_t k) { return names_[k]; };
    const auto word = without_blanks(name);
    return {std::ranges::lower_bound(order_, word, {}, of),
            std::ranges::upper_bound(order_, word, {}, of)};
  }

 private:
  std::vector<std::string_view> names_;
  std::vector<std::size_t> order_;
};

bool is_value(const CsvColumn& c) {
  return c.channel.has_value();
}

class Chooser {
 public:
  Chooser(Delimited& lines, const std::string& path, const ColumnMap& map)
      : lines_(lines), path_(path), map_(map) {}

  CsvColumns by_name(bool needs_values) {
    std::vector<std::string> roles;
    for (const auto& name : lines_.names()) roles.push_back(role_of(name));
    if (std::ranges::none_of(roles, is_angle))
      lines_.fail("", fmt::format("columns {}", listed()),
                  fmt::format("theta_i, phi_i, theta_o, phi_o and f or f_NAME; {}", hint));
    const auto named = [&](const char* name) {
      return std::ranges::find(roles, name) != roles.end();
    };
    // In plane: azimuths 0.  A negative zenith angle is the other side.
    const bool in_plane =
        named("theta_i") && named("theta_o") && !named("phi_i") && !named("phi_o");
    expect_few_channels(roles);
    std::set<std::string> channels;
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const auto& name = roles[k];
      const auto channel = channel_of(name);
      if (!channel && name != "weight" && !is_angle(name) && !uncertainty_role(name))
        lines_.fail(
            lines_.label(k), "an unknown column",
            fmt::format("theta_i, phi_i, theta_o, phi_o, f, f_NAME, u_f, u_f_NAME or weight; {}",
                        hint));
      if (has(name) || (channel && !channels.insert(*channel).second))
        lines_.fail(name, "a second column of that name", "one");
      add(name, k);
    }
    if (in_plane)
      for (const auto* name : {"phi_i", "phi_o"}) add(name, {}, 0);
    for (const auto name : std::span(angle_roles).first<half_roles>())
      if (!has(name))
        lines_.fail(name, "no such column",
                    fmt::format("theta_i, phi_i, theta_o, phi_o; {}", hint));
    if (needs_values && !has_values())
      lines_.fail("f", "no such column", fmt::format("f or f_NAME; {}", hint));
    return std::move(made_);
  }

  CsvColumns by_map() {
    const Names names(lines_.names());
    std::set<std::size_t> used;
    const auto take = [&](std::size_t index) { return used.insert(index).second; };
    for (auto& [role, column] : expanded()) {
      if (column.starts_with(elevation_mark) && (role == "theta_i" || role == "theta_o") &&
          names.columns(column).empty()) {
        column.erase(0, elevation_mark.size());
        made_.elevations.push_back(angle_place(role));
      }
      if (column == in_header && angle_place(role) < angle_roles.size() &&
          names.columns(column).empty()) {
        if (made_.header)
          throw bad_input(path_, "columns",
                          fmt::format("{} and {} in the header", *made_.header, role),
                          "one of them");
        made_.header = role;
        made_.roles.insert(role);
        continue;
      }
      const auto index = find(names, role, column);
      if (index && !take(*index))
        lines_.fail(column, "a column that is two things", "one of them for " + role);
      if (role == "channel")
        made_.channel = index ? index : throw_no_column(role, column);
      else
        add(role, index, index ? 0 : *number_in(column));
    }
    std::vector<std::string> wanted;
    const bool values_named = has_values() || made_.header, half = has("theta_h") || has("theta_d");
    for (const auto& name : lines_.names()) {
      auto role = role_of(name);
      const auto u = uncertainty_role(role);
      if (is_angle(role)
              ? !half
              : role == "weight" || (!values_named && channel_of(role)) ||
                    (u && (!values_named || u->channel.empty() || has("f_" + u->channel))))
        wanted.push_back(std::move(role));
    }
    expect_few_channels(wanted);
    for (const auto& role : wanted)
      if (const auto index = has(role) ? std::nullopt : find(names, role, role);
          index && take(*index))
        add(role, index);
    using Names4 = std::array<const char*, 4>;
    const auto [zenith, azimuth, other_zenith, other_azimuth] =
        half ? Names4{"theta_h", "phi_h", "theta_d", "phi_d"}
             : Names4{"theta_i", "phi_i", "theta_o", "phi_o"};
    for (const auto* name : {zenith, other_zenith})
      if (!has(name)) throw_no_column(name, name);
    for (const auto* name : {azimuth, other_azimuth})
      if (!has(name)) add(name, {}, 0);
    for (const auto& c : made_.all)
      if (const auto at = angle_place(c.role);
          at < angle_roles.size() && half != (at >= half_roles))
        throw bad_input(path_, "columns", fmt::format("{} beside {}", c.role, zenith),
                        "angles of light and viewer, or half and difference angles");
    if (made_.header) add_matrix(used);
    if (!has_values()) throw_no_column("f", "f");
    std::set<std::string> channels;
    for (const auto& c : made_.all)
      if (c.channel && !channels.insert(*channel_of(c.role)).second)
        throw bad_input(path_, "columns", "two channels named " + *channel_of(c.role), "one");
    if (made_.channel && std::ranges::count_if(made_.all, is_value) > 1)
      throw bad_input(path_, "columns", "channel beside several f_NAME", "channel beside one f");
    return std::move(made_);
  }

 private:
  void add(const std::string& role, std::optional<std::size_t> index, double constant = 0) {
    made_.roles.insert(role);
    CsvColumn c{role,        index, constant, channel_of(role), uncertainty_role(role).has_value(),
                map_.radians};
    const double turn = map_.radians ? degree * 180 : 180;
    if (role.starts_with("theta_")) c.low = -turn, c.high = turn;
    if (role.starts_with("phi_")) c.low = -2 * turn, c.high = 2 * turn;
    if (map_.radians && angle_place(role) < angle_roles.size())
      c.low *= 1 + 1e-6, c.high *= 1 + 1e-6;
    if (c.is_uncertainty) c.low = std::numeric_limits<double>::min();
    if (!c.allows(constant) && !index) c.refuse(lines_, fmt::format("{:.6g}", constant), role);
    made_.all.push_back(std::move(c));
  }

  void expect_few_channels(const std::vector<std::string>& roles) const {
    const auto channels =
        std::ranges::count_if(roles, [](const auto& role) { return channel_of(role).has_value(); });
    if (channels > static_cast<std::ptrdiff_t>(most_channels))
      lines_.fail("", fmt::format("{} channels", channels),
                  fmt::format("at most {}", most_channels));
    constexpr std::size_t most_bytes = 1 << 20;
    std::size_t bytes = 0;
    for (const auto& role : roles) bytes += role.size();
    if (bytes > most_bytes)
      lines_.fail("", fmt::format("{} bytes of names of channels", bytes),
                  fmt::format("at most {}", most_bytes));
  }

  /// Each column that is nothing else, and has a number in its name, has the values at that angle.
  void add_matrix(const std::set<std::size_t>& used) {
    if (has_values())
      throw bad_input(path_, "columns", "f beside an angle in the header", "one of them");
    std::vector<std::string> names = lines_.names();
    if (std::ranges::all_of(names, &std::string::empty) && lines_.next())
      names.assign(lines_.fields().begin(), lines_.fields().end());
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto signed_number = number_in(without_blanks(names[k]));
      const auto angle = signed_number ? signed_number : only_number(names[k]);
      if (used.contains(k) || !angle) continue;
      add(fmt::format("f_#{}", k + 1), k);
      made_.header_angles.push_back(*angle);
      const double limit = (made_.header->starts_with("theta_") ? 180 : 360) *
                           (map_.radians ? degree * (1 + 1e-6) : 1);
      if (!(std::abs(*angle) <= limit))
        lines_.fail(lines_.label(k), fmt::format("{:.6g}", *angle),
                    bracketed(-limit, limit) + " in the header, for " + *made_.header);
    }
    if (made_.header_angles.empty())
      lines_.fail("", "no column with a number in its name", "one angle each for " + *made_.header);
  }

  /// What a pattern such as "U*nm" fixes.
  struct Pattern {
    std::string_view before, after;

    bool matches(std::string_view name) const {
      return name.size() > fixed() && name.starts_with(before) && name.ends_with(after);
    }
    std::size_t fixed() const { return before.size() + after.size(); }
  };
  static std::optional<Pattern> pattern(const std::pair<std::string, std::string>& said) {
    const std::string_view word = said.second;
    const auto star = word.find('*');
    if (!said.first.ends_with("_*") || star == word.npos) return {};
    return Pattern{word.substr(0, star), word.substr(star + 1)};
  }

  /// The map's words, with a column for each that a pattern such as f_*=*nm matches, and none matches that fixes more of
  /// its name.
  std::vector<std::pair<std::string, std::string>> expanded() const {
    constexpr std::ptrdiff_t most_patterns = 64;
    if (const auto n = std::ranges::count_if(
            map_.columns, [](const auto& said) { return pattern(said).has_value(); });
        n > most_patterns)
      throw bad_input(path_, "columns", fmt::format("{} patterns", n),
                      fmt::format("at most {}", most_patterns));
    // Values and their uncertainties, whatever the patterns.
    const std::size_t most = map_.columns.size() + 2 * most_channels;
    std::map<std::string_view, std::size_t> most_fixed;  // of a name
    for (const auto& said : map_.columns)
      if (const auto p = pattern(said))
        for (const auto& whole : lines_.names())
          if (const auto name = without_blanks(whole); p->matches(name))
            most_fixed[name] = std::max(most_fixed[name], p->fixed());
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& said : map_.columns) {
      const auto p = pattern(said);
      if (!p) {
        all.push_back(said);
        continue;
      }
      const auto& [role, word] = said;
      const std::size_t size = all.size();
      for (const auto& whole : lines_.names()) {
        const auto name = without_blanks(whole);
        if (p->matches(name) && p->fixed() == most_fixed[name])
          all.emplace_back(
              role.substr(0, role.size() - 1) + std::string(without_blanks(name.substr(
                                                    p->before.size(), name.size() - p->fixed()))),
              std::string(name));
      }
      if (all.size() == size)
        lines_.fail("", fmt::format("no column like '{}'", word),
                    fmt::format("one of {}", listed()));
      if (all.size() - size > most_channels)
        lines_.fail("", fmt::format("{} channels", all.size() - size),
                    fmt::format("at most {}", most_channels));
      if (all.size() > most)
        lines_.fail("", fmt::format("{} columns by patterns", all.size()),
                    fmt::format("at most {}", most));
    }
    return all;
  }

  /// The column that a map's word means; none if it is a constant.
  std::optional<std::size_t> find(const Names& by_name,
                                  const std::string& role,
                                  const std::string& word) const {
    const auto& names = lines_.names();
    if (const auto found = by_name.columns(word); !word.empty() && !found.empty()) {
      if (found.size() > 1)
        lines_.fail(word, "a second column of that name", "one, or its number as #1");
      return found.front();
    }
    if (word.starts_with('#'))
      if (const auto number = number_from<std::size_t>(std::string_view(word).substr(1));
          number && *number > 0 && *number <= names.size())
        return *number - 1;
    if (!number_in(word)) throw_no_column(role, word);
    return {};
  }

  [[noreturn]] std::optional<std::size_t> throw_no_column(const std::string& role,
                                                          const std::string& word) const {
    lines_.fail("", fmt::format("no column '{}' for {}", word, role),
                fmt::format("one of {} (--skip N passes over lines above the names)", listed()));
  }

  std::string listed() const {
    std::vector<std::string> labels;
    for (std::size_t k = 0; k < lines_.names().size(); ++k) labels.push_back(lines_.label(k));
    return few_of(labels);
  }

  bool has(std::string_view role) const { return made_.has(role); }
  bool has_values() const { return std::ranges::any_of(made_.all, is_value); }

  Delimited& lines_;
  const std::string& path_;
  const ColumnMap& map_;
  CsvColumns made_;
};

}  // namespace

bool CsvColumn::allows(double v) const {
  return channel || (is_uncertainty && std::isnan(v)) || (v >= low && v <= high);
}

void CsvColumn::refuse(const Delimited& lines,
                       std::string_view found,
                       const std::string& label) const {
  std::string expected = is_uncertainty ? "a standard uncertainty above 0" : bracketed(low, high);
  if (angle_place(role) < angle_roles.size()) expected += radians ? " radians" : " degrees";
  if (role.starts_with("theta_")) expected += " (a zenith angle; perhaps columns are swapped)";
  lines.fail(label, found, expected);
}

CsvColumns columns_by_name(Delimited& lines, const std::string& path, bool needs_values) {
  return Chooser(lines, path, {}).by_name(needs_values);
}

CsvColumns columns_by_map(Delimited& lines, const std::string& path, const ColumnMap& map) {
  return Chooser(lines, path, map).by_map();
}

}  // namespace gonio
