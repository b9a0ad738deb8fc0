// gonio synth: a table sampled from a model.
#include "data_synth/synth.h"

#include "answer/model_argument.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : Common {
  std::string spec, layout, output;
  std::vector<std::string> set;
  std::optional<std::string> bins;
  SynthOptions synth;
};

/// "1,458,000"
std::string with_commas(std::size_t n) {
  std::string s = std::to_string(n);
  for (std::size_t k = s.size(); k > 3; k -= 3) s.insert(k - 3, ",");
  return s;
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

void print(const Table& t, const Options& o) {
  std::string how = o.synth.noise > 0 ? "noise " + percent(o.synth.noise) : "no noise";
  if (o.synth.floor > 0) how += fmt::format(", floor {:g} 1/sr", o.synth.floor);
  if (o.synth.outliers > 0) how += ", outliers " + percent(o.synth.outliers);
  if (o.synth.noise > 0 || o.synth.outliers > 0 || o.layout == "random")
    how += fmt::format(", seed {}", o.synth.seed);
  say_below(o.output + ": ",
            fmt::format("{}, {} directions, {} {}, {}", t.format, with_commas(t.size()),
                        t.channels.size() == 1 ? "channel" : "channels",
                        fmt::to_string(fmt::join(t.channels, " ")), how));
}

Exit run(const Options& o) {
  use_jobs(o.jobs);
  check_outputs(file_in(o.spec), {o.output});
  SynthOptions s = o.synth;
  s.layout = value_of<Layout>(o.layout, "layout");
  s.bins = bins_from(o.bins).value_or(Bins::centre);
  const auto model = model_argument(o.spec, parse_settings(o.set)).model;
  Progress progress(o.quiet);
  progress("sampling");
  const Table t = synthesize(model, s);
  progress("writing " + o.output);
  write_table(t, o.output);
  progress.clear();
  if (o.json)
    print_document(
        {{"path", o.output}, {"format", t.format}, {"layout", o.layout}, {"samples", t.size()}});
  else if (!o.quiet)
    print(t, o);
  return Exit::done;
}

}  // namespace

void add_synth(CommandLine& line) {
  auto [c, o] = line.command(
      "synth", "Samples a table from a model, with noise if asked",
      "gonio synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.15 kd=0.2,0.1,0.05 "
      "--layout merl --noise 0.02 -o paint.binary",
      run);
  c.option("MODEL", o->spec, spec_or_fit).required();
  add_set(c, o->set);
  c.option("--layout", o->layout,
           "merl, mbsdf, utia, rgl, in_plane, image_slice, hemisphere or random")
      .one_of(names_of<Layout>)
      .required();
  add_bins(c, o->bins);
  c.option("--samples", o->synth.samples, "Number of samples of the random layout")
      .in(1, 10'000'000)
      .show_default();
  c.option("--noise", o->synth.noise, "Multiplies each value by exp(NOISE · z), z standard normal")
      .in(0.0, 5.0);
  c.option("--floor", o->synth.floor, "Added to every value before the noise [1/sr]").in(0.0, 1e6);
  c.option("--outliers", o->synth.outliers, "Share of samples thrown off by up to 100 times")
      .in(0.0, 1.0);
  add_seed(c, o->synth.seed, "Seed of all that is random (1)");
  c.option("-o,--output", o->output, "File to write").required();
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
