#include "table/format/brdf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/blanks.h"
#include "base/error.h"
#include "base/few.h"
#include "base/json/reader.h"
#include "base/numbers.h"
#include "table/format/delimited.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

bool json_with(std::string_view head, std::initializer_list<std::string_view> keys) {
  head = without_mark(head);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head.starts_with("{") && head.find("\"gonio.") == head.npos &&
         std::ranges::all_of(
             keys, [&](auto key) { return head.find(fmt::format("\"{}\"", key)) != head.npos; });
}

/// Samples by their directions, channels by their wavelengths, in the order of the file.  A value takes 16 bytes until the table is
/// made: files have two for it at least.
class Geometries {
 public:
  using Deg = std::array<double, 4>;
  /// Directions that no others are the same as.  \return their number, from 0 on
  std::uint32_t add_place(const Deg& deg) {
    places_.push_back(upright(deg));
    return static_cast<std::uint32_t>(places_.size() - 1);
  }
  /// Number of directions, which are the same where the label is, too.
  std::uint32_t place_of(const Deg& deg, const std::string& label) {
    const auto number = labels_.try_emplace(label, labels_.size()).first->second;
    const auto [at, is_new] = known_.try_emplace(std::pair(upright(deg), number), 0);
    if (is_new) at->second = add_place(deg);
    return at->second;
  }
  /// \param u  standard uncertainty of f; NaN: none is stated
  void add(std::uint32_t place,
           double wavelength_nm,
           double f,
           double u = std::numeric_limits<double>::quiet_NaN()) {
    const auto channel = channels_.try_emplace(wavelength_nm, channels_.size()).first->second;
    if (!std::isnan(u)) {
      errors_.resize(values_.size(), std::numeric_limits<double>::quiet_NaN());
      errors_.push_back(u);
    }
    values_.push_back({place, static_cast<std::uint32_t>(channel), f});
  }
  void reserve(std::size_t values) { values_.reserve(values); }

  /// Refuses more than a table holds.
  void expect_room(const JsonReader& j, std::size_t channels) const {
    expect_room(j, places_.size(), channels);
  }
  /// Refuses also other wavelengths at most directions: each sample has room for every channel, and a small file would ask for much
  /// memory.
  Table table(const JsonReader& j, const std::string& format) {
    expect_filled(j, places_.size());
    make_samples();
    const std::size_t samples = directions_.theta_i_deg.size();
    expect_room(j, samples, channels_.size());
    expect_filled(j, samples);

    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Table t;
    t.format = format;
    const auto order = name_channels(t);
    t.values.assign(t.channels.size(), Values(samples, none));
    if (std::ranges::any_of(errors_, [](double u) { return u > 0; })) t.errors = t.values;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const auto& v = values_[k];
      t.values[order[v.channel]][v.place] = v.f;
      if (!t.errors.empty())
        t.errors[order[v.channel]][v.place] = k < errors_.size() ? errors_[k] : none;
    }
    t.where = std::move(directions_);
    return t;
  }

 private:
  /// The same directions without a negative zenith angle.
  static Deg upright(Deg deg) {
    for (const std::size_t k : {0U, 2U})
      if (deg[k] < 0) deg[k] = -deg[k], deg[k + 1] += 180;
    return deg;
  }
  struct Value {
    std::uint32_t place, channel;
    double f;
  };

  void expect_room(const JsonReader& j, std::size_t samples, std::size_t channels) const {
    const std::size_t all = std::max(channels, channels_.size());
    if (all > most_channels || samples * (4 + std::max<std::size_t>(1, all)) > most_values)
      j.fail(fmt::format("at most {} numbers and {} wavelengths", most_values, most_channels));
  }
  void expect_filled(const JsonReader& j, std::size_t samples) const {
    if (samples * channels_.size() > 8 * values_.size() + 64)
      j.fail("other wavelengths at most directions", "all wavelengths at most of them");
  }
  /// Gives each value a sample in place of its directions: measured once more, they are a sample of their own.
  void make_samples() {
    known_.clear();
    labels_.clear();
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> times(places_.size() * channels_.size()),
        first(places_.size(), none);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> again;
    for (auto& v : values_) {
      const auto n = times[v.place * channels_.size() + v.channel]++;
      auto& sample = n == 0 ? first[v.place] : again.try_emplace({v.place, n}, none).first->second;
      if (sample == none) {
        const auto& deg = places_[v.place];
        sample = static_cast<std::uint32_t>(directions_.theta_i_deg.size());
        directions_.theta_i_deg.push_back(deg[0]);
        directions_.phi_i_deg.push_back(deg[1]);
        directions_.theta_o_deg.push_back(deg[2]);
        directions_.phi_o_deg.push_back(deg[3]);
      }
      v.place = sample;
    }
  }
  /// Names the channels after their wavelengths, ascending.  \return their places by the order of the file
  std::vector<std::size_t> name_channels(Table& t) const {
    std::vector<std::size_t> order(channels_.size());
    for (const auto& [nm, channel] : channels_) {
      order[channel] = t.channels.size();
      t.channels.push_back(fmt::format("{:g}", nm));
    }
    const std::set<std::string_view> rounded(t.channels.begin(), t.channels.end());
    if (rounded.size() < t.channels.size()) {  // all digits tell any two apart
      t.channels.clear();
      for (const auto& [nm, channel] : channels_) t.channels.push_back(fmt::format("{}", nm));
    }
    if (channels_.size() == 1) {
      t.channels = {"f"};
      if (const double nm = channels_.begin()->first; nm > 0)
        t.notes.emplace_back("wavelength", fmt::format("{:g} nm", nm));
    }
    return order;
  }

  std::map<double, std::size_t> channels_;
  std::map<std::string, std::size_t> labels_;
  std::map<std::pair<Deg, std::size_t>, std::uint32_t> known_;
  std::vector<Deg> places_;
  DirectionList directions_;
  std::vector<Value> values_;
  std::vector<double> errors_;  ///< of the first values
};

