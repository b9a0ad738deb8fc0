// gonio fit: a table in, parameters and a page out.
#include "fitting/fit.h"

#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "cli/fit/batch_words.h"
#include "cli/fit/fit_options.h"
#include "cli/line/command.h"
#include "cli/line/output_files.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "fitting/batch/batch.h"
#include "fitting/batch/fit_file.h"
#include "fitting/choice/document.h"
#include "reports/pages/batch_page.h"
#include "reports/pages/fit_page.h"
#include "reports/pages/models_page.h"
#include "table/format/as_one.h"
#include "table/format/formats.h"
#include "table/health/health.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct FitCall : Common {
  std::vector<std::string> files, models;
  ReadingWords reading;
  HowFitted how;
  std::string output, html;
  std::optional<std::string> part;
  bool pages = false, as_one = false;
};

/// Name of a reason or an end as people write it.
std::string words(std::string_view name) {
  std::string s(name);
  std::ranges::replace(s, '_', ' ');
  return s;
}

/// Value of a parameter as far as it is known.
std::string value_in_words(const FittedParameter& p, std::size_t c) {
  using enum ParameterStatus;
  if (p.status[c] == upper_limit) return fmt::format("≤ {:.3g}", p.limit[c]);
  if (p.status[c] == lower_limit) return fmt::format("≥ {:.3g}", p.limit[c]);
  return with_error(p.value[c], p.std_error[c], p.ci95_low[c], p.ci95_high[c]);
}
/// Why no more is known of it.
std::string status_in_words(const FittedParameter& p, std::size_t c) {
  const std::string reason = p.reason[c].empty() ? "" : "; " + p.reason[c];
  const std::string best =
      std::isnan(p.value[c]) ? "" : fmt::format("; best value {:.3g}", p.value[c]);
  switch (p.status[c]) {
    case ParameterStatus::free:
    case ParameterStatus::unbounded:
      return p.reason[c];
    case ParameterStatus::fixed:
      return "held";
    case ParameterStatus::at_bound:
      return "at the end of its range; the data push beyond it" + reason;
    case ParameterStatus::not_identifiable:
      return "not known" + reason;
    case ParameterStatus::upper_limit:
      return "at most, at 95 %" + best + reason;
    case ParameterStatus::lower_limit:
      return "at least, at 95 %" + best + reason;
  }
  return "";
}

void print(const FitDocument& d) {
  say("model   {}\n", d.model);
  std::string values = fmt::format("{} used", d.values_used);
  for (const auto& [reason, count] : d.masked)
    if (count) values += fmt::format(", {} {}", count, words(reason));
  say_below("values  ", values);
  for (const auto& p : d.parameters)
    for (std::size_t c = 0; c < p.value.size(); ++c) {
      const std::string name =
          p.value.size() == 1 ? p.name : fmt::format("{}.{}", p.name, d.channels[c]);
      const std::string value = value_in_words(p, c), status = status_in_words(p, c);
      if (status.empty())
        say("{:<13} {}\n", name, value);
      else
        say_below(fmt::format("{:<13} {:<27} ", name, value), status);
    }
  for (const auto& r : d.ratios.value_or(std::vector<Ratio>()))
    say("{:<13} {}\n", r.of + "/" + r.to,
        with_error(r.value, (r.ci95_high - r.ci95_low) / (2 * 1.96), r.ci95_low, r.ci95_high));
  const auto& chi2 = d.residuals.chi2_per_freedom;
  say_below("",
            fmt::format(
                "typical factor ×/÷ {:.3g}; log RMS {:.4g}, RMS {:.4g} 1/sr{}; standard errors: {}",
                std::exp(d.residuals.log_rms), d.residuals.log_rms, d.residuals.rms,
                chi2 ? fmt::format(", χ² per degree of freedom {:.3g}", *chi2) : "", d.intervals));
  for (const auto& s : d.sensitivity) {
    std::string changes;
    for (const auto& [name, change] : s.relative_change) {
      std::vector<std::string> known;
      for (const double x : change)
        if (!std::isnan(x)) known.push_back(fmt::format("{:+.2f}", 100 * x));
      if (!known.empty())
        changes += fmt::format("{}{} {} %", changes.empty() ? "" : "; ", name,
                               fmt::to_string(fmt::join(known, ", ")));
    }
    if (!changes.empty())
      say_below("bins    ",
                fmt::format("samples taken to sit at the {} of their bins; at the {} {}", d.bins,
                            s.other, changes));
  }
  if (const auto& c = d.certificate; c && !c->cells.empty())
    say_below("search  ", fmt::format("{} over {} tried, {} fits better (not a proof)",
                                      counted(c->cells.size(), "place"),
                                      fmt::to_string(fmt::join(c->parameters, ", ")),
                                      c->lowest >= d.cost * (1 - 1e-6) ? "none" : "one"));
  for (const auto& w : d.warnings) say_below("beware  ", w);
  constexpr std::size_t most = 2;
  for (std::size_t k = 0; k < std::min(most, d.next.size()); ++k) say_below("try     ", d.next[k]);
  const bool converged = d.solver.termination == "converged";
  say_below("", converged ? "converged"
                          : fmt::format("did not converge within {}",
                                        counted(static_cast<std::size_t>(d.solver.iterations),
                                                "iteration")));
}

