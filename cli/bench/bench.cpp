// gonio bench: what evaluation costs here, form by form, and beside an earlier time.
#include "cli/bench/bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/process.h"
#include "base/quantile.h"
#include "cli/line/terminal.h"
#include "reports/cost/baseline.h"
#include "reports/measure/load.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct BenchCall : Common {
  std::string what = "kernels";
  bool full = false, plain = true, times = false;
  std::optional<std::string> filter, baseline;
  std::optional<int> repeats, processes;
};

/// Refuses what the other subject is told by.
void check_options(const BenchCall& o) {
  const bool kernels = o.what == "kernels";
  if (!kernels && (o.full || o.filter || o.baseline || o.times || o.processes))
    throw wrong_usage(
        "--full, --filter, --baseline, --times and --processes are for bench kernels");
  if ((kernels || o.what == "parts") && (!o.plain || o.jobs != 0))
    throw wrong_usage("--no-plain and --jobs are for bench fit and bench maps");
}

std::string shown(const CostRow& r) {
  return r.way.empty() ? r.id : fmt::format("{}, {}", r.id, r.way);
}

/// Where times stand in a line.
struct Place {
  std::string isa;
  std::string_view memory;
  bool operator==(const Place&) const = default;
};

/// Prints the rows of one kind in one number: a line for each form, a column for each place.
void print_group(const std::vector<const CostRow*>& rows) {
  std::vector<Place> places;
  std::vector<std::string> names;
  std::size_t width = 0;
  for (const auto* r : rows) {
    const Place p{r->isa, r->memory};
    if (std::ranges::find(places, p) == places.end()) places.push_back(p);
    const auto name = shown(*r);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    width = std::max(width, name.size());
  }
  say("\n{:<{}} {:>4} {:>8}", fmt::format("{}, {} [ns]", rows[0]->kind, rows[0]->number), width,
      "ops", "RMS");
  for (const auto& p : places) say(" {:>9}", p.memory == "cache" ? p.isa : "streaming");
  say("\n");
  for (const auto& name : names) {
    const auto is_here = [&](const CostRow* r) { return shown(*r) == name; };
    const auto& first = **std::ranges::find_if(rows, is_here);
    say("{:<{}} {:>4} {:>8}", name, width,
        first.operations.total() == 0 ? "" : fmt::format("{}", first.operations.total()),
        first.error.truth.empty() ? "" : fmt::format("{:.1e}", first.error.rms));
    for (const auto& p : places) {
      const auto at = std::ranges::find_if(rows, [&](const CostRow* r) {
        return is_here(r) && Place{r->isa, r->memory} == p;
      });
      say(" {:>9}", at == rows.end() ? "" : fmt::format("{:.3f}", (*at)->time.ns));
    }
    say("\n");
  }
}

void print_rows(const std::vector<CostRow>& rows) {
  for (const std::string_view kind :
       {"ndf", "masking", "fresnel", "diffuse", "model", "by_hand", "bound", "arithmetic",
        "arithmetic_in_f", "sampling", "split_sum"})
    for (const std::string_view number : {"float", "double"}) {
      std::vector<const CostRow*> group;
      for (const auto& r : rows)
        if (r.kind == kind && r.number == number) group.push_back(&r);
      if (!group.empty()) print_group(group);
    }
  std::vector<double> spreads;
  for (const auto& r : rows) spreads.push_back(r.time.spread_ns / r.time.ns);
  std::ranges::sort(spreads);
  say("\nspread, half the distance of the quartiles{}: {:.1f} % in the middle, {:.0f} % at most\n",
      rows[0].each.empty() ? "" : " between processes", 100 * spreads[spreads.size() / 2],
      100 * spreads.back());
}

std::string words(const CostName& n) {
  return fmt::format("{}{}{} {} {} {}", n.id, n.way.empty() ? "" : ", ", n.way, n.number, n.isa,
                     n.memory);
}

/// "2 were not timed earlier: a, b"; no line of none.
void print_missing(const std::vector<CostName>& names, const char* what) {
  constexpr std::size_t shown = 5;
  if (names.empty()) return;
  std::string list;
  for (std::size_t k = 0; k < std::min(shown, names.size()); ++k)
    list += fmt::format("{}{}", k ? "; " : "", words(names[k]));
  if (names.size() > shown) list += fmt::format("; and {} more", names.size() - shown);
  say_below(fmt::format("{} {}: ", names.size(), what), list);
}

