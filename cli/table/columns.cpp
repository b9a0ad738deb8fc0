// gonio columns: what the columns of a CSV file are, said once.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>

#include "base/file.h"
#include "base/json/reader.h"
#include "base/sha256.h"
#include "base/text.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "table/format/column_proposal.h"
#include "table/format/columns_command.h"
#include "table/format/delimited.h"
#include "table/format/formats.h"
#include "table/format/metadata.h"
#include "table/format/no_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct ColumnsCall : Common {
  std::vector<std::string> files, words;
  bool radians = false, cosine = false;
  std::optional<std::string> cosines;
  std::optional<double> forward_deg, scale;
  std::size_t skip = 0;
};

bool says_anything(const ColumnsCall& o) {
  return !o.words.empty() || o.radians || o.cosine || o.cosines || o.forward_deg || o.scale;
}
std::optional<CosinePowers> cosines_of(const ColumnsCall& o) {
  if (o.cosine && o.cosines) throw wrong_usage("--cosine is --cosines 0,1: give one of them");
  if (!o.cosines) return o.cosine ? std::optional(CosinePowers{0, 1}) : std::nullopt;
  CosinePowers powers;
  const char* at = o.cosines->data();
  const char* const end = at + o.cosines->size();
  for (int* power : {&powers.incident, &powers.outgoing}) {
    const auto [next, error] = std::from_chars(at, end, *power);
    const bool last = power == &powers.outgoing;
    if (error != std::errc() || std::abs(*power) > most_cosines ||
        (last ? next != end : next == end || *next != ','))
      throw wrong_usage(fmt::format("--cosines takes I,O, each from {} to {}, not '{}'",
                                    -most_cosines, most_cosines, *o.cosines));
    at = next + 1;
  }
  return powers;
}
/// The options of a call over what is known.
ColumnMap changed(ColumnMap map, const ColumnsCall& o) {
  map.radians = map.radians || o.radians;
  map.cosines = cosines_of(o).value_or(map.cosines);
  map.forward_deg = o.forward_deg.value_or(map.forward_deg);
  map.scale = o.scale.value_or(map.scale);
  if (o.skip != 0) map.skip = o.skip;
  return map;
}
ColumnMap map_of(const ColumnsCall& o) {
  ColumnMap map = changed({}, o);
  for (const auto& word : o.words) {
    const auto at = word.find('=');
    const std::string role = word.substr(0, at);
    if (at == word.npos || at + 1 == word.size())
      throw wrong_usage(fmt::format("--map takes NAME=COLUMN, not '{}'", word));
    if (!is_role(role)) throw wrong_usage(fmt::format("'{}' is none of {}", role, role_words));
    if (std::ranges::find(map.columns, role, [](const auto& c) { return c.first; }) !=
        map.columns.end())
      throw wrong_usage(fmt::format("--map names {} twice", role));
    map.columns.emplace_back(role, word.substr(at + 1));
  }
  return map;
}

/// Constants may stand for the columns that two numbers a line leave open.
void expect_columns(InputFile& in) {
  const std::string head = in.peek(1 << 16);
  expect_no_utf16(in.path(), head);
  expect_no_foreign_format(in.path(), head);
  if (!is_csv(head) && !looks_delimited(head, 2))
    throw bad_input(in.path(), "the beginning", head.substr(0, 24),
                    "text with a line of at least two numbers");
}

/// Map of columns in the side file; none where there is none.
std::optional<ColumnMap> known_map(const std::string& file) {
  const std::string side = side_text(file);
  return side.empty() ? std::nullopt : column_map(side_path(file), side);
}

/// Options without --map change what the side file says, which keeps its columns.
ColumnMap with_known(const ColumnsCall& o, const std::string& file, ColumnMap map) {
  if (!o.words.empty()) return map;
  const auto known = known_map(file);
  if (!known) return map;
  return changed(*known, o);
}

/// The proposal for a file's columns, of which it has these below so many lines.
ColumnProposal proposal_for(InputFile& in,
                            const std::vector<ColumnSummary>& columns,
                            std::size_t skip) {
  auto p = propose_columns(columns, in.path(), in.peek(1 << 14));
  if (!p.map) return p;
  p.map->skip = skip;
  try {
    propose_forward(p, read_csv(in, &*p.map));
  } catch (const Error&) {  // whoever takes the proposal meets it
  }
  return p;
}

