#include "timing/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <random>

#include <time.h>

namespace gonio {
namespace {

using Clock = std::chrono::steady_clock;

/// Time that the calling thread has worked, or that has passed on the wall [ns].
double now(bool of_thread) {
  if (!of_thread) {
    const auto t = Clock::now().time_since_epoch();
    return std::chrono::duration<double, std::nano>(t).count();
  }
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// Number of runs so that it takes `seconds`.  Of a few tries the shortest decides: where
/// another program took the processor, one alone would say that a single run is enough.
std::size_t runs_in(double seconds, const std::function<void()>& run) {
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
  return static_cast<std::size_t>(std::max(1.0, std::ceil(seconds / one)));
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
  std::vector<std::size_t> turns;  // the thing whose turn it is
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto& t = things[i];
    const int repetitions = t.repetitions > 0 ? t.repetitions : o.repetitions;
    turns.insert(turns.end(), static_cast<std::size_t>(repetitions), i);
    runs.push_back(runs_in(o.seconds, t.run));
  }
  std::shuffle(turns.begin(), turns.end(), std::mt19937_64(turns.size()));
  std::vector<std::vector<double>> out(things.size());
  double finished = 0;
  for (const std::size_t i : turns) {
    const double from = now(o.of_thread);
    for (std::size_t run = 0; run < runs[i]; ++run) things[i].run();
    out[i].push_back((now(o.of_thread) - from) /
                     (static_cast<double>(runs[i]) * static_cast<double>(things[i].samples)));
    if (done) done(++finished / static_cast<double>(turns.size()));
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