/// What changed, the largest change first.
void print_changes(const std::vector<CostChange>& all,
                   const EarlierCosts& earlier,
                   const Machine& m) {
  if (earlier.cpu != m.cpu || earlier.compiler != m.compiler || earlier.flags != m.flags)
    say_below("beware  ", fmt::format("the earlier times are of {}, {}, {}", earlier.cpu,
                                      earlier.compiler, earlier.flags));
  std::vector<const CostChange*> differing;
  std::vector<double> ratios;
  std::vector<CostName> new_ones, gone;
  for (const auto& c : all) {
    if (!c.before) {
      new_ones.push_back(c.name);
    } else if (!c.now) {
      gone.push_back(c.name);
    } else {
      ratios.push_back(c.ratio);
      if (c.differs) differing.push_back(&c);
    }
  }
  if (ratios.empty()) {
    say("nothing that was timed now was timed earlier\n");
  } else {
    say("{} of {} times changed by more than three times both spreads; the median of all is {:.3g} "
        "times the earlier\n",
        differing.empty() ? "none" : fmt::to_string(differing.size()), ratios.size(),
        quantile(ratios, 0.5));
  }
  const auto size = [](const CostChange* c) { return std::abs(std::log(c->ratio)); };
  std::ranges::stable_sort(differing, std::greater<>{}, size);
  std::size_t width = 0;
  for (const auto* c : differing) width = std::max(width, words(c->name).size());
  if (!differing.empty())
    say("{:<{}} {:>9}    {:>9}     now over earlier\n", "", width, "earlier", "now [ns]");
  for (const auto* c : differing)
    say("{:<{}} {:>9.3f} -> {:>9.3f}     {:.3f} ± {:.3f}\n", words(c->name), width, c->before->ns,
        c->now->ns, c->ratio, c->spread);
  print_missing(new_ones, "not timed earlier");
  print_missing(gone, "not timed now");
}

Exit bench_kernels(const BenchCall& o) {
  std::optional<EarlierCosts> earlier;  // nobody waits to learn that it cannot be read
  if (o.baseline) earlier = read_costs(*o.baseline);
  auto options = cost_options(o.full);
  options.program = this_program();
  options.processes = o.processes.value_or(o.full ? options.processes : 5);
  options.errors = !o.times;
  if (o.repeats) options.timing.repetitions = *o.repeats;
  if (o.filter) options.filter = *o.filter;
  Progress progress(o.quiet);
  const Stopwatch begin;
  const auto measured = measure_costs(options, [&](std::string_view what, double part) {
    constexpr std::size_t all = 1000;
    const auto done = static_cast<std::size_t>(part * all);
    progress(fmt::format("{}, {} %{}", what, done / 10, time_left(begin, done, all)));
  });
  progress.clear();
  const auto& rows = measured.rows;
  if (rows.empty()) throw wrong_usage(fmt::format("no form's id holds '{}'", options.filter));
  const auto machine = this_machine();
  std::vector<CostChange> found;
  if (earlier) found = changes(*earlier, rows, options.filter);
  if (o.json) {
    fmt::print("{}\n", costs_json(machine, options, measured, found));
    return Exit::done;
  }
  say("{}, {} threads; {}; median over {} [ns a sample]\n", machine.cpu, machine.threads,
      machine.compiler,
      measured.processes > 1 ? fmt::format("{} processes", measured.processes)
                             : fmt::format("{} repetitions", options.timing.repetitions));
  if (const auto text = load_text(measured.others, machine.threads); !text.empty())
    say("{}\n", text);
  if (earlier)
    print_changes(found, *earlier, machine);
  else
    print_rows(rows);
  return Exit::done;
}

Exit run(const BenchCall& o) {
  check_options(o);
  if (o.what == "fit") return bench_fit({o.plain, o.repeats.value_or(11)}, o);
  if (o.what == "maps") return bench_maps({o.plain, o.repeats.value_or(5)}, o);
  if (o.what == "parts") return bench_parts({false, o.repeats.value_or(5)}, o);
  return bench_kernels(o);
}

}  // namespace

void add_bench(CommandLine& line) {
  auto [c, o] = line.command<BenchCall>(
      "bench",
      "Times every form of the catalogue and whole models on this machine, or the fit of "
      "a MERL table, of texels or of many tables in parts",
      "gonio bench --json > before.json; gonio bench --baseline before.json", run);
  c.option("WHAT", o->what,
           "kernels: every form, in each number and instruction set; fit: the fit of a MERL table "
           "beside the plain way of doing it; maps: texels, beside a Ceres problem for each; "
           "parts: parts of many tables, beside one process for all")
      .one_of({"kernels", "fit", "maps", "parts"})
      .show_default();
  c.flag("--full", o->full, "Streaming in every instruction set, and more repetitions: minutes");
  c.option("--filter", o->filter, "Only forms whose id holds this: smith, fresnel., model.gltf");
  c.option(
      "--baseline", o->baseline,
      "An earlier document of bench --json or report cost: what changed since is printed, in place "
      "of all times");
  c.option("--repeats", o->repeats,
           "Repetitions in each process (default: 3, 11 of fit, 5 of maps and parts)")
      .in(1, 1000);
  c.option("--processes", o->processes,
           "Processes that measure everything in turn; 1: this one (default: 5, 15 with --full)")
      .in(1, 100);
  c.flag("--times", o->times, "Only times, without the errors, which take seconds");
  c.flag("!--no-plain", o->plain, "fit, maps: without the plain way, which takes seconds and 1 GB");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