/// True where lines to pass over are all that is said, and the names below them are not enough.
bool asks_below(const ColumnsCall& o, const std::string& file) {
  if (o.skip == 0) return true;
  InputFile in(file);
  expect_columns(in);
  const auto p = proposal_for(in, csv_columns(in, o.skip), o.skip);
  return !p.map || p.needed;
}

/// The table as the map makes it, and the text of its side file.
std::pair<Table, std::string> read_with(const ColumnsCall& o,
                                        const std::string& file,
                                        const ColumnMap& said) {
  may_replace(side_path(file));
  const ColumnMap map = with_known(o, file, said);
  InputFile in(file);
  expect_columns(in);
  Table t = read_csv(in, &map);
  t.path = file;
  t.sha256 = sha256_of_file(file);
  std::string side = with_columns(side_path(file), side_text(file), map);
  apply_metadata(t, side_path(file), side);  // what is there already may speak of another table
  return {std::move(t), std::move(side)};
}

struct Peak {
  double value = 0;
  std::size_t sample = 0;
};
Peak largest(const Table& t) {
  Peak p;
  const SampleAngles at(t);
  for (const auto& plane : t.values)
    for (std::size_t i = 0; i < plane.size(); ++i)
      if (plane[i] > p.value && mask(at(i), plane[i]) == Mask::valid) p = {plane[i], i};
  return p;
}

void print(const Table& t) {
  const auto line = [](const char* what, const std::string& text) {
    say("{:<14}{}\n", what, text);
  };
  const DirectionList& l = *t.list();
  const std::set<double> in(l.theta_i_deg.begin(), l.theta_i_deg.end());
  const auto [low, high] = std::ranges::minmax(l.theta_o_deg);
  line("file", t.path);
  line("samples", fmt::format("{}, channels {}", t.size(), fmt::join(t.channels, " ")));
  line("theta_i", in.size() <= 12 ? fmt::format("{:.5g}°", fmt::join(in, "° "))
                                  : fmt::format("{} angles, {:.5g}° to {:.5g}°", in.size(),
                                                *in.begin(), *in.rbegin()));
  line("theta_o", fmt::format("{:.5g}° to {:.5g}°", low, high));
  if (const auto [value, i] = largest(t); value > 0)
    line("largest", fmt::format("{:.4g} 1/sr at theta_i {:.5g}°, theta_o {:.5g}°, phi_o − phi_i "
                                "{:.5g}° (180° is the mirror's side)",
                                value, l.theta_i_deg[i], l.theta_o_deg[i],
                                std::abs(std::remainder(l.phi_o_deg[i] - l.phi_i_deg[i], 360))));
  for (const auto& w : t.warnings) line("beware", w);
  line("written", side_path(t.path));
}

/// The "columns" of a side file, as they stand there.
Json columns_of(const std::string& file, const std::string& side) {
  return parse_json(side_path(file), side)["columns"];
}

Json to_json(const Table& t, const std::string& side) {
  return {{"path", t.path},         {"samples", t.size()},
          {"channels", t.channels}, {"columns", columns_of(t.path, side)},
          {"warnings", t.warnings}, {"written", side_path(t.path)}};
}

void print(const ColumnProposal& p, const std::string& file) {
  for (const auto& reason : p.said) say("{:<14}{}\n", p.map ? "beware" : "unclear", reason);
  if (p.map && !p.needed) {
    say("no map, and none is needed: the columns have the names that gonio reads\n");
    return;
  }
  const std::string command = columns_command(file, p.map.value_or(ColumnMap())) +
                              (p.map ? "" : " theta_i=… phi_i=… theta_o=… phi_o=… f=…");
  say("no map yet; {}:\n  {}\n", p.map ? "the columns' names and ranges suggest" : "one is made by",
      command);
}

