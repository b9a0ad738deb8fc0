// gonio compare: how far a model is from a table.
#include "reports/own/compare.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "answer/model_argument.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "fitting/judge/assess.h"
#include "fitting/judge/warnings.h"
#include "fitting/result/document.h"
#include "fitting/solve/problem.h"
#include "foreign/function.h"
#include "table/format/formats.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::cli {
namespace {

struct CompareCall : Common {
  std::string file, model;
  std::vector<std::string> set, domain;
  ReadingWords reading;
  std::optional<Bins> bins;
  AsMeasured measured;
};

void print(std::size_t values, const FitResiduals& r) {
  const auto named = [](const ResidualBand& b) {
    return fmt::format("{} {}° to {}°", b.angle, b.from_deg, b.to_deg);
  };
  const ResidualBand* worst = nullptr;
  for (const auto& b : r.bands)
    if (b.values && std::isfinite(b.log_rms) && (!worst || b.log_rms > worst->log_rms)) worst = &b;
  if (worst)
    say("typically off by a factor of {}, most at {}: {}\n", typical_factor(r.log_rms),
        named(*worst), typical_factor(worst->log_rms));
  const auto row = [](const std::string& name, std::size_t n, double rms, double log_rms) {
    say("{:<22}{:>12}{:>16}{:>16.4g}\n", name, n,
        std::isfinite(log_rms) ? typical_factor(log_rms) : "–", rms);
  };
  say("{:<22}{:>12}{:>16}{:>16}\n", "", "values", "typical factor", "RMS [1/sr]");
  row("all", values, r.rms, r.log_rms);
  for (const auto& b : r.bands)
    if (b.values) row(named(b), b.values, b.rms, b.log_rms);
}

Exit run_terms(const CompareCall& o) {
  if (o.bins || o.measured.mask || o.measured.aperture || o.measured.reference ||
      !o.measured.channels.empty() || o.measured.rgb)
    throw wrong_usage(
        "what is said of a table (--bins, --mask …) goes with a table, not with two terms");
  std::vector<std::pair<std::string, Range>> domain;
  for (const auto& s : parse_settings(o.domain)) {
    if (s.values.size() != 2)
      throw wrong_usage(fmt::format("domain {}: expected LOW,HIGH", s.name));
    domain.emplace_back(s.name, Range{s.values[0], s.values[1]});
  }
  for (const auto& s : parse_settings(o.set)) {
    if (s.values.size() != 1)
      throw wrong_usage(fmt::format(
          "--set {}: expected one value, as terms are compared in one channel", s.name));
    domain.emplace_back(s.name, Range{s.values[0], s.values[0]});
  }
  Progress progress(o.quiet);
  progress("comparing");
  const auto with = [&](const std::string& name) {
    return foreign::is_name(name) ? read_as(name, o.reading) : name;
  };
  const auto c = is_term_name(o.model) ? compare_terms(with(o.file), with(o.model), domain)
                                       : compare_with_model(with(o.file), o.model, domain);
  progress.clear();
  fmt::print("{}", o.json ? to_json(c) : text_of(c));
  return Exit::done;
}

/// Keeps those channels of a table that a fit names, where these are some of them.  \return  whether others were left out
bool keep_channels_of(Table& t, const std::string& model) {
  if (file_in(model).empty() || !std::filesystem::exists(model)) return false;
  const auto names = read_fitted_model(model).channels;
  const auto is_there = [&](const std::string& name) {
    return std::ranges::find(t.channels, name) != t.channels.end();
  };
  if (names.empty() || names.size() >= t.channels.size() || !std::ranges::all_of(names, is_there))
    return false;
  pick_channels(t, names);
  return true;
}

Exit run(const CompareCall& o) {
  use(o);
  if (foreign::is_name(o.file) || (is_term_name(o.file) && is_term_name(o.model)))
    return run_terms(o);
  if (!o.domain.empty()) throw wrong_usage("--domain goes with two terms, not with a table");
  Progress progress(o.quiet);
  progress("reading " + o.file);
  Table t = read_table(o.file, o.bins);
  take(t, o.measured);
  const bool in_part = o.measured.channels.empty() && keep_channels_of(t, o.model);
  const auto [m, names, aperture_deg] =
      model_argument(read_as(o.model, o.reading), parse_settings(o.set), t.channels.size());
  const bool as_fitted = !t.aperture && aperture_deg.size() == 2;
  if (as_fitted) {
    t.aperture = {aperture_deg[0] * degree, aperture_deg[1] * degree};
    check_aperture(o.model, t.aperture);
  }
  check_azimuths(t, m.model);
  progress("comparing");
  const Sampling sampling(t, t.bins(), Metric::l2_cosine, 0, false, false, m.model.anisotropic);
  const FreeSlots nothing(std::vector<bool>(m.model.value_count, false));
  const auto [sandwich, r, angles, counts] = assess(sampling, m, nothing, no_huber, false);
  progress.clear();
  if (as_fitted && !o.json)
    say("means over cones of {:.4g}° (light) and {:.4g}° (detector), as in the fit\n",
        aperture_deg[0], aperture_deg[1]);
  if (in_part && !o.json)
    say("channels {}, those of {}\n", fmt::to_string(fmt::join(t.channels, ", ")), o.model);
  if (o.json)
    fmt::print("{}", to_json(Comparison{o.file, {to_text(m.model.spec), named_values(m)}, r}));
  else
    print(counts.used, r);
  return Exit::done;
}

}  // namespace

void add_compare(CommandLine& line) {
  auto [c, o] =
      line.command<CompareCall>("compare", "How far a fitted or given model is from a table",
                                "gonio compare paint.binary paint.json", run);
  c.option("FILE", o->file, "Table; or a term, of the catalogue or FILE:FUNCTION of a shader")
      .required();
  c.option("MODEL", o->model, "Model, or the fit.json of a fit; beside a term another one")
      .required();
  add_set(c, o->set);
  add_reading(c, o->reading);
  c.option("--domain", o->domain, "For two terms: NAME=LOW,HIGH of their parameters").at_most(64);
  add_bins(c, o->bins);
  c.options(o->measured);
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
