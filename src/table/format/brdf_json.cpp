#include "table/format/brdf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "base/blanks.h"
#include "base/error.h"
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

/// Samples by their directions, channels by their wavelengths, in the order of the file.
class Geometries {
 public:
  /// \param label  what else tells samples apart
  /// \param u      standard uncertainty of f; NaN: none is stated
  void add(std::array<double, 4> deg,
           const std::string& label,
           double wavelength_nm,
           double f,
           double u = std::numeric_limits<double>::quiet_NaN()) {
    for (const std::size_t k : {0U, 2U})
      if (deg[k] < 0) deg[k] = -deg[k], deg[k + 1] += 180;
    const auto channel = channels_.try_emplace(wavelength_nm, channels_.size()).first->second;
    auto& taken = taken_[std::tuple{deg, label, wavelength_nm}];
    const auto [at, added] =
        samples_.try_emplace(std::tuple{deg, label, taken}, list_.theta_i_deg.size());
    ++taken;  // measured once more: a sample of its own
    if (added) {
      list_.theta_i_deg.push_back(deg[0]);
      list_.phi_i_deg.push_back(deg[1]);
      list_.theta_o_deg.push_back(deg[2]);
      list_.phi_o_deg.push_back(deg[3]);
    }
    values_.push_back({at->second, channel, f, u});
  }
  /// False where that is more than a table holds.
  bool has_room(std::size_t channels) const {
    const std::size_t samples = list_.theta_i_deg.size(),
                      all = std::max(channels, channels_.size());
    return all <= most_channels && samples * (4 + std::max<std::size_t>(1, all)) <= most_values;
  }
  /// Else a small file asks for much memory: each sample has room for every channel.
  bool is_mostly_filled() const {
    return list_.theta_i_deg.size() * channels_.size() <= 8 * values_.size() + 64;
  }
  Table table(const std::string& format) {
    Table t;
    t.format = format;
    std::vector<std::size_t> place(channels_.size());  // by wavelength
    for (const auto& [nm, channel] : channels_) {
      place[channel] = t.channels.size();
      t.channels.push_back(channels_.size() == 1 ? "f" : fmt::format("{:g}", nm));
    }
    if (channels_.size() == 1 && channels_.begin()->first > 0)
      t.notes.emplace_back("wavelength", fmt::format("{:g} nm", channels_.begin()->first));
    t.values.assign(t.channels.size(),
                    Values(list_.theta_i_deg.size(), std::numeric_limits<double>::quiet_NaN()));
    if (std::ranges::any_of(values_, [](const Value& v) { return v.u > 0; })) t.errors = t.values;
    for (const auto& v : values_) {
      t.values[place[v.channel]][v.sample] = v.f;
      if (!t.errors.empty()) t.errors[place[v.channel]][v.sample] = v.u;
    }
    t.where = std::move(list_);
    return t;
  }

 private:
  struct Value {
    std::size_t sample, channel;
    double f, u;
  };
  using Deg = std::array<double, 4>;
  std::map<double, std::size_t> channels_;
  std::map<std::tuple<Deg, std::string, double>, std::size_t> taken_;
  std::map<std::tuple<Deg, std::string, std::size_t>, std::size_t> samples_;
  DirectionList list_;
  std::vector<Value> values_;
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

void expect_room(const JsonReader& j, const Geometries& all, std::size_t channels) {
  if (!all.has_room(channels))
    j.fail(fmt::format("at most {} numbers and {} wavelengths", most_values, most_channels));
}
void expect_filled(const JsonReader& j, const Geometries& all) {
  if (!all.is_mostly_filled())
    j.fail("other wavelengths at most directions", "all wavelengths at most of them");
}

/// What head or metadata says in words and numbers.
void add_notes(const JsonReader& about, Table& t, const std::string& before = "") {
  constexpr std::size_t most_notes = 64, longest = 400;
  for (const auto& [name, value] : about.members()) {
    if (t.notes.size() >= most_notes) return;
    if (value.is_string())
      t.notes.emplace_back(before + name, value.string().substr(0, longest));
    else if (value.is_number())
      t.notes.emplace_back(before + name, fmt::format("{:g}", value.number()));
    else if (value.json().is_object() && before.empty())
      add_notes(value, t, name + ".");
  }
}

void tell_polarisation(const std::map<std::string, std::size_t>& counts, Table& t) {
  if (counts.empty() || (counts.size() == 1 && counts.begin()->first == "u")) return;
  std::vector<std::string> each;
  for (const auto& [how, n] : counts) each.push_back(fmt::format("{} {}", n, how));
  t.warnings.push_back(
      fmt::format("samples of polarised light ({}): a model of unpolarised light lies between them",
                  fmt::join(each, ", ")));
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
  const auto variables = data.at("variables").elements();
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const auto& v = variables[k];
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
    const auto& about = variables[u->index];
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
    all.add(deg, label,
            wavelength == columns.end()
                ? 0
                : number_within(row.at(wavelength->second.index), 1, 1e6, "a wavelength"),
            value_in(row.at(f.index)),
            u ? u->scale * uncertainty_in(row.at(u->index), row.at(f.index)) : std::nan(""));
    expect_room(row, all, 0);
  }
  expect_filled(rows, all);
  Table t = all.table("brdf_json");
  if (relative)
    for (std::size_t c = 0; c < t.errors.size(); ++c) make_absolute(t.errors[c], t.values[c]);
  tell_polarisation(polarised, t);
  return t;
}

