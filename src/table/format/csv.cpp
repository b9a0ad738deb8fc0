#include "table/format/csv.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "base/error.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "geometry/half_difference.h"
#include "table/format/columns_command.h"
#include "table/format/delimited.h"
#include "table/format/in_memory.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace gonio {
namespace {

/// Of light and viewer.
constexpr std::span<const std::string_view, 4> kAngles(angle_roles.begin(), 4);
constexpr std::size_t half_roles = 4;  ///< place among angle_roles
constexpr std::uint64_t kMostBytes =
    std::uint64_t{25} * most_values;  ///< as a table's numbers are written
constexpr const char* kHint = "where names or angles differ: gonio columns FILE --map …";

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

bool is_angle(std::string_view name) {
  return std::ranges::find(kAngles, name) != kAngles.end();
}
/// Place among angle_roles, whose size for others.
std::size_t angle_place(std::string_view role) {
  return static_cast<std::size_t>(std::ranges::find(angle_roles, role) - angle_roles.begin());
}

using Text = std::vector<char, ArrayAllocator<char>>;

/// Text of a file, read by all threads into memory that nobody fills before.  The file is not mapped, though that would
/// save a hundredth of the time: another program that cuts it short meanwhile would kill this one, where reading says so.
Text text_of(const InputFile& in) {
  constexpr std::size_t part = std::size_t{1} << 22;
  Text text(in.left(kMostBytes));
  tbb::parallel_for(std::size_t{0}, (text.size() + part - 1) / part, [&](std::size_t k) {
    const std::size_t from = k * part;
    in.read_at(in.position() + from, text.data() + from, std::min(part, text.size() - from));
  });
  return text;
}

std::string_view view(const Text& text) {
  return {text.data(), text.size()};
}

std::string bracketed(double low, double high) {
  return fmt::format("a number in [{:.4g}, {:.4g}]", low, high);
}

/// One thing that is read of each row.
struct Column {
  std::string role;
  std::optional<std::size_t> index;  ///< else the constant
  double constant = 0;
  bool is_value = channel_of(role).has_value();
  bool is_uncertainty = uncertainty_role(role).has_value();
  double low = 0, high = std::numeric_limits<double>::max();  ///< of what is not a value

  bool allows(double v) const {
    return is_value || (is_uncertainty && std::isnan(v)) || (v >= low && v <= high);
  }
};

/// Numbers of some rows, one after the other.
struct Rows {
  std::size_t count = 0;
  std::vector<std::vector<double>> columns;  ///< [column][row]; empty for constants
  std::vector<std::string_view> channels;    ///< [row]; of text that has them in rows
};

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

/// Rows that differ in a channel's name alone become one sample; what repeats is another sample.
class Samples {
 public:
  using Directions = std::array<double, 4>;
  /// Sample that the row's value belongs to.
  std::size_t place(std::size_t channel, const Directions& angles) {
    if (!last_ || last_->first != angles)  // rows of one direction mostly follow each other
      last_ = &*directions_.try_emplace(angles, OfDirection{directions_.size(), {}}).first;
    auto& [direction, samples] = last_->second;
    const std::size_t key = direction * most_channels + channel;
    const std::size_t times = seen_.try_emplace(seen_.end(), key, 0)->second++;
    if (times == samples.size()) samples.push_back(size_++);
    return samples[times];
  }
  std::size_t size() const { return size_; }

 private:
  struct OfDirection {
    std::size_t number;
    std::vector<std::size_t>
        samples;  ///< the k-th has what each channel has there for the k-th time
  };
  std::map<Directions, OfDirection> directions_;
  std::pair<const Directions, OfDirection>* last_ = nullptr;
  std::map<std::size_t, std::size_t> seen_;  ///< times, by direction and channel
  std::size_t size_ = 0;
};

class CsvReader {
 public:
  CsvReader(InputFile& in, const ColumnMap* map, bool needs_values)
      : map_(map),
        needs_values_(needs_values),
        path_(in.path()),
        text_(text_of(in)),
        lines_(path_, view(text_), map ? map->skip : 0) {}

