#include "table/format/columns_command.h"

#include <algorithm>
#include <utility>

#include "base/text.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Options that say what `map` says and `known` does not.
std::string options_of(const ColumnMap& map, const ColumnMap& known) {
  std::string all;
  if (map.radians && !known.radians) all += " --radians";
  if (map.cosines != known.cosines)
    all += map.cosines == CosinePowers{0, 1}
               ? " --cosine"
               : fmt::format(" --cosines={},{}", map.cosines.incident, map.cosines.outgoing);
  if (map.forward_deg != known.forward_deg) all += fmt::format(" --forward {:g}", map.forward_deg);
  if (map.scale != known.scale) all += fmt::format(" --scale {:.7g}", map.scale);
  if (map.skip != known.skip) all += fmt::format(" --skip {}", map.skip);
  return all;
}

bool is_one_file(const Table& t) {
  return !t.path.empty() && t.path.find(", ") == t.path.npos && (t.format != "csv" || t.columns);
}

}  // namespace

std::string file_word(const Table& t) {
  return is_one_file(t) ? path_word(t.path) : "FILE";
}

std::string columns_command(const std::string& file, const ColumnMap& map) {
  std::string command = "gonio columns " + path_word(file) + " --map";
  for (const auto& [role, column] : map.columns) command += " " + shell_word(role + "=" + column);
  return command + options_of(map, {});
}

std::string column_of(const ColumnMap& map, const std::string& role) {
  const auto said = std::ranges::find(map.columns, role, [](const auto& c) { return c.first; });
  return said == map.columns.end() ? role : said->second;
}

void put_column(ColumnMap& map, const std::string& role, std::string column) {
  const auto said = std::ranges::find(map.columns, role, [](const auto& c) { return c.first; });
  if (said == map.columns.end())
    map.columns.emplace_back(role, std::move(column));
  else
    said->second = std::move(column);
}

void exchange(ColumnMap& map, const std::string& one, const std::string& other) {
  std::string of_one = column_of(map, one), of_other = column_of(map, other);
  put_column(map, one, std::move(of_other));
  put_column(map, other, std::move(of_one));
}

std::string reading_command(const Table& t, const std::function<void(ColumnMap&)>& change) {
  std::string file = is_one_file(t) ? t.path : "FILE", before;
  if (t.format != "csv") {
    before = fmt::format("gonio convert {} {} && ", path_word(file), path_word(file + ".csv"));
    file += ".csv";
  }
  const ColumnMap known = t.columns ? *t.columns : ColumnMap{};
  ColumnMap map = known;
  change(map);
  return before + (map.columns == known.columns
                       ? "gonio columns " + path_word(file) + options_of(map, known)
                       : columns_command(file, map));
}

}  // namespace gonio
