#include "reports/timing.h"

#include <algorithm>
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

/// What is registered is the whole program's.
struct Registered {
  Registered() { benchmark::ClearRegisteredBenchmarks(); }
  ~Registered() { benchmark::ClearRegisteredBenchmarks(); }
};

/// How far it is: a repetition is done when a thing is run as often as the time before.
class Steps {
 public:
  Steps(std::size_t things, int repetitions, const std::function<void(double)>& done)
      : last_(things, 0), all_(things * static_cast<std::size_t>(repetitions)), done_(done) {}
  void operator()(std::size_t thing, benchmark::IterationCount times) {
    if (times == last_[thing]) finished_ = std::min(finished_ + 1, all_);
    last_[thing] = times;
    if (done_) done_(static_cast<double>(finished_) / static_cast<double>(all_));
  }

 private:
  std::vector<benchmark::IterationCount> last_;
  std::size_t all_, finished_ = 0;
  const std::function<void(double)>& done_;
};

}  // namespace

Timing spread_of(std::vector<double> ns) {
  std::ranges::sort(ns);
  const auto at = [&](std::size_t quarters) { return ns[quarters * (ns.size() - 1) / 4]; };
  return {at(2), (at(3) - at(1)) / 2};
}

std::vector<Timing> time_all(const std::vector<Timed>& things,
                             const TimingOptions& o,
                             const std::function<void(double)>& done) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (things.empty()) return {};
  set_up();
  const Registered registered;
  Steps steps(things.size(), o.repetitions, done);
  for (std::size_t i = 0; i < things.size(); ++i) {
    auto* b =
        benchmark::RegisterBenchmark(std::to_string(i).c_str(), [&, i](benchmark::State& state) {
          for (auto _ : state) things[i].run();
          steps(i, state.max_iterations);
        });
    b->Repetitions(o.repetitions)->ReportAggregatesOnly(false)->MinTime(o.seconds);
    if (!o.of_thread) b->UseRealTime();
  }
  Keep keep(things.size(), o.of_thread);
  benchmark::RunSpecifiedBenchmarks(&keep, ".");
  std::vector<Timing> out;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto t = spread_of(keep.ns(i));
    const auto n = static_cast<double>(things[i].samples);
    out.push_back({t.ns / n, t.spread_ns / n});
  }
  return out;
}

Timing time_of(const std::function<void()>& run) {
  return time_all({{1, run}})[0];
}

}  // namespace gonio