double number_within(const JsonReader& j, double least, double most, const std::string& what) {
  const double v = j.is_number() ? j.number() : std::nan("");
  if (!(v >= least && v <= most)) j.fail(fmt::format("{} in [{:g}, {:g}]", what, least, most));
  return v;
}
double value_in(const JsonReader& j) {
  if (j.is_null()) return std::nan("");
  return number_within(j, -1e30, 1e30, "a value");
}

/// True where words speak of an uncertainty expanded by k = 2.
bool is_expanded(const std::string& words) {
  std::string compact;
  for (const char c : words)
    if (c != ' ') compact += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return compact.find("k=2") != compact.npos || compact.find("expanded") != compact.npos;
}
/// \param f  where it is null, so may its uncertainty be
double uncertainty_in(const JsonReader& j, const JsonReader& f) {
  if (f.is_null() && j.is_null()) return std::nan("");
  const double v = j.is_number() ? j.number() : std::nan("");
  if (!(v > 0 && v <= 1e30)) j.fail("an uncertainty above 0");
  return v;
}

/// What head or metadata says in words and numbers.
void add_notes(const JsonReader& about, Table& t, const std::string& before = "") {
  constexpr std::size_t most_notes = 64, longest = 400;
  about.visit_members([&](const std::string& name, const JsonReader& value) {
    if (t.notes.size() >= most_notes) return;
    if (value.is_string())
      t.notes.emplace_back(before + name, value.string().substr(0, longest));
    else if (value.is_number())
      t.notes.emplace_back(before + name, fmt::format("{:g}", value.number()));
    else if (value.json().is_object() && before.empty())
      add_notes(value, t, name + ".");
  });
}

void tell_polarisation(const std::map<std::string, std::size_t>& counts, Table& t) {
  if (counts.empty() || (counts.size() == 1 && counts.begin()->first == "u")) return;
  std::vector<std::string> each;
  for (const auto& [how, n] : counts) each.push_back(fmt::format("{} {}", n, how));
  t.warnings.push_back(
      fmt::format("samples of polarised light ({}): a model of unpolarised light lies between them",
                  few_of(each)));
}

/// Cones by their solid angles, which files write like 1.2273E10-4 for 1.2273·10⁻⁴.
Aperture aperture_in(const JsonReader& head) {
  const auto width = [&](const char* name) {
    if (!head.has(name)) return 0.0;
    const auto said = head.at(name);
    if (said.is_number()) return width_of_cone(std::max(said.number(), 0.0));
    if (!said.is_string()) return 0.0;
    std::string text = said.string();
    if (const auto at = text.find("E10"); at != text.npos) text.erase(at + 1, 2);
    const auto v = number_in(trimmed(text));
    return v && *v > 0 ? width_of_cone(*v) : 0.0;
  };
  return {width("irradiation_sa"), width("collection_sa")};
}

