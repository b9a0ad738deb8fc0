// gonio albedo: how much of the light that comes in a model gives back.
#include "answer/albedo.h"

#include <memory>

#include "answer/model_argument.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct AlbedoCall : Common {
  ReadingWords reading;
  std::string spec;
  std::vector<std::string> set;
  AlbedoQuestion question;
};

/// What is being done on the terminal; of several walks how many are left.
class Step {
 public:
  explicit Step(bool quiet) : quiet_(quiet), line_(quiet) {}
  void operator()(const std::string& what, std::size_t done, std::size_t all) {
    if (all == 0) return line_(what);
    if (!walks_) walks_ = std::make_unique<TimedProgress>(quiet_, what, all);
    (*walks_)(done);
  }

 private:
  bool quiet_;
  Progress line_;
  std::unique_ptr<TimedProgress> walks_;
};

void print(const AlbedoAnswer& r, const AlbedoQuestion& q) {
  const auto line = [&](const std::string& name, const Albedo& a) {
    fmt::print("{:>10}", name);
    for (std::size_t c = 0; c < (r.grey ? 1 : a.value.size()); ++c)
      fmt::print("  {:.10f}", a.value[c]);
    fmt::print("  ± {:.1e}\n", a.error);
  };
  fmt::print("{:>10}  albedo{}\n", "mu",
             q.scattering == Scattering::walk ? " ± standard error" : "");
  for (std::size_t i = 0; i < r.at.size(); ++i) line(fmt::format("{}", q.mu[i]), r.at[i]);
  if (r.average) line("average", *r.average);
}

AlbedoAnswer answer(const AlbedoCall& o) {
  const auto model = model_argument(read_as(o.spec, o.reading), parse_settings(o.set)).model;
  Step step(o.quiet);
  return albedo_of(model, o.spec, o.question, std::ref(step));
}

Exit run(const AlbedoCall& o) {
  use(o);
  const AlbedoAnswer r = answer(o);
  if (o.json)
    fmt::print("{}", to_json(r, o.question));
  else
    print(r, o.question);
  return Exit::done;
}

}  // namespace

void add_albedo(CommandLine& line) {
  auto [c, o] = line.command<AlbedoCall>(
      "albedo",
      "Integrates how much of the light that comes in a model gives back, with a bound of the "
      "error",
      "gonio albedo ggx/smith_ggx.correlated/schlick --set alpha=1 f0=1 --mu 0.01,0.5,1 --average "
      "--scattering deterministic --json",
      run);
  c.option("MODEL", o->spec, spec_or_fit).required();
  add_set(c, o->set);
  add_reading(c, o->reading);
  c.options(o->question);
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