/// Line of how far a batch is, and how long still.
std::string line_of(const BatchCount& n, const Stopwatch& begin) {
  std::string line = fmt::format("{} of {} tables", n.done, n.all);
  if (n.failed) line += fmt::format(", {} failed", n.failed);
  return line + time_left(begin, n.done - n.kept, n.all - n.kept);
}

void print(const std::string& folder, const BatchResult& r) {
  print_rows(r, r.count.kept);
  if (!r.part.empty())
    return say("results  {}; when all parts have ended, gonio gather makes the summary\n", folder);
  print_left_out(r);
  print_summary_place(folder);
  if (r.others) say("         with {} that lay there before\n", counted(r.others, "table"));
}

std::optional<std::string> variable_of_environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

Exit run_batch(const FitCall& o) {
  if (!o.html.empty())
    throw wrong_usage(
        "--html is of one table; the page of many is summary.html in their folder, and --pages "
        "makes "
        "one of each beside it");
  check_outputs({}, {o.output});
  Progress progress(o.quiet);
  progress("looking for tables");
  const Stopwatch begin;
  BatchHooks hooks{[&](const BatchCount& n) { progress(line_of(n, begin)); }, batch_page_html, {}};
  if (o.pages)
    hooks.table_page = [](const FittedFile& f) {
      return fit_page_html(f.result.document, f.table, inspect(f.table),
                           make_fit_page(f.table, f.result.drawn()));
    };
  std::optional<Part> part;
  if (o.part) part = part_from(*o.part, variable_of_environment);
  const BatchResult result = fit_batch({o.files, o.output, o.how, part}, hooks);
  progress.clear();
  if (o.json)
    fmt::print("{}", batch_json(result, false));
  else
    print(o.output, result);
  return result.outcome();
}

