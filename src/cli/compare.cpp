// gonio compare: how far a model is from a table.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/terminal.h"
#include "fitting/data.h"
#include "fitting/residuals.h"
#include "table/fit_document.h"
#include "table/formats.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file, model;
  std::vector<std::string> set;
  std::optional<std::string> bins;
  bool json = false, quiet = false;
  int jobs = 0;
};

/// A spec with its --set, or a fit.json: what the user named is a file if there is one.
BoundModel model_of(const Options& o, std::size_t channels) {
  if (!std::ifstream(o.model).good()) {
    if (o.model.ends_with(".json"))
      throw bad_input(o.model, "opening", "no such file", "the fit.json of a fit, or a model");
    return bind_model(o.model, parse_settings(o.set), channels);
  }
  if (!o.set.empty()) throw wrong_usage("--set goes with a model, not with a fit.json");
  const auto fitted = read_fitted_model(o.model);
  std::vector<Setting> settings;
  for (const auto& [name, values] : fitted.parameters) {
    if (name.starts_with("roughness")) continue;  // alpha says the same
    Setting s{name, {}};
    for (const double v : values) {
      if (std::isnan(v))
        throw bad_input(o.model, "parameters." + name, "null (not identifiable)",
                        "a value; fit again with --fix " + name + "=…");
      s.values.push_back(v);
    }
    settings.push_back(std::move(s));
  }
  return bind_model(fitted.model, settings, channels);
}

void print(const FitResiduals& r) {
  fmt::print("{:<22}{:>12}{:>16}{:>16}\n", "", "values", "RMS [1/sr]", "log RMS");
  fmt::print("{:<22}{:>12}{:>16.6g}{:>16.6g}\n", "all", "", r.rms, r.log_rms);
  for (const auto& b : r.bands)
    if (b.values)
      fmt::print("{:<22}{:>12}{:>16.6g}{:>16.6g}\n",
                 fmt::format("{} {}° to {}°", b.angle, b.from_deg, b.to_deg), b.values, b.rms, b.log_rms);
}

Json to_json(const Options& o, const BoundModel& m, const FitResiduals& r) {
  Json bands = Json::array(), parameters = Json::object();
  for (const auto& b : r.bands)
    bands.push_back({{"angle", b.angle},
                     {"from_deg", b.from_deg},
                     {"to_deg", b.to_deg},
                     {"values", b.values},
                     {"rms", b.rms},
                     {"log_rms", b.log_rms}});
  for (const auto& p : m.model.parameters) {
    if (p.count == 1)
      parameters[p.name] = m.values[p.first];
    else
      parameters[p.name] = std::vector<double>(m.values.begin() + static_cast<std::ptrdiff_t>(p.first),
                                               m.values.begin() + static_cast<std::ptrdiff_t>(p.first + p.count));
  }
  return {{"path", o.file},
          {"model", m.model.spec},
          {"parameters", parameters},
          {"residuals", {{"rms", r.rms}, {"log_rms", r.log_rms}, {"bands", bands}}}};
}

Exit run(const Options& o) {
  use_jobs(o.jobs);
  Progress progress(o.quiet);
  progress("reading " + o.file);
  const Table t = read_table(o.file, bins_from(o.bins));
  const BoundModel m = model_of(o, t.channels.size());
  progress("comparing");
  const auto data = fit_data(t, t.grid() ? t.grid()->bins : Bins::centre, Metric::l2_cosine, 0);
  const auto r = residual_statistics(m, data);
  progress.clear();
  if (o.json)
    fmt::print("{}\n", to_json(o, m, r).dump(2));
  else
    print(r);
  return Exit::done;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(app, action, "compare", "How far a fitted or given model is from a table",
                        "gonio compare paint.binary paint.json", o, run);
  c->add_option("FILE", o->file, "Table")->required();
  c->add_option("MODEL", o->model, "The fit.json of a fit, or a model")->required();
  add_set(c, o->set);
  add_bins(c, o->bins);
  c->add_flag("--json", o->json, "JSON on standard output");
  c->add_flag("--quiet", o->quiet, "No progress");
  add_jobs(c, o->jobs);
}

}  // namespace gonio::cli
