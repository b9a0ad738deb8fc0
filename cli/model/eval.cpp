// gonio eval: a model or a table at given directions.
#include "answer/file_functions.h"
#include "answer/model_argument.h"
#include "answer/values.h"
#include "base/file.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "table/format/csv.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct EvalCall : Common {
  ReadingWords reading;
  std::string what, directions, output;
  std::vector<std::string> set;
  std::optional<Bins> bins;
};

/// Gives the table of directions the channels, whose columns are to be filled.
std::vector<double*> columns_for(Table& at, const std::vector<std::string>& channels) {
  std::vector<double*> columns;
  at.channels = channels;
  at.values.assign(channels.size(), Values(at.list()->theta_i_deg.size()));
  for (auto& column : at.values) columns.push_back(column.data());
  return columns;
}

Exit run(const EvalCall& o) {
  use(o);
  if (o.output.empty() && !o.json) throw wrong_usage("eval needs -o FILE or --json");
  auto inputs = file_in(o.what);
  inputs.push_back(o.directions);
  check_outputs(inputs, {o.output});
  Progress progress(o.quiet);
  progress("evaluating");
  InputFile in(o.directions);
  Table t = read_directions_csv(in);
  t.values.clear(), t.weights.clear();
  const DirectionColumns at = columns_of(*t.list());
  nlohmann::ordered_json document;
  if (names_table(o.what)) {
    if (!o.set.empty()) throw wrong_usage("--set goes with a model, not with a table");
    const Table table = read_table(o.what, o.bins);
    interpolate_at(table, at, columns_for(t, table.channels));
    document["table"] = o.what;
  } else {
    if (o.bins) throw wrong_usage("--bins goes with a table, not with a model");
    const auto model = model_argument(read_as(o.what, o.reading), parse_settings(o.set));
    evaluate_at(model.model, at, columns_for(t, model.channels));
    document["model"] = to_text(model.model.model.spec);
    add_own_files(document, to_text(model.model.model.spec));
  }
  if (!o.output.empty()) {
    OutputFile out(o.output);
    write_csv(t, out);
    out.commit();
  }
  progress.clear();
  if (o.json) {
    auto& rows = document["rows"] = nlohmann::ordered_json::array();
    const auto& l = *t.list();
    for (std::size_t i = 0; i < t.size(); ++i) {
      std::vector<double> f;
      for (const auto& channel : t.values) f.push_back(channel[i]);
      rows.push_back({{"theta_i", l.theta_i_deg[i]},
                      {"phi_i", l.phi_i_deg[i]},
                      {"theta_o", l.theta_o_deg[i]},
                      {"phi_o", l.phi_o_deg[i]},
                      {"f", f}});
    }
    print_document(document);
  }
  return Exit::done;
}

}  // namespace

void add_eval(CommandLine& line) {
  auto [c, o] = line.command<EvalCall>(
      "eval",
      "Evaluates a model, or a table between its samples, at the directions of a "
      "CSV file: f_r, f_g, f_b, or f of one channel, in 1/sr, no cosine",
      "gonio eval ggx/smith_ggx.correlated/conductor --set alpha=0.2 metal=Au "
      "--directions in.csv -o out.csv",
      run);
  c.option("MODEL", o->what, "Model, the fit.json of a fit, or a table").required();
  add_set(c, o->set);
  add_reading(c, o->reading);
  add_bins(c, o->bins);
  c.option("--directions", o->directions, "CSV with theta_i,phi_i,theta_o,phi_o in degrees")
      .required();
  c.option("-o,--output", o->output, "CSV to write");
  add_follow_paths(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
