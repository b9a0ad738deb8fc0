#pragma once
/// \file
/// Times of things, told with their spread: the one way in which this program measures it.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace gonio {

/// Time of one sample [ns].
struct Timing {
  double ns, spread_ns;  ///< median, and half the distance of the quartiles, over repetitions
};

/// Something that works through `samples` samples each time it is run.
struct Timed {
  std::size_t samples;
  std::function<void()> run;
  int repetitions = 0;  ///< 0: as the options say
};

struct TimingOptions {
  int repetitions = 7;
  double seconds = 3e-4;  ///< above 0: that each repetition takes at least
  /// The time of the calling thread, so that what other programs take does not count; else that of
  /// the clock on the wall, for what runs on several threads.
  bool of_thread = false;
};

/// The repetitions of all of them are done in random order, so that what slows the machine for a while
/// slows a little of each.  One call at a time: others wait.
/// \param done  the part that is done, in [0, 1]
std::vector<Timing> time_all(const std::vector<Timed>&,
                             const TimingOptions& = {},
                             const std::function<void(double)>& done = {});

/// Times of each repetition of each, of one sample [ns].
std::vector<std::vector<double>> repetitions_of(const std::vector<Timed>&,
                                                const TimingOptions& = {},
                                                const std::function<void(double)>& done = {});

/// One alone, on the wall.
Timing time_of(const std::function<void()>& run);

/// Median, and half the distance of the quartiles, of at least one value.
Timing spread_of(std::vector<double> ns);

/// A time, and the same in each of several processes, in their order; `each` is empty where one process measured.
struct ComparedTime {
  Timing time;
  std::span<const double> each{};
};
struct TimeDifference {
  double ns, spread_ns;
  /// It is there in every process, above its spread and 3 % of the time; of one alone: above both spreads together.
  bool survives;
};
/// Time that `to` takes more than `from`.  Of the same processes: the median of what they differ by in each, and its
/// spread, so that what slows a process down as a whole does not count.
TimeDifference difference(const ComparedTime& from, const ComparedTime& to);

}  // namespace gonio
