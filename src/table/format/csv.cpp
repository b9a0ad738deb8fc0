#include "table/format/csv.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <set>

#include "base/error.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "geometry/half_difference.h"
#include "table/format/columns_command.h"
#include "table/format/csv_columns.h"
#include "table/format/in_memory.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace gonio {
namespace {

constexpr std::uint64_t kMostBytes =
    std::uint64_t{25} * most_values;  ///< as a table's numbers are written

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

/// Numbers of some rows, one after the other.
struct Rows {
  std::size_t count = 0;
  std::vector<std::vector<double>> columns;  ///< [column][row]; empty for constants
  std::vector<std::string_view> channels;    ///< [row]; of text that has them in rows
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
      : map_(map ? *map : ColumnMap()),
        needs_values_(needs_values),
        path_(in.path()),
        text_(text_of(in)),
        lines_(path_, view(text_), map_.skip),
        columns_(map ? columns_by_map(lines_, path_, map_)
                     : columns_by_name(lines_, path_, needs_values)) {}

  Table table() {
    read_rows();
    Table t;
    t.format = "csv";
    t.path = path_;
    t.columns = std::make_shared<const ColumnMap>(map_);
    const bool small = angles_are_small();
    gather_columns(t);
    if (columns_.header) lay_out_matrix(t);
    if (map_.radians)
      for (auto& angle : angles_)
        for (double& a : angle) a /= degree;
    for (const std::size_t k : columns_.elevations)
      for (double& a : angles_[k]) a = 90 - a;
    if (columns_.has("theta_h")) from_half_angles();
    auto& [theta_i, phi_i, theta_o, phi_o, h, ph, d, pd] = angles_;
    DirectionList list{std::move(theta_i), std::move(phi_i), std::move(theta_o), std::move(phi_o)};
    if (!columns_.has("theta_h")) to_conventions(list);
    t.where = std::move(list);
    to_f(t);
    if (columns_.channel) gather_channels(t);
    if (small)
      t.warnings.push_back("no zenith angle is above 1.6°: if they are radians, " +
                           reading_command(t, [](ColumnMap& map) { map.radians = true; }) +
                           " says so");
    // A grid of half and difference angles reaches below the horizon.
    if (needs_values_ && !columns_.has("theta_h")) expect_light_from_above(path_, *t.list());
    warn_of_directions(t, map_.forward_deg);
    return t;
  }

 private:
  /// A row of a matrix becomes as many samples as it has values.
  void lay_out_matrix(Table& t) {
    const std::size_t many = columns_.header_angles.size();
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
    auto& own = angles_[angle_place(*columns_.header)];
    for (std::size_t i = 0; i < rows_; ++i)
      own.insert(own.end(), columns_.header_angles.begin(), columns_.header_angles.end());
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

  void read_rows() {
    Rows& all = rows_of_parts_.emplace_back();
    const auto read_next = [&] {
      if (!lines_.next()) return false;
      add_row(lines_, all);
      if (columns_.channel && !add_channel(lines_.fields()[*columns_.channel]))
        lines_.fail(lines_.label(*columns_.channel), "one more channel",
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
          if (columns_.channel) rows[k].channels.push_back(parts[k].fields()[*columns_.channel]);
        }
      } catch (const Error&) {
        usual = false;
      }
      if ((count += rows[k].count) * columns_.all.size() > most_values) usual = false;
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
    if (++to.count * columns_.all.size() > most_values)
      lines.fail("", fmt::format("more rows of {} columns", columns_.all.size()),
                 fmt::format("at most {} numbers", most_values));
    to.columns.resize(columns_.all.size());
    for (std::size_t k = 0; k < columns_.all.size(); ++k)
      if (columns_.all[k].index) to.columns[k].push_back(number(lines, columns_.all[k]));
  }

  double number(Delimited& lines, const CsvColumn& c) const {
    const auto field = lines.fields()[*c.index];
    if ((c.channel || c.is_uncertainty) && is_gap(field))
      return std::numeric_limits<double>::quiet_NaN();
    const double v = lines.number(*c.index);
    if (!c.allows(v)) c.refuse(lines, field, lines.label(*c.index));
    return v;
  }

  /// All rows of a column.
  template <class All>
  All column(std::size_t k) const {
    if (!columns_.all[k].index) return All(rows_, columns_.all[k].constant);
    All all;
    all.reserve(rows_);
    for (const auto& part : rows_of_parts_)
      if (part.count) all.insert(all.end(), part.columns[k].begin(), part.columns[k].end());
    return all;
  }

  void gather_columns(Table& t) {
    std::vector<std::size_t> plane(columns_.all.size());
    std::size_t uncertainties = 0;
    for (std::size_t k = 0; k < columns_.all.size(); ++k)
      if (columns_.all[k].channel) {
        plane[k] = t.channels.size();
        t.channels.push_back(*columns_.all[k].channel);
      } else if (columns_.all[k].is_uncertainty) {
        plane[k] = uncertainties++;
      }
    t.values.resize(t.channels.size());
    std::vector<Values> stated(uncertainties);
    tbb::parallel_for(std::size_t{0}, columns_.all.size(), [&](std::size_t k) {
      const auto angle = angle_place(columns_.all[k].role);
      if (columns_.all[k].channel)
        t.values[plane[k]] = column<Values>(k);
      else if (columns_.all[k].is_uncertainty)
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
      for (const auto& c : columns_.all) {
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

  void to_conventions(DirectionList& l) const {
    for (double& phi : l.phi_o_deg) phi += 180 - map_.forward_deg;
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
          plane[i] *= map_.scale;
          const auto divide = [&](double theta_deg, int power) {
            if (power == 0) return;
            const double cosine = std::cos(theta_deg * degree);
            plane[i] = cosine < least_cosine ? std::numeric_limits<double>::quiet_NaN()
                                             : plane[i] / std::pow(cosine, power);
          };
          divide(t.list()->theta_i_deg[i], map_.cosines.incident);
          divide(t.list()->theta_o_deg[i], map_.cosines.outgoing);
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
      throw bad_input(path_, "column " + lines_.label(*columns_.channel),
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
    if (map_.radians) return false;
    constexpr double quarter = 1.6, whole = 6.3;  // [rad], a little more than π/2 and 2π
    double largest_out = 0;
    for (std::size_t k = 0; k < columns_.all.size(); ++k) {
      const CsvColumn& c = columns_.all[k];
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

  const ColumnMap map_;
  bool needs_values_;
  std::string path_;
  Text text_;
  Delimited lines_;
  CsvColumns columns_;
  std::map<std::string, std::size_t, std::less<>> channels_;  ///< of rows; their numbers
  std::vector<std::size_t> channel_of_row_;
  std::vector<Rows> rows_of_parts_;  ///< in their order
  std::size_t rows_ = 0;
  std::array<std::vector<double>, angle_roles.size()> angles_;  ///< [role][row]
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

std::vector<ColumnSummary> csv_columns(InputFile& in, std::size_t skip, PassedOver* passed_over) {
  const Text text = text_of(in);
  Delimited lines(in.path(), view(text), skip);
  if (passed_over) *passed_over = lines.passed_over();
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
      half_roles + t.channels.size() + t.errors.size() + (t.weights.empty() ? 0 : 1);
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