  Table table() {
    if (map_)
      choose_by_map();
    else
      choose_by_name();
    read_rows();
    Table t;
    t.format = "csv";
    t.path = path_;
    t.columns = std::make_shared<const ColumnMap>(*map_);
    const bool small = angles_are_small();
    gather_columns(t);
    if (header_) lay_out_matrix(t);
    if (map_->radians)
      for (auto& angle : angles_)
        for (double& a : angle) a /= degree;
    for (const std::size_t k : elevations_)
      for (double& a : angles_[k]) a = 90 - a;
    if (has("theta_h")) from_half_angles();
    auto& [theta_i, phi_i, theta_o, phi_o, h, ph, d, pd] = angles_;
    DirectionList list{std::move(theta_i), std::move(phi_i), std::move(theta_o), std::move(phi_o)};
    if (!has("theta_h")) to_conventions(list);
    t.where = std::move(list);
    to_f(t);
    if (channel_) gather_channels(t);
    if (small)
      t.warnings.push_back("no zenith angle is above 1.6°: if they are radians, " +
                           reading_command(t, [](ColumnMap& map) { map.radians = true; }) +
                           " says so");
    // A grid of half and difference angles reaches below the horizon.
    if (needs_values_ && !has("theta_h")) expect_light_from_above(path_, *t.list());
    warn_of_directions(t, forward_deg());
    return t;
  }

 private:
  void add(const std::string& role, std::optional<std::size_t> index, double constant = 0) {
    roles_.insert(role);
    Column c{.role = role, .index = index, .constant = constant};
    const double turn = map_->radians ? degree * 180 : 180;
    if (role.starts_with("theta_")) c.low = -turn, c.high = turn;
    if (role.starts_with("phi_")) c.low = -2 * turn, c.high = 2 * turn;
    if (map_->radians && angle_place(role) < angle_roles.size())
      c.low *= 1 + 1e-6, c.high *= 1 + 1e-6;
    if (c.is_uncertainty) c.low = std::numeric_limits<double>::min();
    if (!c.allows(constant) && !index)
      out_of_range(lines_, c, fmt::format("{:.6g}", constant), role);
    columns_.push_back(std::move(c));
  }

  void choose_by_name() {
    std::vector<std::string> roles;
    for (const auto& name : lines_.names()) roles.push_back(role_of(name));
    if (std::ranges::none_of(roles, is_angle))
      lines_.fail("", fmt::format("columns {}", listed()),
                  fmt::format("theta_i, phi_i, theta_o, phi_o and f or f_NAME; {}", kHint));
    const auto named = [&](const char* name) {
      return std::ranges::find(roles, name) != roles.end();
    };
    // In plane: azimuths 0.  A negative zenith angle is the other side.
    const bool in_plane =
        named("theta_i") && named("theta_o") && !named("phi_i") && !named("phi_o");
    map_ = &usual_;
    expect_few_channels(roles);
    std::set<std::string> channels;
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const auto& name = roles[k];
      const auto channel = channel_of(name);
      if (!channel && name != "weight" && !is_angle(name) && !uncertainty_role(name))
        lines_.fail(
            lines_.label(k), "an unknown column",
            fmt::format("theta_i, phi_i, theta_o, phi_o, f, f_NAME, u_f, u_f_NAME or weight; {}",
                        kHint));
      if (has(name) || (channel && !channels.insert(*channel).second))
        lines_.fail(name, "a second column of that name", "one");
      add(name, k);
    }
    if (in_plane)
      for (const auto* name : {"phi_i", "phi_o"}) add(name, {}, 0);
    for (const auto name : kAngles)
      if (!has(name))
        lines_.fail(name, "no such column",
                    fmt::format("theta_i, phi_i, theta_o, phi_o; {}", kHint));
    if (needs_values_ && !has_values())
      lines_.fail("f", "no such column", fmt::format("f or f_NAME; {}", kHint));
  }

