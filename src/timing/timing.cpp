#include "timing/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <ostream>
#include <string>

#include <benchmark/benchmark.h>

namespace gonio {
namespace {

/// Keeps what each repetition took, and prints nothing.
class Keep : public benchmark::BenchmarkReporter {
 public:
  Keep(std::size_t n, bool of_thread) : ns_(n), of_thread_(of_thread), nowhere_(nullptr) {
    SetOutputStream(&nowhere_);
    SetErrorStream(&nowhere_);
  }
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const auto& r : runs)
      if (r.run_type == Run::RT_Iteration)
        ns_[std::stoul(r.run_name.function_name)].push_back(
            1e9 * (of_thread_ ? r.cpu_accumulated_time : r.real_accumulated_time) /
            static_cast<double>(r.iterations));
  }
  const std::vector<double>& ns(std::size_t i) const { return ns_[i]; }

 private:
  std::vector<std::vector<double>> ns_;
  bool of_thread_;
  std::ostream nowhere_;
};

/// google-benchmark takes its settings from a command line alone: this one, once, never the user's.
void set_up() {
  static const bool once = [] {
    std::vector<std::string> words{"gonio", "--benchmark_enable_random_interleaving=true",
                                   "--benchmark_out=", "--benchmark_perf_counters=", "--v=0"};
    std::vector<char*> argv;
    for (auto& w : words) argv.push_back(w.data());
    int argc = static_cast<int>(argv.size());
    benchmark::Initialize(&argc, argv.data());
    return true;
  }();
  static_cast<void>(once);
}

/// Registration, which is the whole program's.
struct Registered {
  Registered() { benchmark::ClearRegisteredBenchmarks(); }
  ~Registered() { benchmark::ClearRegisteredBenchmarks(); }
};

/// Number of runs so that it takes `seconds`.  Of a few tries the shortest decides: where
/// another program took the processor, one alone would say that a single run is enough.
benchmark::IterationCount runs_in(double seconds, const std::function<void()>& run) {
  using Clock = std::chrono::steady_clock;
  const auto shortest = [&](int runs) {
    double least = std::numeric_limits<double>::infinity();
    for (int tried = 0; tried < 3; ++tried) {
      const auto from = Clock::now();
      for (int i = 0; i < runs; ++i) run();
      least = std::min(least, std::chrono::duration<double>(Clock::now() - from).count() / runs);
    }
    return least;
  };
  double one = shortest(1);
  if (one < 1e-5) one = std::max(shortest(16), 1e-10);  // a look at the clock takes part of that
  return std::max<benchmark::IterationCount>(
      1, static_cast<benchmark::IterationCount>(std::ceil(seconds / one)));
}

}  // namespace

Timing spread_of(std::vector<double> ns) {
  std::ranges::sort(ns);
  const auto at = [&](std::size_t quarters) { return ns[quarters * (ns.size() - 1) / 4]; };
  return {at(2), (at(3) - at(1)) / 2};
}

TimeDifference difference(const ComparedTime& from, const ComparedTime& to) {
  if (from.each.size() != to.each.size() || from.each.size() < 2) {
    const double ns = to.time.ns - from.time.ns;
    return {ns, std::hypot(from.time.spread_ns, to.time.spread_ns),
            std::abs(ns) > from.time.spread_ns + to.time.spread_ns};
  }
  std::vector<double> more(from.each.size());
  std::ranges::transform(to.each, from.each, more.begin(), std::minus<>());
  const bool one_sign = std::ranges::all_of(more, [](double x) { return x > 0; }) ||
                        std::ranges::all_of(more, [](double x) { return x < 0; });
  const auto t = spread_of(std::move(more));
  // What the places of code and of columns move a time by, though it be in every process.
  constexpr double resolved = 0.03;
  const double least = std::max(t.spread_ns, resolved * std::max(from.time.ns, to.time.ns));
  return {t.ns, t.spread_ns, one_sign && std::abs(t.ns) > least};
}

std::vector<std::vector<double>> repetitions_of(const std::vector<Timed>& things,
                                                const TimingOptions& o,
                                                const std::function<void(double)>& done) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (things.empty()) return {};
  set_up();
  const Registered registered;
  const auto repetitions = [&](const Timed& t) {
    return t.repetitions > 0 ? t.repetitions : o.repetitions;
  };
  double finished = 0, all = 0;
  for (const auto& t : things) all += repetitions(t);
  for (std::size_t i = 0; i < things.size(); ++i) {
    auto* b =
        benchmark::RegisterBenchmark(std::to_string(i).c_str(), [&, i](benchmark::State& state) {
          for (auto _ : state) things[i].run();
          if (done) done(++finished / all);
        });
    b->Repetitions(repetitions(things[i]))
        ->ReportAggregatesOnly(false)
        ->Iterations(runs_in(o.seconds, things[i].run));
    if (!o.of_thread) b->UseRealTime();
  }
  Keep keep(things.size(), o.of_thread);
  benchmark::RunSpecifiedBenchmarks(&keep, ".");
  std::vector<std::vector<double>> out;
  for (std::size_t i = 0; i < things.size(); ++i) {
    out.push_back(keep.ns(i));
    for (double& ns : out.back()) ns /= static_cast<double>(things[i].samples);
  }
  return out;
}

std::vector<Timing> time_all(const std::vector<Timed>& things,
                             const TimingOptions& o,
                             const std::function<void(double)>& done) {
  std::vector<Timing> out;
  for (auto& ns : repetitions_of(things, o, done)) out.push_back(spread_of(std::move(ns)));
  return out;
}

Timing time_of(const std::function<void()>& run) {
  return time_all({{1, run}})[0];
}

}  // namespace gonio
