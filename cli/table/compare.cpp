// gonio compare: how far a model is from a table.
#include "answer/model_argument.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "fitting/judge/assess.h"
#include "fitting/result/document.h"
#include "fitting/solve/problem.h"
#include "table/format/formats.h"
#include "table/sample_mask.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct CompareCall : Common {
  std::string file, model;
  std::vector<std::string> set;
  std::optional<Bins> bins;
  std::optional<std::string> mask;
};

void print(std::size_t values, const FitResiduals& r) {
  say("{:<22}{:>12}{:>16}{:>16}\n", "", "values", "RMS [1/sr]", "log RMS");
  say("{:<22}{:>12}{:>16.6g}{:>16.6g}\n", "all", values, r.rms, r.log_rms);
  for (const auto& b : r.bands)
    if (b.values)
      say("{:<22}{:>12}{:>16.6g}{:>16.6g}\n",
          fmt::format("{} {}° to {}°", b.angle, b.from_deg, b.to_deg), b.values, b.rms, b.log_rms);
}

Exit run(const CompareCall& o) {
  use(o);
  Progress progress(o.quiet);
  progress("reading " + o.file);
  Table t = read_table(o.file, o.bins);
  if (o.mask) leave_out(t, *o.mask);
  const BoundModel m = model_argument(o.model, parse_settings(o.set), t.channels.size()).model;
  check_azimuths(t, m.model);
  progress("comparing");
  const Sampling sampling(t, t.bins(), Metric::l2_cosine, 0, false, false, m.model.anisotropic);
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
  auto [c, o] =
      line.command<CompareCall>("compare", "How far a fitted or given model is from a table",
                                "gonio compare paint.binary paint.json", run);
  c.option("FILE", o->file, "Table").required();
  c.option("MODEL", o->model, spec_or_fit).required();
  add_set(c, o->set);
  add_bins(c, o->bins);
  add_mask(c, o->mask);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
