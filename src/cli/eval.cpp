// gonio eval: a model at given directions.
#include "base/file.h"
#include "brdf/model/evaluate.h"
#include "cli/command.h"
#include "table/format/csv.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct Options : Common {
  std::string spec, directions, output;
  std::vector<std::string> set;
};

Exit run(const Options& o) {
  if (o.output.empty() && !o.json) throw wrong_usage("eval needs -o FILE or --json");
  check_outputs({o.directions}, {o.output});
  const auto model = bind_model(o.spec, parse_settings(o.set), 3);
  InputFile in(o.directions);
  Table t = read_directions_csv(in);
  const SampleAngles at(t);
  std::vector<FrameAngles<double>> angles;
  for (std::size_t i = 0; i < t.list()->theta_i_deg.size(); ++i) angles.push_back(at.frame(i));
  t.channels = {"r", "g", "b"};
  for (const auto& f : evaluate(model, angles)) t.values.emplace_back(f.begin(), f.end());
  t.weights.clear();
  if (!o.output.empty()) {
    OutputFile out(o.output);
    write_csv(t, out);
    out.commit();
  }
  if (o.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    const auto& l = *t.list();
    for (std::size_t i = 0; i < t.size(); ++i)
      rows.push_back({{"theta_i", l.theta_i_deg[i]},
                      {"phi_i", l.phi_i_deg[i]},
                      {"theta_o", l.theta_o_deg[i]},
                      {"phi_o", l.phi_o_deg[i]},
                      {"f", {t.values[0][i], t.values[1][i], t.values[2][i]}}});
    fmt::print("{}\n", nlohmann::ordered_json{{"model", model.model.spec}, {"rows", rows}}.dump(2));
  }
  return Exit::done;
}

}  // namespace

void add_eval(CommandLine& line) {
  auto o = std::make_shared<Options>();
  auto c = line.command(
      "eval", "Evaluates a model at the directions of a CSV file: f_r, f_g, f_b in 1/sr, no cosine",
      "gonio eval ggx/smith_ggx.correlated/conductor --set alpha=0.2 metal=Au "
      "--directions in.csv -o out.csv",
      o, run);
  c.option("SPEC", o->spec, "Model").required();
  add_set(c, o->set);
  c.option("--directions", o->directions, "CSV with theta_i,phi_i,theta_o,phi_o in degrees")
      .required();
  c.option("-o,--output", o->output, "CSV to write");
  add_output(c, *o);
}

}  // namespace gonio::cli
