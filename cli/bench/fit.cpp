// gonio bench fit: what a fit costs, beside the plain way of doing the same, in one run.
#include "fitting/fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/file.h"
#include "cli/bench/bench.h"
#include "cli/bench/place.h"
#include "cli/line/terminal.h"
#include "data_synth/synth.h"
#include "fitting/solve/accumulate.h"
#include "reports/yardstick/plain_fit.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Times by name, in the order in which the names come.
class Times {
 public:
  void add(const std::string& name, double ms) {
    auto at = std::ranges::find(rows_, name, &Row::first);
    if (at == rows_.end()) at = rows_.insert(at, {name, {}});
    at->second.push_back(ms);
  }
  /// Repeat by repeat.
  const std::vector<double>& of(const std::string& name) const {
    return std::ranges::find(rows_, name, &Row::first)->second;
  }
  struct Spread {
    std::string name;
    double median, least, most;
  };
  std::vector<Spread> spreads() const {
    std::vector<Spread> all;
    for (auto [name, ms] : rows_) {
      std::ranges::sort(ms);
      all.push_back({name, ms[ms.size() / 2], ms.front(), ms.back()});
    }
    return all;
  }

 private:
  using Row = std::pair<std::string, std::vector<double>>;
  std::vector<Row> rows_;
};

double peak_megabytes(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// The columns of a pass read once and nothing done with them: what memory allows.
std::uint64_t read_only(const FitData<float>& d) {
  std::vector<std::uint64_t> parts(d.tasks.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    for (const auto& b : d.tasks[k]) {
      const auto* x = reinterpret_cast<const std::uint32_t*>(b.columns);
      parts[k] += std::accumulate(x, x + b.n * b.columns_count, std::uint32_t{0});
    }
  });
  return std::accumulate(parts.begin(), parts.end(), std::uint64_t{0});
}

std::vector<double> divided(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratio;
  for (std::size_t i = 0; i < a.size(); ++i) ratio.push_back(a[i] / b[i]);
  return ratio;
}

/// Spectrum of a paint: one value a channel for kd and f0.
Table spectral_table(const std::string& model, std::size_t channels) {
  Setting kd{"kd", {}}, f0{"f0", {}};
  for (std::size_t c = 0; c < channels; ++c) {
    const double at = static_cast<double>(c) / static_cast<double>(channels);
    kd.values.push_back(0.25 + 0.2 * std::sin(9 * at));
    f0.values.push_back(0.06 + 0.02 * std::cos(6 * at));
  }
  return synthesize(bind_model(model, {{"alpha", {0.2}}, kd, f0}, channels),
                    {.layout = Layout::random, .samples = 400, .noise = 0.02});
}

}  // namespace