Table old_form(const JsonReader& data) {
  const auto wavelengths = data.at("wavelengths").elements();
  std::array<std::vector<JsonReader>, 4> angles;
  constexpr std::array names{"theta_i", "phi_i", "theta_v", "phi_v"};
  for (std::size_t k = 0; k < 4; ++k) {
    angles[k] = data.at(names[k]).elements();
    if (angles[k].size() != angles[0].size())
      data.at(names[k]).fail(fmt::format("{} angles", angles[k].size()),
                             fmt::format("{}, as theta_i has", angles[0].size()));
  }
  const std::size_t geometries = angles[0].size(), bands = wavelengths.size();
  std::vector<std::string> pol(geometries);
  if (data.has("pol")) {
    const auto said = data.at("pol");
    const std::string letters = said.is_string() ? said.string() : "";
    if (said.size() == geometries && said.is_array())
      for (std::size_t g = 0; g < geometries; ++g) pol[g] = said.at(g).string();
    else if (letters.size() == geometries)
      for (std::size_t g = 0; g < geometries; ++g) pol[g] = letters[g];
    else
      said.fail(fmt::format("one letter for each of {} geometries", geometries));
  }
  const auto rows = data.at("data").elements();
  const std::size_t length = rows.empty() ? 0 : rows[0].size();
  const bool with_wavelength = rows.size() == bands && length == geometries + 1;
  const bool by_wavelength = with_wavelength || (rows.size() == bands && length == geometries);
  if (!by_wavelength && !(rows.size() == geometries && length == bands))
    data.at("data").fail(fmt::format("{} rows of {}", rows.size(), length),
                         fmt::format("{} rows of {} (a wavelength each) or {} of {} (a geometry "
                                     "each)",
                                     bands, geometries, geometries, bands));
  Geometries all;
  std::map<std::string, std::size_t> polarised;
  for (std::size_t g = 0; g < geometries; ++g) {
    std::array<double, 4> deg{};
    for (std::size_t k = 0; k < 4; ++k)
      deg[k] = number_within(angles[k][g], k % 2 ? -720 : -90, k % 2 ? 720 : 90, "an angle");
    if (!pol[g].empty()) ++polarised[pol[g]];
    for (std::size_t w = 0; w < bands; ++w) {
      const JsonReader& row = rows[by_wavelength ? w : g];
      if (row.size() != length)
        row.fail(fmt::format("{} entries", row.size()), fmt::format("{}", length));
      const double nm = number_within(wavelengths[w], 1, 1e6, "a wavelength");
      if (with_wavelength && g == 0 &&
          !(std::abs(number_within(row.at(std::size_t{0}), 1, 1e6, "a wavelength") - nm) < 1e-3))
        row.at(std::size_t{0}).fail(fmt::format("the wavelength {:g}", nm));
      all.add(deg, fmt::format("{}", g), nm,
              value_in(row.at(by_wavelength ? g + (with_wavelength ? 1 : 0) : w)));
    }
    expect_room(data, all, bands);
  }
  Table t = all.table("brdf_json");
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
    all.add({angle(1, right), 0, angle(2, right), angle(3, round)}, "", nm, value_in(row.at(4)));
    expect_room(row, all, 0);
  }
  expect_filled(rows, all);
  Table t = all.table("xompt");
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