Table new_form(const JsonReader& data) {
  struct Column {
    std::size_t index;
    double scale = 1;
  };
  std::map<std::string, Column> columns;
  bool relative = false;  // uncertainties
  std::vector<std::size_t> labels;
  std::optional<std::size_t> polarisation;
  const JsonReader variables = data.at("variables");
  constexpr std::size_t most_variables = 1024;
  if (!variables.is_array() || variables.size() > most_variables)
    variables.fail(fmt::format("an array of at most {}", most_variables));
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const JsonReader v = variables.at(k);
    const std::string name = v.at("name").string();
    Column c{k};
    const std::string unit = v.has("unit") && v.at("unit").is_string() ? v.at("unit").string() : "";
    if (name.starts_with("theta_") || name.starts_with("phi_")) {
      if (unit == "rad" || unit == "radian" || unit == "radians")
        c.scale = 1 / degree;
      else if (unit != "deg" && unit != "°" && unit != "degree" && unit != "degrees")
        v.at("unit").fail("deg or rad");
    }
    if (name == "BRDF" && unit.find('%') != unit.npos) v.at("unit").fail("1/sr");
    if (name == "uBRDF" && unit.find('%') != unit.npos) relative = true, c.scale = 0.01;
    if (name == "wavelength_i" && !unit.empty() && unit != "nm") v.at("unit").fail("nm");
    if (!columns.try_emplace(name, c).second) v.at("name").fail("each name once");
    if (name.starts_with("pol_") || name == "pol" || name == "observer") labels.push_back(k);
    if (name == "pol_i") polarisation = k;
  }
  const auto column = [&](const char* name) {
    const auto at = columns.find(name);
    if (at == columns.end()) data.at("variables").fail(fmt::format("no {}", name), "one");
    return at->second;
  };
  const std::array<Column, 4> angles{column("theta_i"), column("phi_i"), column("theta_r"),
                                     column("phi_r")};
  const Column f = column("BRDF");
  std::optional<Column> u;
  if (const auto at = columns.find("uBRDF"); at != columns.end()) {
    u = at->second;
    const JsonReader about = variables.at(u->index);
    if (about.has("description") && about.at("description").is_string() &&
        is_expanded(about.at("description").string()))
      u->scale /= 2;
  }
  const auto wavelength = columns.find("wavelength_i");
  Geometries all;
  std::map<std::string, std::size_t> polarised;
  const JsonReader rows = data.at("values");
  if (!rows.is_array()) rows.fail("an array");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const JsonReader row = rows.at(i);
    if (!row.is_array() || row.size() != variables.size())
      row.fail(fmt::format("a row of {} entries, one a variable", variables.size()));
    std::array<double, 4> deg{};
    for (std::size_t k = 0; k < 4; ++k)
      deg[k] = angles[k].scale * number_within(row.at(angles[k].index), k % 2 ? -720 : -90,
                                               k % 2 ? 720 : 90, "an angle");
    std::string label;
    for (const auto k : labels) label += row.at(k).json().dump() + " ";
    if (polarisation && row.at(*polarisation).is_string())
      ++polarised[row.at(*polarisation).string()];
    all.add(all.place_of(deg, label),
            wavelength == columns.end()
                ? 0
                : number_within(row.at(wavelength->second.index), 1, 1e6, "a wavelength"),
            value_in(row.at(f.index)),
            u ? u->scale * uncertainty_in(row.at(u->index), row.at(f.index)) : std::nan(""));
    all.expect_room(row, 0);
  }
  Table t = all.table(rows, "brdf_json");
  if (relative)
    for (std::size_t c = 0; c < t.errors.size(); ++c) make_absolute(t.errors[c], t.values[c]);
  tell_polarisation(polarised, t);
  return t;
}

/// Entries of an array, or one that stands without.
class Entries {
 public:
  explicit Entries(const JsonReader& all) : all_(all), size_(all.is_array() ? all.size() : 1) {}
  std::size_t size() const { return size_; }
  JsonReader operator[](std::size_t k) const { return all_.is_array() ? all_.at(k) : all_; }

 private:
  JsonReader all_;
  std::size_t size_;
};

/// Counts the letters that say how each geometry's light is polarised.
std::map<std::string, std::size_t> polarised_in(const JsonReader& data, std::size_t geometries) {
  std::map<std::string, std::size_t> counts;
  if (!data.has("pol")) return counts;
  const auto said = data.at("pol");
  const std::string letters = said.is_string() ? said.string() : "";
  const bool each = said.is_array() && said.size() == geometries;
  if (!each && letters.size() != geometries)
    said.fail(fmt::format("one letter for each of {} geometries", geometries));
  for (std::size_t g = 0; g < geometries; ++g)
    if (const auto how = each ? said.at(g).string() : std::string(1, letters[g]); !how.empty())
      ++counts[how];
  return counts;
}