  void expect_few_channels(const std::vector<std::string>& roles) const {
    const auto channels =
        std::ranges::count_if(roles, [](const auto& role) { return channel_of(role).has_value(); });
    if (channels > static_cast<std::ptrdiff_t>(most_channels))
      lines_.fail("", fmt::format("{} channels", channels),
                  fmt::format("at most {}", most_channels));
  }

  void choose_by_map() {
    const Names names(lines_.names());
    std::set<std::size_t> used;
    const auto take = [&](std::size_t index) { return used.insert(index).second; };
    for (auto& [role, column] : expanded()) {
      if (column.starts_with(elevation_mark) && (role == "theta_i" || role == "theta_o") &&
          names.columns(column).empty()) {
        column.erase(0, elevation_mark.size());
        elevations_.push_back(angle_place(role));
      }
      if (column == in_header && angle_place(role) < angle_roles.size() &&
          names.columns(column).empty()) {
        if (header_)
          throw bad_input(path_, "columns", fmt::format("{} and {} in the header", *header_, role),
                          "one of them");
        header_ = role;
        roles_.insert(role);
        continue;
      }
      const auto index = find(names, role, column);
      if (index && !take(*index))
        lines_.fail(column, "a column that is two things", "one of them for " + role);
      if (role == "channel")
        channel_ = index ? index : throw_no_column(role, column);
      else
        add(role, index, index ? 0 : *number_in(column));
    }
    std::vector<std::string> wanted;
    const bool values_named = has_values() || header_, half = has("theta_h") || has("theta_d");
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
    for (const auto& c : columns_)
      if (const auto at = angle_place(c.role);
          at < angle_roles.size() && half != (at >= half_roles))
        throw bad_input(path_, "columns", fmt::format("{} beside {}", c.role, zenith),
                        "angles of light and viewer, or half and difference angles");
    if (header_) add_matrix(used);
    if (!has_values()) throw_no_column("f", "f");
    std::set<std::string> channels;
    for (const auto& c : columns_)
      if (c.is_value && !channels.insert(*channel_of(c.role)).second)
        throw bad_input(path_, "columns", "two channels named " + *channel_of(c.role), "one");
    if (channel_ && std::ranges::count_if(columns_, &Column::is_value) > 1)
      throw bad_input(path_, "columns", "channel beside several f_NAME", "channel beside one f");
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
      header_angles_.push_back(*angle);
      const double limit =
          (header_->starts_with("theta_") ? 180 : 360) * (map_->radians ? degree * (1 + 1e-6) : 1);
      if (!(std::abs(*angle) <= limit))
        lines_.fail(lines_.label(k), fmt::format("{:.6g}", *angle),
                    bracketed(-limit, limit) + " in the header, for " + *header_);
    }
    if (header_angles_.empty())
      lines_.fail("", "no column with a number in its name", "one angle each for " + *header_);
  }

  /// A row of a matrix becomes as many samples as it has values.
  void lay_out_matrix(Table& t) {
    const std::size_t many = header_angles_.size();
    if (rows_ * many > most_values / 6)
      throw bad_input(path_, "columns", fmt::format("{} rows of {} values", rows_, many),
                      fmt::format("at most {} values", most_values / 6));
    const auto spread = [&](std::vector<double>& x) {
      std::vector<double> all;
      all.reserve(x.size() * many);
      for (const double v : x) all.insert(all.end(), many, v);
      x = std::move(all);
    };
    for (auto& angle : angles_) spread(angle);
    spread(t.weights);
    auto& own = angles_[angle_place(*header_)];
    for (std::size_t i = 0; i < rows_; ++i)
      own.insert(own.end(), header_angles_.begin(), header_angles_.end());
    for (auto* planes : {&t.values, &t.errors}) {
      if (planes->empty()) continue;
      Values all(rows_ * many);
      for (std::size_t k = 0; k < many; ++k)
        for (std::size_t i = 0; i < rows_; ++i) all[i * many + k] = (*planes)[k][i];
      planes->assign(1, std::move(all));
    }
    t.channels = {"f"};
  }

  /// [degrees]
  void from_half_angles() {
    for (std::size_t k = 0; k < 4; ++k)
      angles_[k] = std::vector<double>(angles_[half_roles].size());
    for (std::size_t i = 0; i < angles_[half_roles].size(); ++i) {
      const auto at = [&](std::size_t k) { return angles_[half_roles + k][i] * degree; };
      const auto [wi, wo] = directions(HalfDifference{at(0), at(1), at(2), at(3)});
      const std::array all{theta_of(wi), phi_of(wi), theta_of(wo), phi_of(wo)};
      for (std::size_t k = 0; k < 4; ++k) angles_[k][i] = all[k] / degree;
    }
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
    std::map<std::string_view, std::size_t> most_fixed;  // of a name
    for (const auto& said : map_->columns)
      if (const auto p = pattern(said))
        for (const auto& whole : lines_.names())
          if (const auto name = without_blanks(whole); p->matches(name))
            most_fixed[name] = std::max(most_fixed[name], p->fixed());
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& said : map_->columns) {
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
    return fmt::format("{}", fmt::join(labels, ", "));
  }

  bool has(std::string_view role) const { return roles_.contains(role); }
  bool has_values() const { return std::ranges::any_of(columns_, &Column::is_value); }

  void read_rows() {
    Rows& all = rows_of_parts_.emplace_back();
    const auto read_next = [&] {
      if (!lines_.next()) return false;
      add_row(lines_, all);
      if (channel_ && !add_channel(lines_.fields()[*channel_]))
        lines_.fail(lines_.label(*channel_), "one more channel",
                    fmt::format("at most {}", most_channels));
      return true;
    };
    if (!read_next()) lines_.fail("", "no samples", "at least one line of numbers");
    if (!read_parts())
      while (read_next()) {
      }
    for (const auto& part : rows_of_parts_) rows_ += part.count;
  }

  /// Reads what is left in parts, on all threads.  False, with no row read, where anything in it is wrong or unusual:
  /// who then reads line by line meets it at its place, and says the same whatever the threads.
  bool read_parts() {
    auto parts = lines_.parts();
    std::vector<Rows> rows(parts.size());
    std::atomic<std::size_t> count = rows_of_parts_[0].count;
    std::atomic<bool> usual = !parts.empty();
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
      if (!usual) return;
      try {
        while (parts[k].next()) {
          add_row(parts[k], rows[k]);
          if (channel_) rows[k].channels.push_back(parts[k].fields()[*channel_]);
        }
      } catch (const Error&) {
        usual = false;
      }
      if ((count += rows[k].count) * columns_.size() > most_values) usual = false;
    });
    if (!usual ||
        (std::ranges::any_of(parts, &Delimited::saw_points) &&
         std::ranges::any_of(parts, &Delimited::saw_commas)) ||
        !add_channels(rows))
      return false;
    std::ranges::move(rows, std::back_inserter(rows_of_parts_));
    return true;
  }

  void add_row(Delimited& lines, Rows& to) const {
    if (++to.count * columns_.size() > most_values)
      lines.fail("", fmt::format("more rows of {} columns", columns_.size()),
                 fmt::format("at most {} numbers", most_values));
    to.columns.resize(columns_.size());
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].index) to.columns[k].push_back(number(lines, columns_[k]));
  }

  double number(Delimited& lines, const Column& c) const {
    const auto field = lines.fields()[*c.index];
    if ((c.is_value || c.is_uncertainty) && is_gap(field))
      return std::numeric_limits<double>::quiet_NaN();
    const double v = lines.number(*c.index);
    if (!c.allows(v)) out_of_range(lines, c, field, lines.label(*c.index));
    return v;
  }

  /// All rows of a column.
  template <class All>
  All column(std::size_t k) const {
    if (!columns_[k].index) return All(rows_, columns_[k].constant);
    All all;
    all.reserve(rows_);
    for (const auto& part : rows_of_parts_)
      if (part.count) all.insert(all.end(), part.columns[k].begin(), part.columns[k].end());
    return all;
  }

  void gather_columns(Table& t) {
    std::vector<std::size_t> plane(columns_.size());
    std::size_t uncertainties = 0;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].is_value) {
        plane[k] = t.channels.size();
        t.channels.push_back(*channel_of(columns_[k].role));
      } else if (columns_[k].is_uncertainty) {
        plane[k] = uncertainties++;
      }
    t.values.resize(t.channels.size());
    std::vector<Values> stated(uncertainties);
    tbb::parallel_for(std::size_t{0}, columns_.size(), [&](std::size_t k) {
      const auto angle = angle_place(columns_[k].role);
      if (columns_[k].is_value)
        t.values[plane[k]] = column<Values>(k);
      else if (columns_[k].is_uncertainty)
        stated[plane[k]] = column<Values>(k);
      else
        (angle < angle_roles.size() ? angles_[angle] : t.weights) = column<std::vector<double>>(k);
    });
    rows_of_parts_.clear();
    give_uncertainties(stated, t);
  }

  /// Each channel has its own, or all have one's.
  void give_uncertainties(const std::vector<Values>& stated, Table& t) const {
    if (stated.empty()) return;
    std::vector<const Values*> of(t.channels.size());
    std::vector<UncertaintyRole> role(t.channels.size());
    for (const bool for_all :
         {false, true}) {  // what is said of one channel beats what is said of all
      const auto before = of;
      std::size_t at = 0;
      for (const auto& c : columns_) {
        const auto of_column = uncertainty_role(c.role);
        if (!of_column) continue;
        const Values* const own = &stated[at++];
        if (of_column->channel.empty() != for_all) continue;
        bool found = false;
        for (std::size_t k = 0; k < of.size(); ++k) {
          if ((!for_all && of_column->channel != t.channels[k]) || before[k]) continue;
          if (of[k])
            throw bad_input(path_, "columns",
                            fmt::format("two uncertainties of f_{}", t.channels[k]),
                            "one, standard (u_f) or expanded (U_f)");
          of[k] = own;
          role[k] = *of_column;
          found = true;
        }
        if (!found && !for_all)
          throw bad_input(
              path_, "columns", fmt::format("{} of no values", c.role),
              fmt::format("the uncertainty of one of f_{}", fmt::join(t.channels, ", f_")));
      }
    }
    for (std::size_t k = 0; k < of.size(); ++k) {
      if (!of[k])
        throw bad_input(path_, "columns", fmt::format("no uncertainty of f_{}", t.channels[k]),
                        "u_f, or one for each f_NAME");
      t.errors.push_back(*of[k]);
      for (double& u : t.errors[k]) u *= role[k].factor;
      if (role[k].relative) make_absolute(t.errors[k], t.values[k]);
      for (std::size_t i = 0; i < t.errors[k].size(); ++i)
        if (std::isfinite(t.values[k][i]) && !(t.errors[k][i] > 0))
          throw bad_input(path_, fmt::format("sample {}", i + 1), "a value without uncertainty",
                          "a standard uncertainty above 0 for each value");
    }
  }

  /// The channel of the next row; false where there are too many.
  bool add_channel(std::string_view name) {
    auto at = channels_.find(name);
    if (at == channels_.end()) {
      if (channels_.size() == most_channels) return false;
      at = channels_.emplace(std::string(name), channels_.size()).first;
    }
    channel_of_row_.push_back(at->second);
    return true;
  }

  /// The channels of all these rows; false where there are too many.
  bool add_channels(const std::vector<Rows>& parts) {
    const auto add = [&](std::string_view name) { return add_channel(name); };
    return std::ranges::all_of(
        parts, [&](const Rows& part) { return std::ranges::all_of(part.channels, add); });
  }

  /// Channels of rows: ascending where all are numbers, else as they come first.
  std::vector<std::pair<std::string, std::size_t>> channels_in_order() const {
    std::vector<std::pair<std::string, std::size_t>> all(channels_.begin(), channels_.end());
    const bool numbers =
        std::ranges::all_of(all, [](const auto& c) { return number_in(c.first).has_value(); });
    std::ranges::sort(all, {}, [&](const auto& c) {
      return numbers ? *number_in(c.first) : static_cast<double>(c.second);
    });
    return all;
  }

  [[noreturn]] void out_of_range(const Delimited& lines,
                                 const Column& c,
                                 std::string_view field,
                                 const std::string& label) const {
    std::string expected =
        c.is_uncertainty ? "a standard uncertainty above 0" : bracketed(c.low, c.high);
    if (angle_place(c.role) < angle_roles.size())
      expected += map_->radians ? " radians" : " degrees";
    if (c.role.starts_with("theta_")) expected += " (a zenith angle; perhaps columns are swapped)";
    lines.fail(label, field, expected);
  }

  void to_conventions(DirectionList& l) const {
    for (double& phi : l.phi_o_deg) phi += 180 - map_->forward_deg;
    const auto to_zenith = [](std::vector<double>& theta, std::vector<double>& phi) {
      for (std::size_t i = 0; i < theta.size(); ++i) {
        if (theta[i] < 0) phi[i] += 180;
        theta[i] = std::abs(theta[i]);
        if (std::abs(phi[i]) >= 360) phi[i] = std::remainder(phi[i], 360);
      }
    };
    to_zenith(l.theta_i_deg, l.phi_i_deg);
    to_zenith(l.theta_o_deg, l.phi_o_deg);
  }

  /// 1/sr without the cosine.
  void to_f(Table& t) const {
    for (auto* planes : {&t.values, &t.errors})
      for (auto& plane : *planes)
        for (std::size_t i = 0; i < plane.size(); ++i) {
          plane[i] *= map_->scale;
          const auto divide = [&](double theta_deg, int power) {
            if (power == 0) return;
            const double cosine = std::cos(theta_deg * degree);
            plane[i] = cosine < least_cosine ? std::numeric_limits<double>::quiet_NaN()
                                             : plane[i] / std::pow(cosine, power);
          };
          divide(t.list()->theta_i_deg[i], map_->cosines.incident);
          divide(t.list()->theta_o_deg[i], map_->cosines.outgoing);
        }
  }

  void gather_channels(Table& t) const {
    const DirectionList rows = *t.list();
    Samples samples;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < rows_; ++i)
      places.push_back(samples.place(channel_of_row_[i], {rows.theta_i_deg[i], rows.phi_i_deg[i],
                                                          rows.theta_o_deg[i], rows.phi_o_deg[i]}));
    // Else a small file could ask for any amount of memory.
    if (samples.size() * channels_.size() > 8 * rows_ + 64 ||
        samples.size() * (channels_.size() + 4) > most_values)
      throw bad_input(path_, "column " + lines_.label(*channel_),
                      fmt::format("{} channels at {} directions in {} rows", channels_.size(),
                                  samples.size(), rows_),
                      "all channels at most of the directions");
    DirectionList l;
    for (auto* angles : {&l.theta_i_deg, &l.phi_i_deg, &l.theta_o_deg, &l.phi_o_deg})
      angles->resize(samples.size());
    const Values column = std::move(t.values[0]);
    const auto weights = std::move(t.weights);
    const auto stated = std::move(t.errors);
    const Values none(samples.size(), std::numeric_limits<double>::quiet_NaN());
    t.values.assign(channels_.size(), none);
    t.errors.assign(stated.empty() ? 0 : channels_.size(), none);
    t.weights.assign(weights.empty() ? 0 : samples.size(), -1);
    for (std::size_t i = 0; i < rows_; ++i) {
      const std::size_t sample = places[i];
      t.values[channel_of_row_[i]][sample] = column[i];
      if (!stated.empty()) t.errors[channel_of_row_[i]][sample] = stated[0][i];
      l.theta_i_deg[sample] = rows.theta_i_deg[i];
      l.phi_i_deg[sample] = rows.phi_i_deg[i];
      l.theta_o_deg[sample] = rows.theta_o_deg[i];
      l.phi_o_deg[sample] = rows.phi_o_deg[i];
      if (weights.empty()) continue;
      if (t.weights[sample] >= 0 && t.weights[sample] != weights[i])
        throw bad_input(path_, "column weight", "a weight for each channel",
                        "one for all channels of a direction");
      t.weights[sample] = weights[i];
    }
    t.where = std::move(l);
    t.channels.clear();
    auto planes = std::move(t.values), errors = std::move(t.errors);
    t.values.clear();
    t.errors.clear();
    for (const auto& [name, channel] : channels_in_order()) {
      t.channels.push_back(name);
      t.values.push_back(std::move(planes[channel]));
      if (!errors.empty()) t.errors.push_back(std::move(errors[channel]));
    }
  }

  /// True where angles said to be degrees look like radians in the file itself: what a sign or --forward adds to an
  /// azimuth would hide it.
  bool angles_are_small() const {
    if (map_->radians) return false;
    constexpr double quarter = 1.6, whole = 6.3;  // [rad], a little more than π/2 and 2π
    double largest_out = 0;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Column& c = columns_[k];
      if (!c.index || !is_angle(c.role)) continue;
      double largest = 0;
      for (const auto& part : rows_of_parts_)
        if (part.count)
          for (const double a : part.columns[k]) largest = std::max(largest, std::abs(a));
      if (largest > (c.role.starts_with("theta_") ? quarter : whole)) return false;
      if (c.role == "theta_o") largest_out = largest;
    }
    return largest_out > 0.5;
  }

  double forward_deg() const { return map_->forward_deg; }

  const ColumnMap* map_;
  const ColumnMap usual_{};
  bool needs_values_;
  std::string path_;
  Text text_;
  Delimited lines_;
  std::vector<Column> columns_;
  std::optional<std::size_t> channel_;
  std::set<std::string, std::less<>> roles_;                  ///< of columns_
  std::map<std::string, std::size_t, std::less<>> channels_;  ///< of rows; their numbers
  std::vector<std::size_t> channel_of_row_;
  std::vector<Rows> rows_of_parts_;  ///< in their order
  std::size_t rows_ = 0;
  std::array<std::vector<double>, angle_roles.size()> angles_;  ///< [role][row]
  std::optional<std::string> header_;    ///< the angle that the columns' names hold
  std::vector<std::size_t> elevations_;  ///< zenith angles, by their place among angle_roles, that
                                         ///< are 90° less their column
  std::vector<double> header_angles_;    ///< in the map's unit; of each value column
};

