// gonio compare: how far a model is from a table.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/command.h"
#include "cli/terminal.h"
#include "fitting/judge/assess.h"
#include "fitting/result/document.h"
#include "table/format/formats.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct Options : Common {
  std::string file, model;
  std::vector<std::string> set;
  std::optional<std::string> bins;
};

/// A spec with its --set, or a fit.json: what the user named is a file if there is one.
BoundModel model_of(const Options& o, std::size_t channels) {
  if (!std::filesystem::exists(o.model)) {
    if (o.model.ends_with(".json"))
      throw bad_input(o.model, "opening", "no such file", "the fit.json of a fit, or a model");
    return bind_model(o.model, parse_settings(o.set), channels);
  }
  if (!o.set.empty()) throw wrong_usage("--set goes with a model, not with a fit.json");
  const auto fitted = read_fitted_model(o.model);
  std::vector<Setting> settings;
  for (const auto& [name, values] : fitted.parameters) {
    if (name.starts_with("roughness")) continue;  // alpha says the same
    for (const double v : values)
      if (std::isnan(v))
        throw bad_input(o.model, "parameters." + name, "null (not identifiable)",
                        "a value; fit again with --fix " + name + "=…");
    settings.push_back({name, values});
  }
  try {
    BoundModel b = bind_model(fitted.model, settings, channels);
    for (const auto& p : b.model.parameters)
      if (std::ranges::find(b.given, p.name) == b.given.end())
        throw wrong_usage("nothing for '" + p.name + "'");
    return b;
  } catch (const Error& e) {  // the words are the file's, not the user's
    throw bad_input(o.model, "model and parameters", e.what(),
                    "a model for the " + std::to_string(channels) + " channels of " + o.file);
  }
}

void print(std::size_t values, const FitResiduals& r) {
  say("{:<22}{:>12}{:>16}{:>16}\n", "", "values", "RMS [1/sr]", "log RMS");
  say("{:<22}{:>12}{:>16.6g}{:>16.6g}\n", "all", values, r.rms, r.log_rms);
  for (const auto& b : r.bands)
    if (b.values)
      say("{:<22}{:>12}{:>16.6g}{:>16.6g}\n",
          fmt::format("{} {}° to {}°", b.angle, b.from_deg, b.to_deg), b.values, b.rms, b.log_rms);
}

Exit run(const Options& o) {
  use_jobs(o.jobs);
  Progress progress(o.quiet);
  progress("reading " + o.file);
  const Table t = read_table(o.file, bins_from(o.bins));
  const BoundModel m = model_of(o, t.channels.size());
  progress("comparing");
  const Sampling sampling(t, t.bins(), Metric::l2_cosine, 0, false);
  const FreeSlots nothing(std::vector<bool>(m.model.value_count, false));
  const auto [sandwich, r, angles, counts] = assess(sampling, m, nothing, no_huber, false);
  progress.clear();
  if (o.json)
    fmt::print("{}", to_json(Comparison{o.file, {m.model.spec, named_values(m)}, r}));
  else
    print(counts.used, r);
  return Exit::done;
}

}  // namespace

void add_compare(CommandLine& line) {
  auto o = std::make_shared<Options>();
  auto c = line.command("compare", "How far a fitted or given model is from a table",
                        "gonio compare paint.binary paint.json", o, run);
  c.option("FILE", o->file, "Table").required();
  c.option("MODEL", o->model, "The fit.json of a fit, or a model").required();
  add_set(c, o->set);
  add_bins(c, o->bins);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
