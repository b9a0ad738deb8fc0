#include "table/metadata.h"

#include <algorithm>

#include "base/error.h"
#include "table/json_reader.h"

namespace gonio {
namespace {

constexpr const char* kSchema = "gonio.table/1";

Truth read_truth(const JsonReader& j) {
  Truth t;
  t.model = j.at("model").string();
  for (const auto& [name, value] : j.at("parameters").members())
    t.parameters.emplace_back(name, value.numbers());
  t.noise = j.at("noise").number();
  t.floor = j.at("floor").number();
  t.outliers = j.at("outliers").number();
  t.seed = j.at("seed").whole_number();
  return t;
}

Bins read_bins(const JsonReader& j) {
  const auto name = j.string();
  const auto found = std::ranges::find(bins_names, name);
  if (found == bins_names.end()) j.fail("\"centre\" or \"edge\"");
  return static_cast<Bins>(found - bins_names.begin());
}

/// A table that other means wrote over an old one must not inherit the old one's truth.
void expect_same_table(const std::string& side, const std::string& said, const std::string& is) {
  const auto shortened = [](const std::string& digits) { return digits.substr(0, 12) + "…"; };
  if (said != is)
    throw bad_input(side, "sha256", shortened(said),
                    shortened(is) + " (it describes another table and may be removed)");
}

/// CSV writes a grid's angles out: nothing is left to agree on.
bool keeps_bins(const Table& t) {
  return t.has_bins() && t.format != "csv";
}

}  // namespace

Json truth_json(const Truth& t) {
  return {{"model", t.model},       {"parameters", per_name(t.parameters)},
          {"noise", t.noise},       {"floor", t.floor},
          {"outliers", t.outliers}, {"seed", t.seed}};
}

std::string side_path(const std::string& path) {
  return path + ".gonio.json";
}

bool needs_metadata(const Table& t) {
  return t.truth || !t.notes.empty() || (keeps_bins(t) && t.grid()->bins != Bins::centre);
}

std::string metadata_text(const Table& t, const std::string& sha256) {
  Json j = {{"schema", kSchema}};
  if (!sha256.empty()) j["sha256"] = sha256;
  if (keeps_bins(t)) j["bins"] = bins_names[static_cast<std::size_t>(t.grid()->bins)];
  if (t.truth) j["truth"] = truth_json(*t.truth);
  for (const auto& [name, text] : t.notes) j["notes"][name] = text;
  return text_of(j);
}

void apply_metadata(Table& t, const std::string& file, const std::string& text) {
  const Json document = parse_json(file, text);
  const JsonReader root(file, document);
  if (root.at("schema").string() != kSchema) root.at("schema").fail(kSchema);
  if (root.has("sha256")) expect_same_table(file, root.at("sha256").string(), t.sha256);
  if (root.has("bins")) {
    if (!t.has_bins()) root.at("bins").fail("none: this table has no bins");
    std::get<Grid>(t.where).bins = read_bins(root.at("bins"));
  }
  if (root.has("truth")) t.truth = read_truth(root.at("truth"));
  if (root.has("notes"))
    for (const auto& [name, note] : root.at("notes").members())
      t.notes.emplace_back(name, note.string());
}

}  // namespace gonio