std::ptrdiff_t beyond(const std::vector<double>& angles, double limit) {
  return std::ranges::count_if(angles, [&](double a) { return std::abs(a) > limit; });
}

/// The mirror direction taken for the light's is the commonest slip, and fits nothing.
void warn_of_backward_peak(Table& t, double forward_deg) {
  const DirectionList& l = *t.list();
  constexpr double none = -HUGE_VAL;
  struct Largest {
    double forward = none, backward = none;
  };
  using Range = tbb::blocked_range<std::size_t>;
  const auto [forward, backward] = tbb::parallel_reduce(
      Range(0, t.size(), 1 << 14), Largest{},
      [&](const Range& r, Largest x) {
        for (std::size_t i = r.begin(); i < r.end(); ++i) {
          if (std::min(l.theta_i_deg[i], l.theta_o_deg[i]) < 20 ||
              std::max(l.theta_i_deg[i], l.theta_o_deg[i]) > 85)
            continue;
          const double towards = std::cos((l.phi_o_deg[i] - l.phi_i_deg[i]) * degree);
          double& largest = towards > 0 ? x.backward : x.forward;
          for (const auto& plane : t.values) largest = std::max(largest, plane[i]);
        }
        return x;
      },
      [](const Largest& x, const Largest& y) {
        return Largest{std::max(x.forward, y.forward), std::max(x.backward, y.backward)};
      });
  if (backward > 3 * forward && backward > 0)
    t.warnings.push_back(fmt::format(
        "{} counted otherwise ({})",
        forward == none
            ? "no value is on the mirror's side, all are on the light's: perhaps azimuths are"
            : fmt::format("values on the light's side reach {:.3g}, on the mirror's side {:.3g}: a "
                          "retro-reflector, or azimuths are",
                          backward, forward),
        reading_command(
            t, [&](ColumnMap& map) { map.forward_deg = std::remainder(forward_deg + 180, 360); })));
}