Table old_form(const JsonReader& data) {
  const Entries wavelengths(data.at("wavelengths")), rows(data.at("data"));
  constexpr std::array names{"theta_i", "phi_i", "theta_v", "phi_v"};
  std::vector<Entries> angles;
  for (const auto* name : names) {
    angles.emplace_back(data.at(name));
    if (angles.back().size() != angles[0].size())
      data.at(name).fail(fmt::format("{} angles", angles.back().size()),
                         fmt::format("{}, as theta_i has", angles[0].size()));
  }
  const std::size_t geometries = angles[0].size(), bands = wavelengths.size();
  const auto polarised = polarised_in(data, geometries);
  const std::size_t length = rows.size() == 0 ? 0 : rows[0].size();
  const bool with_wavelength = rows.size() == bands && length == geometries + 1;
  const bool by_wavelength = with_wavelength || (rows.size() == bands && length == geometries);
  if (!by_wavelength && !(rows.size() == geometries && length == bands))
    data.at("data").fail(fmt::format("{} rows of {}", rows.size(), length),
                         fmt::format("{} rows of {} (a wavelength each) or {} of {} (a geometry "
                                     "each)",
                                     bands, geometries, geometries, bands));
  if (bands > most_channels)
    data.at("wavelengths").fail(fmt::format("{}", bands), fmt::format("at most {}", most_channels));
  std::vector<double> nm;
  for (std::size_t w = 0; w < bands; ++w)
    nm.push_back(number_within(wavelengths[w], 1, 1e6, "a wavelength"));
  Geometries all;
  for (std::size_t g = 0; g < geometries; ++g) {
    std::array<double, 4> deg{};
    for (std::size_t k = 0; k < 4; ++k)
      deg[k] = number_within(angles[k][g], k % 2 ? -720 : -90, k % 2 ? 720 : 90, "an angle");
    all.add_place(deg);
    all.expect_room(data, bands);
  }
  all.reserve(geometries * bands);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const JsonReader row = rows[r];
    if (row.size() != length)
      row.fail(fmt::format("{} entries", row.size()), fmt::format("{}", length));
    const std::size_t first = with_wavelength ? 1 : 0;
    if (with_wavelength &&
        !(std::abs(number_within(row.at(std::size_t{0}), 1, 1e6, "a wavelength") - nm[r]) < 1e-3))
      row.at(std::size_t{0}).fail(fmt::format("the wavelength {:g}", nm[r]));
    for (std::size_t k = 0; k + first < length; ++k)
      all.add(static_cast<std::uint32_t>(by_wavelength ? k : r), nm[by_wavelength ? r : k],
              value_in(row.at(k + first)));
  }
  Table t = all.table(data, "brdf_json");
  tell_polarisation(polarised, t);
  return t;
}

}  // namespace

bool is_brdf_json(std::string_view head) {
  return json_with(head, {"data", "head"}) || json_with(head, {"data", "metadata"}) ||
         json_with(head, {"data", "variables"});
}

bool is_xompt(std::string_view head) {
  return json_with(head, {"brdf", "lookupTable"});
}

Table read_brdf_json(InputFile& in) {
  const JsonDocument document(in.path(), in.read_rest(most_document_bytes));
  const auto& root = document.root();
  const auto data = root.at("data");
  Table t = data.has("variables") ? new_form(data) : old_form(data);
  if (t.size() == 0) data.fail("no samples", "one at least");
  for (const char* about : {"head", "metadata"})
    if (root.has(about)) add_notes(root.at(about), t);
  if (root.has("head")) t.aperture = aperture_in(root.at("head"));
  check_aperture(in.path(), t.aperture);
  return t;
}

Table read_xompt(InputFile& in) {
  const JsonDocument document(in.path(), in.read_rest(most_document_bytes));
  const auto rows = document.root().at("brdf").at("lookupTable");
  constexpr double right = std::numbers::pi / 2 * (1 + 1e-6), round = 4 * std::numbers::pi;
  Geometries all;
  if (!rows.is_array()) rows.fail("an array");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const JsonReader row = rows.at(i);
    if (!row.is_array() || row.size() != 5)
      row.fail("wavelength, theta_i, theta_o, delta phi and f");
    const auto angle = [&](std::size_t k, double most) {
      return number_within(row.at(k), -most, most, "an angle in radians") / degree;
    };
    // 550e-9 m is 550 nm, to the digits that files have
    const double nm =
        std::round(number_within(row.at(std::size_t{0}), 1e-9, 1e-3, "a wavelength in metres") *
                   1e15) /
        1e6;
    all.add(all.place_of({angle(1, right), 0, angle(2, right), angle(3, round)}, ""), nm,
            value_in(row.at(4)));
    all.expect_room(row, 0);
  }
  Table t = all.table(rows, "xompt");
  if (t.size() == 0) rows.fail("no samples", "one at least");
  double largest = 0;
  for (const auto& plane : t.values)
    for (const double v : plane) largest = std::max(largest, v);  // NaN is never larger
  constexpr double darkest = 0.01 / std::numbers::pi;
  if (largest < darkest)
    t.warnings.push_back(
        fmt::format("values are at most {:.2g} 1/sr, darker than any paint: public OpenMATERIAL "
                    "files are known "
                    "to be 30 to 100 times too dark",
                    largest));
  if (document.root().has("metadata")) add_notes(document.root().at("metadata"), t);
  return t;
}

}  // namespace gonio