/// A sentence that begins with a plain word, as the rest of another.
std::string within_sentence(std::string text) {
  for (const char* word : {"Every ", "Models ", "On ", "The "})
    if (text.starts_with(word)) text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

void print(const ModelChoice& choice, const Advice& advice) {
  for (const auto& w : choice.warnings) say_below("beware  ", w);
  if (!advice.recommended.empty()) {
    if (advice.none_fits) say("no model fits\n");
    say_below(advice.none_fits ? "nearest " : "take    ", advice.recommended);
    if (advice.none_fits)
      say_below("", advice.reason);
    else
      say_below("because ", within_sentence(advice.reason));
    for (const auto& b : advice.beware) say_below("beware  ", b);
    for (const auto& m : advice.as_good) say_below("as good ", m);
    for (const auto& d : advice.disagreement) say_below("but     ", d);
  }
  const auto number = [](double x, const char* form) {
    return std::isnan(x) ? std::string("–") : fmt::format(fmt::runtime(form), x);
  };
  const auto difference = [&](double x) {
    return x < 0.005 ? std::string("0") : number(x, x < 10 ? "{:.2g}" : "{:.0f}");
  };
  say("\n{:>9} {:>9} {:>8} {:>6} {:>6} {:>6}  {}\n", "unseen", "log RMS", "BIC", "ΔE2000", "ns",
      "free", "model");
  for (const auto& r : choice.rows) {
    say("{:>9} {:>9} {:>8} {:>6} {:>6} {:>6}  {}{}\n", number(r.cv_log_rms, "{:.4g}"),
        number(r.log_rms, "{:.4g}"), number(r.bic, "{:.0f}"), difference(r.delta_e_2000),
        number(r.ns, r.ns < 10 ? "{:.2g}" : "{:.0f}"),
        r.compared ? fmt::to_string(r.parameters) : "–", r.model,
        r.parameters_at_bound.empty()
            ? ""
            : fmt::format(", {} at a bound", fmt::join(r.parameters_at_bound, ", ")));
    if (!r.note.empty()) say_below("          ", r.note);
  }
  if (const auto words = floor_in_words(choice); !words.empty()) say_below("", words);
}

/// Models compared on one table.
Exit run_models(const FitCall& o) {
  if (is_batch(o.files) && !o.as_one)
    throw wrong_usage(
        "--models compares on one table: run it for each, with -o and --html of its own");
  if (o.pages)
    throw wrong_usage("--pages is of many tables; the page of --models is --html PAGE.html");
  if (o.part) throw wrong_usage("--part is of the fits of many tables, not of --models");
  const auto models = models_asked(o.models);
  const auto files = o.as_one ? tables_of(o.files) : o.files;
  OutputFiles out(files, o.output, o.html);
  Progress progress(o.quiet);
  progress("reading " + o.files[0]);
  TableAndDigest in = read_files(files, o.how.bins);
  Table& table = in.table;
  take(table, o.how.measured);
  ModelChoice choice =
      compare_on_scale(table, o.how.options, models, [&](const std::string& what, double part) {
        progress(fmt::format("{} ({:.0f} %)", what, 100 * part));
      });
  Spheres spheres = add_spheres(table, choice);
  in.finish();
  const Advice advice = advise(choice);
  const ComparedTable compared = compared_table(table, o.how.options);
  const std::string json = to_json(choice, advice, compared);
  out.write_document(json);
  if (out.has_page()) {
    progress("making the page");
    const auto page = make_models_page(table, choice, advice, std::move(spheres));
    out.write_page(models_page_html(choice, advice, compared, page), to_json(page, json));
  }
  out.commit();
  progress.clear();
  if (o.json)
    fmt::print("{}", json);
  else
    print(choice, advice);
  return std::ranges::any_of(choice.rows, &ModelRow::converged) ? Exit::done : Exit::not_converged;
}

Exit run(const FitCall& call) {
  FitCall o = call;
  use(o);
  if (o.models.empty())
    o.how.options.model = read_as(o.how.options.model, o.reading);
  else
    for (auto& m : o.models) m = m == "all" ? m : read_as(m, o.reading);
  if (!o.models.empty()) return run_models(o);
  if (is_batch(o.files) && !o.as_one) return run_batch(o);
  if (o.pages) throw wrong_usage("--pages is of many tables; the page of one is --html PAGE.html");
  if (o.part) throw wrong_usage("--part is of many tables: a folder, several files, or @LIST");
  const auto files = o.as_one ? tables_of(o.files) : o.files;
  OutputFiles out(files, o.output, o.html);
  Progress progress(o.quiet);
  const auto [t, result] = fit_files(files, o.how, std::ref(progress));
  const FitDocument& d = result.document;

  const std::string json = to_json(d);
  out.write_document(json);
  if (out.has_page()) {
    progress("making the page");
    const Health health = inspect(t);
    const FitPage page = make_fit_page(t, result.drawn());
    out.write_page(fit_page_html(d, t, health, page, o.output),
                   to_json(page, json, to_json(t, health)));
  }
  out.commit();
  progress.clear();
  if (o.json)
    fmt::print("{}", json);
  else
    print(d);
  return d.solver.termination == "converged" ? Exit::done : Exit::not_converged;
}

}  // namespace

void add_fit(CommandLine& line) {
  auto [c, o] = line.command<FitCall>(
      "fit", "Fits a model to a table, or to each of many",
      "gonio fit paint.binary --model lambert+ggx/smith_ggx.correlated/schlick "
      "-o paint.json --html paint.html\n  gonio fit tables/ --jobs 2 -o results/",
      run);
  add_tables(c, o->files);
  c.flag("--as-one", o->as_one, "Several files are one sample's table: one fit of all");
  c.options(o->how);
  c.option("--models", o->models,
           "Models to compare in place of one fit: A,B,C, or all for the usual ones, or all,A for "
           "these and A. Says which to take, by the incident angles held out of each fit")
      .delimiter(',');
  c.option("-o,--output", o->output,
           "The result as JSON; of many, the folder for theirs and for summary.csv and .html. "
           "Results there that were made from the same file with the same options are reused");
  c.option("--html", o->html,
           "A page of the result, NAME.html, and its data beside it, NAME.page.json");
  add_reading(c, o->reading, false);
  add_pages(c, o->pages);
  c.option(
      "--part", o->part,
      "One part of many tables, K/N, as 2/4: any number of them may share the folder, and gonio "
      "gather makes the summary; slurm: that of the task of an array, sbatch --array=1-N");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