void append(std::string& text, double v) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), v).ptr);
}

}  // namespace

bool is_csv(std::string_view head) {
  return looks_delimited(head) || std::ranges::any_of(first_fields(head), is_angle);
}

void expect_light_from_above(const std::string& path, const DirectionList& l) {
  const auto n = static_cast<std::ptrdiff_t>(l.theta_i_deg.size());
  if (const auto below = beyond(l.theta_i_deg, 90); 2 * below > n)
    throw bad_input(path, "column theta_i", fmt::format("{} of {} above 90°", below, n),
                    "zenith angles of the light (perhaps columns are swapped)");
}

void warn_of_directions(Table& t, double forward_deg) {
  const DirectionList& l = *t.list();
  const auto n = static_cast<std::ptrdiff_t>(l.theta_i_deg.size());
  if (beyond(l.theta_o_deg, 90) * 5 > 2 * n && beyond(l.phi_o_deg, 90) == 0 &&
      std::ranges::any_of(l.phi_o_deg, [&](double p) { return p != l.phi_o_deg[0]; }))
    t.warnings.push_back(fmt::format(
        "theta_o goes far beyond 90° while phi_o never does: perhaps the two are swapped ({})",
        reading_command(t, [](ColumnMap& map) { exchange(map, "theta_o", "phi_o"); })));
  warn_of_backward_peak(t, forward_deg);
}