Exit bench_fit(const FitBench& o, const Common& common) {
  use(common);
  Progress progress(common.quiet);
  const int threads = tbb::this_task_arena::max_concurrency();
  progress("synthesizing a MERL table");
  FitOptions options, gtr;
  gtr.model = "lambert+gtr/smith_ggx.correlated/schlick";
  const auto truth =
      bind_model(options.model,
                 parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  SynthOptions synth;
  synth.noise = 0.02;
  const BenchFolder place;
  const std::string file = place / "table.binary", result = place / "fit.json";
  write_table(synthesize(truth, synth), file);

  // As many channels as a spectral goniometer has, and twice that: the time of a fit is linear in
  // them.
  constexpr std::size_t channels = 195;
  const Table spectrum = spectral_table(options.model, channels),
              twice = spectral_table(options.model, 2 * channels);

  Times times;
  FitResult last;
  std::vector<double> solving, to_parameters, memory_bound;
  for (int i = 0; i < o.repeats; ++i) {
    progress(fmt::format("round {} of {}", i + 1, o.repeats));
    Stopwatch begin;
    TableAndDigest in(file);
    in.finish();
    const Table& t = in.table;
    times.add("read and SHA-256", begin.ms());
    begin = {};
    last = fit(t, options);
    times.add("fit with errors", begin.ms());
    double columns = 0, solve = 0;
    for (const auto& [phase, ms] : last.document.solver.phase_ms) {
      times.add("  " + phase, ms);
      if (phase.starts_with("columns")) columns += ms;
      if (phase.starts_with("start") || phase.starts_with("solve")) solve += ms;
    }
    solving.push_back(solve);
    to_parameters.push_back(columns + solve);
    const auto free_gamma = fit(t, gtr);
    double gtr_solve = 0;
    for (const auto& [phase, ms] : free_gamma.document.solver.phase_ms)
      if (phase.starts_with("start") || phase.starts_with("solve")) gtr_solve += ms;
    times.add("start and solve", solve);
    times.add("start and solve, GTR", gtr_solve);
    {
      const Sampling sampling(t, t.bins(), Metric::log, 0, true);
      const auto data = fit_data<float>(sampling);
      const FreeSlots free(std::vector<bool>(last.model.model.value_count, true));
      const Accumulator<float> accumulate(last.model.model, data, free);
      accumulate.normal_equations(last.model.values);
      begin = {};
      accumulate.normal_equations(last.model.values);
      times.add("one pass", begin.ms());
      begin = {};
      if (read_only(data) == 0) progress("all columns are zero");  // the sum must be made
      times.add("its columns read", begin.ms());
    }
    for (const Table* spectral : {&spectrum, &twice}) {
      begin = {};
      fit(*spectral, options);
      times.add(fmt::format("fit of {} channels", spectral->channels.size()), begin.ms());
    }
    begin = {};
    std::vector<std::string> words{"fit", file, "-o", result, "--quiet", "--json"};
    if (common.jobs > 0) words.insert(words.end(), {"--jobs", std::to_string(common.jobs)});
    if (run_program(words) != 0)
      throw bad_input(file, "fitting in a program of its own", "a failure", "a result");
    times.add("whole program", begin.ms());
  }
  const double megabytes = peak_megabytes(RUSAGE_CHILDREN);

  Json json{{"values", last.document.values_used},
            {"threads", threads},
            {"instruction_set", last.document.solver.instruction_set},
            {"program_megabytes", megabytes},
            {"rows", Json::array()}};
  for (const auto& s : times.spreads())
    json["rows"].push_back({{"name", s.name.substr(s.name.find_first_not_of(' '))},
                            {"median_ms", s.median},
                            {"least_ms", s.least},
                            {"most_ms", s.most}});
  json["spectral_channels_doubled"] =
      spread_of(divided(times.of(fmt::format("fit of {} channels", 2 * channels)),
                        times.of(fmt::format("fit of {} channels", channels))));
  json["pass_over_read"] = spread_of(divided(times.of("one pass"), times.of("its columns read")));
  if (o.plain) {
    progress("the plain way: one Ceres block per bin");
    const Table t = read_table(file);
    const auto plain = fit_plainly(t, {0.5, 0.5, 0.5, 0.5, 0.1, 0.1, 0.1}, threads);
    double worst = 0;
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
      // plain: alpha, f0, kd;  the model: kd, alpha, f0
      const std::size_t at = i == 0 ? 3 : i < 4 ? i + 3 : i - 4;
      worst = std::max(worst, std::abs(plain.values[i] / last.model.values[at] - 1));
    }
    const auto over = [](double ms, const std::vector<double>& ours) {
      return spread_of(divided(std::vector<double>(ours.size(), ms), ours));
    };
    json["plain"] = {{"build_ms", plain.build_ms},
                     {"solve_ms", plain.solve_ms},
                     {"iterations", plain.iterations},
                     {"megabytes", peak_megabytes(RUSAGE_SELF)},
                     {"largest_difference_of_values", worst}};
    json["ratio_of_solving"] = over(plain.solve_ms, solving);
    json["ratio_from_table_to_parameters"] = over(plain.build_ms + plain.solve_ms, to_parameters);
  }
  progress.clear();
  if (common.json) {
    print_document(json);
    return Exit::done;
  }
  fmt::print("{} values of a MERL table, {} on {} threads; ms: median [least, most] of {}\n",
             last.document.values_used, last.document.solver.instruction_set, threads, o.repeats);
  for (const auto& s : times.spreads())
    fmt::print("{:<24}{:8.2f}  [{:.2f}, {:.2f}]\n", s.name, s.median, s.least, s.most);
  const auto spread = [](const Json& s, int digits) {
    return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", s["median"].get<double>(), digits,
                       s["least"].get<double>(), digits, s["most"].get<double>(), digits);
  };
  fmt::print("one pass over reading its columns: {}\n", spread(json["pass_over_read"], 1));
  fmt::print("{} channels over {}: {}\n", 2 * channels, channels,
             spread(json["spectral_channels_doubled"], 1));
  fmt::print("whole program: {:.0f} MB at most\n", megabytes);
  if (o.plain)
    fmt::print(
        "one Ceres block per bin: {:.0f} ms to build, {:.0f} ms to solve, {:.0f} MB\n"
        "that over ours: solving {}, from table to parameters {}\n"
        "largest relative difference of the parameters: {:.1e}\n",
        json["plain"]["build_ms"].get<double>(), json["plain"]["solve_ms"].get<double>(),
        json["plain"]["megabytes"].get<double>(), spread(json["ratio_of_solving"], 0),
        spread(json["ratio_from_table_to_parameters"], 0),
        json["plain"]["largest_difference_of_values"].get<double>());
  return Exit::done;
}

}  // namespace gonio::cli