Json show(const ColumnsCall& o, const std::string& file, Progress& progress) {
  progress("reading " + file);
  InputFile in(file);
  expect_columns(in);
  const std::size_t skip = o.skip;
  const auto map = skip ? std::nullopt : known_map(file);
  PassedOver above;
  const auto columns = csv_columns(in, map ? map->skip : skip, &above);
  progress.clear();
  Json all = Json::array();
  if (!o.json && above.lines > 0)
    say("{}: passes over {}, '{}'{}\n", file, counted(above.lines, "line"),
        printable(above.first, 40),
        above.last == above.first ? "" : fmt::format(" to '{}'", printable(above.last, 40)));
  if (!o.json)
    say("{}\n{:<8}{:<24}{:>10}{:>14}{:>14}\n", file, "", "name", "different", "from", "to");
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto& c = columns[k];
    if (o.json) {
      all.push_back({{"number", k + 1},
                     {"name", c.name},
                     {"distinct", c.distinct},
                     {"numbers", c.numbers},
                     {"lowest", c.numbers ? Json(c.lowest) : Json()},
                     {"highest", c.numbers ? Json(c.highest) : Json()}});
      continue;
    }
    const std::string name = printable(c.name, 40);
    const auto different = fmt::format("{}{}", c.distinct, c.distinct == 1000 ? "+" : "");
    say("{:<8}{:<24}{:>10}", fmt::format("#{}", k + 1), name, different);
    if (c.numbers)
      fmt::print("{:>14.6g}{:>14.6g}\n", c.lowest, c.highest);
    else
      fmt::print("{:>14}\n", "no numbers");
  }
  Json said = map ? columns_of(file, side_text(file)) : Json();
  Json proposed;
  if (map) {
    if (!o.json) say("{} says {}\n", side_path(file), line_of(said));
  } else {
    const auto p = proposal_for(in, columns, skip);
    if (!o.json) print(p, file);
    if (p.map)
      proposed = {{"columns", columns_of(file, with_columns(side_path(file), "", *p.map))},
                  {"needed", p.needed},
                  {"said", p.said}};
  }
  Json shown = Json::object();  // piece by piece: braces would copy what may be long
  shown["path"] = file;
  shown["passed_over"] = above.lines;
  shown["file_columns"] = std::move(all);
  shown["columns"] = std::move(said);
  shown["proposal"] = std::move(proposed);
  return shown;
}

Exit run(const ColumnsCall& o) {
  Json documents = Json::array();
  Progress progress(o.quiet);
  if (!says_anything(o) &&
      std::ranges::any_of(o.files, [&](const auto& file) { return asks_below(o, file); })) {
    for (const auto& file : o.files) documents.push_back(show(o, file, progress));
  } else {
    const ColumnMap map = map_of(o);
    std::vector<std::pair<Table, std::string>> all;
    for (const auto& file : o.files) {
      progress("reading " + file);
      all.push_back(read_with(o, file, map));
    }
    progress.clear();
    for (const auto& [t, side] : all) {
      write_file(side_path(t.path), side, NamedBy::gonio);
      if (o.json)
        documents.push_back(to_json(t, side));
      else
        print(t);
    }
  }
  const Json& shown = documents.size() == 1 ? documents[0] : documents;
  if (o.json) print_document(shown);
  return Exit::done;
}

}  // namespace

void add_columns(CommandLine& line) {
  auto [c, o] = line.command<ColumnsCall>(
      "columns",
      "Says what the columns of CSV files are, once: written beside each as FILE.gonio.json. "
      "Without options it shows them.",
      "gonio columns PTFE.data.csv --map theta_i=thetai phi_i=phi theta_o=thetar phi_o=phir "
      "f=f_r11 channel=lambda",
      run);
  c.option("FILE", o->files, "CSV: fields between ; tabs, commas or blanks").required();
  c.option(
       "--map", o->words,
       "NAME=COLUMN …: NAME is theta_i, phi_i, theta_o, phi_o, f, f_CHANNEL, u_f, u_percent, "
       "weight, or "
       "channel (each of its entries is one: a wavelength a row); or theta_h, phi_h, theta_d, "
       "phi_d. COLUMN is a name, #k, a "
       "constant such as 0, 90-NAME of an elevation, or header: the columns' names are that angle, "
       "as in a matrix; "
       "f_*=*nm takes every column of that pattern. Unnamed: the column of "
       "that very name; azimuths: 0. Without --map a side file's columns stay")
      .at_most(4096);
  c.flag("--radians", o->radians, "Angles are in radians");
  c.flag("--cosine", o->cosine, "Values are f cos(theta_o)");
  c.option(
      "--cosines", o->cosines,
      "I,O: values are f times cos(theta_i) to the power I and cos(theta_o) to the power O, as "
      "--cosines=0,-1 where f was divided by cos(theta_o)");
  c.option("--forward", o->forward_deg,
           "phi_o − phi_i of the mirror direction in degrees: 0 where phi is counted from where "
           "the light goes to (default: 180)")
      .in(-360.0, 360.0);
  c.option("--scale", o->scale, "Values times this are f in 1/sr: 0.3183099 for a radiance factor")
      .in(1e-12, 1e12);
  c.option("--skip", o->skip,
           "Lines at the top that are passed over (default: lines of words above the table)")
      .in(std::size_t{0}, std::size_t{1'000'000});
  add_output(c, *o);
}

}  // namespace gonio::cli
