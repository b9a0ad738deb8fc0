#include "table/health/fills.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/quantile.h"

namespace gonio {
namespace {

constexpr std::size_t few_sharers = 8;
constexpr std::size_t times_as_often =
    4;  ///< times as often as any other value: rounding makes them all frequent
constexpr std::size_t rarely = 500;  ///< of so many values
constexpr std::size_t often = 20;    ///< one of so many
constexpr double most_of_all = 0.6;  ///< of the values
constexpr double least_step = 0.15;  ///< ln of a factor between a fill and what is beside it
constexpr double beyond_steps = 2;   ///< times the steps in which values near it are written

/// Most frequent value of a channel, where it is far more frequent than all others.
struct Frequent {
  double value;
  std::size_t times, values;
  double step;  ///< between other values near it [1/sr]
};
/// Median step between the sixteen other values that are nearest to one.
double step_near(const std::unordered_map<double, std::size_t>& times, double value) {
  constexpr std::ptrdiff_t near = 16;
  std::vector<double> all;
  for (const auto& [other, n] : times)
    if (other != value) all.push_back(other);
  std::ranges::sort(all);
  const auto at = std::ranges::lower_bound(all, value);
  const auto from = at - std::min<std::ptrdiff_t>(near / 2, at - all.begin());
  const auto to = from + std::min<std::ptrdiff_t>(near, all.end() - from);
  std::vector<double> steps;
  for (auto k = from; k + 1 < to; ++k)
    if (!(*k < value && value < k[1])) steps.push_back(k[1] - *k);
  return steps.empty() ? 0 : median(steps);
}
std::optional<Frequent> most_frequent(const Table& t, const SampleAngles& at, std::size_t c) {
  const std::size_t step = t.size() / 60'000 + 1;
  std::unordered_map<double, std::size_t> times;
  std::size_t values = 0;
  for (std::size_t i = 0; i < t.size(); i += step)
    if (const double v = t.values[c][i]; v > 0 && mask(at(i), v) == Mask::valid)
      ++times[v], ++values;
  Frequent first{0, 0, values, 0};
  std::size_t second = 0;
  for (const auto& [value, n] : times)
    if (n > first.times)
      second = std::exchange(first.times, n), first.value = value;
    else
      second = std::max(second, n);
  constexpr std::size_t few_values = 50;  // different: then all have many sharers
  const bool stands_out =
      times.size() >= few_values && first.times >= few_sharers &&
      first.times >= times_as_often * second && rarely * first.times >= values &&
      static_cast<double>(first.times) < most_of_all * static_cast<double>(values);
  if (!stands_out) return {};
  first.step = step_near(times, first.value);
  return first;
}

/// The neighbours of a value in the table.
struct Beside {
  double step;    ///< median ln of the factor between it and others
  double others;  ///< part of its neighbours that are others
};
Beside beside(const Table& t, const SampleAngles& at, std::size_t c, double value) {
  const Values& plane = t.values[c];
  std::vector<double> steps;
  double same = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if ((plane[i] == value) == (plane[i - 1] == value)) {
      if (plane[i] == value) same += 2;
      continue;
    }
    const std::size_t other = plane[i] == value ? i - 1 : i;
    if (plane[other] > 0 && mask(at(other), plane[other]) == Mask::valid)
      steps.push_back(std::abs(std::log(plane[other] / value)));
  }
  if (steps.empty()) return {0, 0};
  const auto others = static_cast<double>(steps.size());
  return {median(steps), others / (others + same)};
}

}  // namespace

std::optional<Fill> fill_of(const Table& t) {
  if (t.truth) return {};
  const SampleAngles at(t);
  std::optional<Fill> found;
  for (std::size_t c = 0; c < t.values.size(); ++c) {
    const auto f = most_frequent(t, at, c);
    if (!f || (found && f->value != found->value)) continue;
    const double steps = std::log1p(beyond_steps * f->step / f->value);
    const auto [step, others] = beside(t, at, c, f->value);
    // One that is as large as its neighbours is no base: that has no other values in between.
    const bool is_among_others = often * f->times >= f->values && others > 0.5;
    if (step < std::max(is_among_others ? 0 : least_step, steps)) continue;
    if (!found) found = {f->value, 0, 0, {}};
    found->sharers += f->times;
    found->values += f->values;
    found->channels.push_back(c);
  }
  return found;
}

}  // namespace gonio
