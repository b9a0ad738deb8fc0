// gonio eval: a model at given directions.
#include "base/file.h"
#include "brdf/evaluate.h"
#include "cli/command.h"
#include "table/csv.h"

namespace gonio::cli {
namespace {

struct Options {
  std::string spec, directions, output;
  std::vector<std::string> set;
};

Exit run(const Options& o) {
  const auto model = bind_model(o.spec, parse_settings(o.set), 3);
  InputFile in(o.directions);
  Table t = read_directions_csv(in);
  const SampleAngles at(t);
  std::vector<Angles<double>> angles;
  for (std::size_t i = 0; i < t.list()->theta_i_deg.size(); ++i) angles.push_back(at(i));
  t.channels = {"r", "g", "b"};
  t.values = evaluate(model, angles);
  t.weights.clear();
  OutputFile out(o.output);
  write_csv(t, out);
  out.commit();
  return Exit::done;
}

}  // namespace

void add_eval(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(app, action, "eval",
                        "Evaluates a model at the directions of a CSV file: f_r, f_g, f_b in 1/sr, no cosine",
                        "gonio eval ggx/smith_ggx.correlated/conductor --set alpha=0.2 metal=Au "
                        "--directions in.csv -o out.csv",
                        o, run);
  c->add_option("SPEC", o->spec, "Model")->required();
  add_set(c, o->set);
  c->add_option("--directions", o->directions, "CSV with theta_i,phi_i,theta_o,phi_o in degrees")->required();
  c->add_option("-o,--output", o->output, "CSV to write")->required();
}

}  // namespace gonio::cli
