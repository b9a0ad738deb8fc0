// gonio bench: what the program costs, beside the plain way of doing the same, in one run.
#include <algorithm>
#include <chrono>

#include "cli/command.h"
#include "cli/terminal.h"
#include "data_synth/synth.h"
#include "fitting/fit.h"
#include "fitting/plain.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <tbb/task_arena.h>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : Common {
  bool plain = true;
  int repeats = 7;
};

/// Median with the smallest and largest of a few repeats.
struct Spread {
  double median, least, most;
  explicit Spread(std::vector<double> x) {
    std::ranges::sort(x);
    median = x[x.size() / 2];
    least = x.front();
    most = x.back();
  }
};
Json to_json(const Spread& s) {
  return {{"median_ms", s.median}, {"least_ms", s.least}, {"most_ms", s.most}};
}

double peak_megabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

double since(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - t).count();
}

Exit run(const Options& o) {
  use_jobs(o.jobs);
  Progress progress(o.quiet);
  const int threads = tbb::this_task_arena::max_concurrency();
  progress("synthesizing a MERL table");
  FitOptions options;
  options.bin_sensitivity = false;
  const auto truth =
      bind_model(options.model,
                 parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  SynthOptions synth;
  synth.noise = 0.02;
  const Table t = synthesize(truth, synth);

  std::vector<double> times;
  std::size_t values = 0;
  FitResult last;
  for (int i = 0; i < o.repeats; ++i) {
    progress(fmt::format("fit {} of {}", i + 1, o.repeats));
    const auto begin = std::chrono::steady_clock::now();
    last = fit(t, options);
    times.push_back(since(begin));
    values = last.document.values_used;
  }
  const Spread ours(times);
  const double megabytes = peak_megabytes();
  Json result{{"values", values},
              {"threads", threads},
              {"instruction_set", last.document.solver.instruction_set},
              {"fit", to_json(ours)},
              {"peak_megabytes", megabytes}};
  if (o.plain) {
    progress("the plain way: one Ceres block per bin");
    const auto begin = std::chrono::steady_clock::now();
    const auto plain = fit_plainly(t, {0.5, 0.5, 0.5, 0.5, 0.1, 0.1, 0.1}, threads);
    const double ms = since(begin);
    result["plain"] = {{"total_ms", ms},
                       {"build_ms", plain.build_ms},
                       {"solve_ms", plain.solve_ms},
                       {"iterations", plain.iterations},
                       {"peak_megabytes", peak_megabytes()}};
    result["ratio"] = {
        {"median", ms / ours.median}, {"least", ms / ours.most}, {"most", ms / ours.least}};
    result["largest_difference_of_values"] = [&] {
      double worst = 0;
      for (std::size_t i = 0; i < plain.values.size(); ++i) {
        // plain: alpha, f0, kd;  the model: kd, alpha, f0
        const std::size_t at = i == 0 ? 3 : i < 4 ? i + 3 : i - 4;
        worst = std::max(worst, std::abs(plain.values[i] / last.model.values[at] - 1));
      }
      return worst;
    }();
  }
  progress.clear();
  if (o.json) {
    fmt::print("{}\n", result.dump(2));
    return Exit::done;
  }
  fmt::print("fit of {} values ({} on {} threads): {:.1f} ms [{:.1f}, {:.1f}], {:.0f} MB\n", values,
             last.document.solver.instruction_set, threads, ours.median, ours.least, ours.most,
             megabytes);
  for (const auto& [phase, ms] : last.document.solver.phase_ms)
    fmt::print("  {:<14}{:.1f}\n", phase, ms);
  if (o.plain)
    fmt::print(
        "one Ceres block per bin: {:.0f} ms, {:.0f} MB; ratio {:.0f} [{:.0f}, {:.0f}], "
        "largest relative difference of the parameters {:.1e}\n",
        result["plain"]["total_ms"].get<double>(), result["plain"]["peak_megabytes"].get<double>(),
        result["ratio"]["median"].get<double>(), result["ratio"]["least"].get<double>(),
        result["ratio"]["most"].get<double>(),
        result["largest_difference_of_values"].get<double>());
  return Exit::done;
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(app, action, "bench",
                        "Times the fit of a MERL table beside the plain way of doing it",
                        "gonio bench --json", o, run);
  c->add_option("--repeats", o->repeats, "Fits to time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  c->add_flag("!--no-plain", o->plain, "Without the plain way, which takes seconds and 1 GB");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
