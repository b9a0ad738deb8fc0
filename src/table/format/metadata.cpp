#include "table/format/metadata.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "base/json/reader.h"
#include "table/format/measured_by.h"
#include "table/format/side_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();

/// Keys of a described struct that have a name of their own.
template <Described T>
const std::vector<std::string>& keys_of() {
  static const auto keys = [] {
    std::vector<std::string> names;
    for (const auto& f : record_of<T>.fields)
      if (f.role != FieldRole::keyed) names.emplace_back(f.name);
    return names;
  }();
  return keys;
}
/// "no such key; schema, sha256 or notes"
std::string no_such_key(std::vector<std::string> names) {
  const std::string last = std::move(names.back());
  names.pop_back();
  return fmt::format("no such key; {} or {}", fmt::join(names, ", "), last);
}

double number_within(const JsonReader& j, double low, double high) {
  const double v = j.number();
  if (!(v >= low && v <= high))
    j.fail(high < kAny ? fmt::format("a number in [{:g}, {:g}]", low, high)
                       : fmt::format("a number from {:g} on", low));
  return v;
}

Truth read_truth(const JsonReader& j) {
  Truth t;
  t.model = j.at("model").string();
  j.at("parameters").visit_members([&](const std::string& name, const JsonReader& value) {
    t.parameters.emplace_back(name, value.numbers());
    if (!std::ranges::all_of(t.parameters.back().second, [](double v) { return std::isfinite(v); }))
      value.fail("finite numbers");
  });
  t.noise = number_within(j.at("noise"), 0, kAny);
  t.floor = number_within(j.at("floor"), 0, kAny);
  t.outliers = number_within(j.at("outliers"), 0, 1);
  t.seed = j.at("seed").whole_number();
  return t;
}

/// A value of an enumeration.
template <Named E>
E read_name(const JsonReader& j) {
  const auto value = find_value<E>(j.string());
  constexpr auto names = names_of<E>;
  if (!value)
    j.fail(fmt::format("\"{}\" or \"{}\"", fmt::join(names.begin(), names.end() - 1, "\", \""),
                       names.back()));
  return *value;
}

/// A table that other means wrote over an old one must not inherit the old one's truth.
void expect_sha256(const JsonReader& root, const std::string& side, const std::string& is) {
  const auto shortened = [](const std::string& digits) { return digits.substr(0, 12) + "…"; };
  const std::string said = root.has("sha256") ? root.at("sha256").string() : is;
  if (!is.empty() && said != is)
    throw bad_input(side, "sha256", shortened(said),
                    shortened(is) + " (it describes another table and may be removed)");
}

/// CSV writes a grid's angles out: nothing is left to agree on.
bool keeps_bins(const Table& t) {
  return t.has_bins() && t.format != "csv";
}

double scale(const JsonReader& j) {
  const double v = j.number();
  if (!(v > 0 && std::isfinite(v))) j.fail("a finite number above 0");
  return v;
}

CosinePowers read_cosines(const JsonReader& j) {
  const auto powers = j.numbers();
  const auto is_power = [](double p) { return p == std::floor(p) && std::abs(p) <= most_cosines; };
  if (powers.size() != 2 || !std::ranges::all_of(powers, is_power))
    j.fail(fmt::format("two whole numbers from {} to {}", -most_cosines, most_cosines));
  return {static_cast<int>(powers[0]), static_cast<int>(powers[1])};
}

[[noreturn]] void refuse_key(const JsonReader& value) {
  std::vector<std::string> keys{std::string(role_words)};
  std::ranges::copy(keys_of<ColumnMap>(), std::back_inserter(keys));
  value.fail(no_such_key(std::move(keys)));
}

ColumnMap read_column_map(const std::string& file, const JsonReader& j) {
  ColumnMap map;
  std::size_t channels = 0;
  j.visit_members([&](const std::string& key, const JsonReader&) {
    channels += key == "f" || key.starts_with("f_");
  });
  if (channels > most_channels)
    throw bad_input(file, "columns", fmt::format("{} channels", channels),
                    fmt::format("at most {}", most_channels));
  j.visit_members([&](const std::string& key, const JsonReader& value) {
    if (is_role(key))
      map.columns.emplace_back(key, value.string());
    else if (key == "unit")
      map.radians = read_name<AngleUnit>(value) == AngleUnit::radians;
    else if (key == "forward")
      map.forward_deg = number_within(value, -360, 360);
    else if (key == "cosine")
      map.cosines = {0, value.boolean() ? 1 : 0};
    else if (key == "cosines")
      map.cosines = read_cosines(value);
    else if (key == "scale")
      map.scale = scale(value);
    else if (key == "skip")
      map.skip = value.whole_number();
    else
      refuse_key(value);
  });
  return map;
}