Table read_csv(InputFile& in, const ColumnMap* map) {
  return CsvReader(in, map, true).table();
}

Table read_directions_csv(InputFile& in) {
  return CsvReader(in, nullptr, false).table();
}

std::vector<ColumnSummary> csv_columns(InputFile& in, std::size_t skip) {
  const Text text = text_of(in);
  Delimited lines(in.path(), view(text), skip);
  std::vector<ColumnSummary> all;
  for (const auto& name : lines.names()) all.push_back({name});
  std::vector<std::set<std::string, std::less<>>> entries(all.size());
  const std::size_t most = std::clamp<std::size_t>((1 << 22) / (all.size() + 1), 1, 1000);
  for (bool first = true; lines.next(); first = false)
    for (std::size_t k = 0; k < all.size(); ++k) {
      auto& c = all[k];
      const auto field = lines.fields()[k];
      if (entries[k].size() < most && !entries[k].contains(field)) entries[k].emplace(field);
      const auto v = number_in(field);
      if (!v || std::isnan(*v)) continue;
      if (first) c.first = v;
      c.lowest = c.numbers ? std::min(c.lowest, *v) : *v;
      c.highest = c.numbers ? std::max(c.highest, *v) : *v;
      ++c.numbers;
    }
  for (std::size_t k = 0; k < all.size(); ++k) all[k].distinct = entries[k].size();
  return all;
}

void write_csv(const Table& t, OutputFile& out) {
  const std::size_t columns =
      kAngles.size() + t.channels.size() + t.errors.size() + (t.weights.empty() ? 0 : 1);
  if (t.channels.size() > most_channels || t.size() > most_values / columns)
    throw bad_input(out.path(), "writing", fmt::format("{} rows of {} columns", t.size(), columns),
                    fmt::format("at most {} channels and {} numbers, which is read", most_channels,
                                most_values));
  std::string text = "theta_i,phi_i,theta_o,phi_o";
  for (const auto& channel : t.channels)
    text += "," + (channel == "f" ? channel : comma_field("f_" + channel));
  for (std::size_t c = 0; c < t.errors.size(); ++c)
    text += "," + (t.channels[c] == "f" ? "u_f" : comma_field("u_f_" + t.channels[c]));
  text += t.weights.empty() ? "\n" : ",weight\n";
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (const double angle : angles_deg(t, at, i)) {
      append(text, angle);
      text += ',';
    }
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      if (c > 0) text += ',';
      const double v = t.values[c][i];
      append(text, v < 0 && !t.negative_is_noise ? std::numeric_limits<double>::quiet_NaN() : v);
    }
    for (const auto& plane : t.errors) {
      text += ',';
      append(text, plane[i]);
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