/// The table's notes: of those with one name the last, where the first stands.
std::vector<std::pair<std::string, std::string>> notes_of(const Table& t) {
  std::vector<std::pair<std::string, std::string>> all;
  std::map<std::string_view, std::size_t> known;
  for (const auto& [name, text] : t.notes)
    if (const auto [at, is_new] = known.try_emplace(name, all.size()); is_new)
      all.emplace_back(name, text);
    else
      all[at->second].second = text;
  return all;
}

/// Refuses what is no side file.
JsonReader side_of(const JsonDocument& document) {
  const JsonReader& root = document.root();
  const std::string expected = std::string("\"schema\": \"") + side_file_id + "\"";
  if (!root.has("schema")) throw bad_input(root.file(), "schema", "no such key", expected);
  if (root.at("schema").string() != side_file_id) root.at("schema").fail(expected);
  const auto& keys = keys_of<SideFile>();
  root.visit_members([&](const std::string& key, const JsonReader& value) {
    if (std::ranges::find(keys, key) == keys.end()) value.fail(no_such_key(keys));
  });
  return root;
}

}  // namespace

std::string side_path(const std::string& path) {
  return path + ".gonio.json";
}

bool needs_metadata(const Table& t) {
  return t.truth || t.aperture || !t.notes.empty() || t.format == "utia" ||
         (keeps_bins(t) && t.grid()->bins != Bins::centre);
}

std::string metadata_text(const Table& t, const std::string& sha256) {
  SideFile side{sha256, {}, {}, {}, t.truth, notes_of(t), {}, {}};
  if (t.aperture) side.aperture_deg = {t.aperture.light / degree, t.aperture.detector / degree};
  if (t.format == "utia") side.values = UtiaValues::f_r;
  if (keeps_bins(t)) side.bins = t.grid()->bins;
  return text_of(json_of(side));
}

std::string side_file_schema() {
  return schema_text<SideFile>("Side file of a table, FILE.gonio.json");
}

void apply_metadata(Table& t, const std::string& file, const std::string& text) {
  const JsonDocument document(file, text);
  const JsonReader root = side_of(document);
  expect_sha256(root, file, t.sha256);
  if (root.has("bins")) {
    if (!t.has_bins()) root.at("bins").fail("none: this table has no bins");
    std::get<Grid>(t.where).bins = read_name<Bins>(root.at("bins"));
  }
  if (root.has("values")) {
    if (t.format != "utia") root.at("values").fail("none: this table is not UTIA's");
    interpret_utia(t, read_name<UtiaValues>(root.at("values")));
  }
  if (root.has("columns") && t.format != "csv")
    root.at("columns").fail("none: this table is not CSV");
  if (root.has("truth")) t.truth = read_truth(root.at("truth"));
  if (root.has("aperture")) {
    const auto said = root.at("aperture").numbers();
    if (said.size() != 2)
      root.at("aperture").fail("two widths: of the light's cone and the detector's");
    t.aperture = {said[0] * degree, said[1] * degree};
    check_aperture(file, t.aperture);
    if (!t.aperture) root.at("aperture").fail("a width above 0");
  }
  if (root.has("uncertainty")) {
    if (!t.errors.empty()) root.at("uncertainty").fail("none: the table has its own");
    const auto j = root.at("uncertainty");
    const double relative = j.has("relative") ? number_within(j.at("relative"), 0, 1) : 0;
    const double floor = j.has("floor") ? number_within(j.at("floor"), 0, kAny) : 0;
    j.visit_members([](const std::string& key, const JsonReader& value) {
      if (key != "relative" && key != "floor") value.fail("no such key; relative or floor");
    });
    if (!(relative > 0 || floor > 0)) j.fail("relative or floor above 0");
    t.errors = t.values;
    for (auto& plane : t.errors) {
      const double least = std::max(floor, relative * least_sure_value(plane));
      for (double& v : plane) v = std::hypot(relative * v, least);
    }
  }
  if (root.has("notes"))
    root.at("notes").visit_members([&](const std::string& name, const JsonReader& note) {
      t.notes.emplace_back(name, note.string());
    });
}

void expect_same_table(const Table& t, const std::string& file, const std::string& text) {
  const JsonDocument document(file, text);
  expect_sha256(side_of(document), file, t.sha256);
}

std::optional<ColumnMap> column_map(const std::string& file, const std::string& text) {
  const JsonDocument document(file, text);
  const JsonReader root = side_of(document);
  return root.has("columns") ? std::optional(read_column_map(file, root.at("columns")))
                             : std::nullopt;
}

std::string with_columns(const std::string& file, const std::string& text, const ColumnMap& map) {
  Json document = text.empty() ? json_of(SideFile{}) : side_of(JsonDocument(file, text)).json();
  document["columns"] = json_of(map);
  return text_of(document);
}

}  // namespace gonio
