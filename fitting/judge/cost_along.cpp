#include "fitting/judge/cost_along.h"

#include <algorithm>
#include <cmath>

#include "fitting/solve/colours.h"

namespace gonio {
namespace {

Problem with_held(const Problem& p, std::size_t unknown) {
  auto mask = p.free.mask();
  mask[p.free.slots()[unknown]] = false;
  return with_free(p, p.start.model, mask);
}

}  // namespace

CostAlong::CostAlong(const Problem& p,
                     const FitData<double>& data,
                     const Fitted& best,
                     std::size_t unknown)
    : held_(with_held(p, unknown)),
      accumulate_(held_.start.model, data, held_.free, best.huber),
      slot_(p.free.slots()[unknown]),
      cost_(best.solution.at.cost),
      solved_{{best.model.values[slot_], best.model.values}} {}

/// Values of the nearest place that was solved, and as much further as they moved since the next one.
std::vector<double> CostAlong::start_at(double value) const {
  const auto away = [&](const auto& s) { return std::abs(s.first - value); };
  const auto& near = *std::ranges::min_element(solved_, {}, away);
  auto values = near.second;
  const std::pair<double, std::vector<double>>* next = nullptr;
  for (const auto& s : solved_)
    if (s.first != near.first && (!next || away(s) < away(*next))) next = &s;
  if (next) {
    const double further = (value - near.first) / (near.first - next->first);
    if (std::abs(further) <= 1)
      for (std::size_t s = 0; s < values.size(); ++s)
        values[s] += further * (near.second[s] - next->second[s]);
  }
  values[slot_] = value;
  return values;
}

double CostAlong::rise(double value, double scale) {
  constexpr double precision = 0.003;
  double cost = 0;
  auto values = start_at(value);
  if (held_.free.size() == 0) {
    cost = accumulate_.normal_equations(values).cost;
  } else {
    Start s = descended(accumulate_, held_, std::move(values),
                        {60, precision * scale / (2 * cost_ + scale)});
    cost = s.cost;
    values = std::move(s.values);
  }
  solved_.emplace_back(value, std::move(values));
  return std::max(0.0, 2 * (cost - cost_));
}

double CostAlong::reach(double end, double much) {
  const double from = solved_.front().first;
  if (rise(end, much) < much) return end;
  // So near the end as the way is known, it is the end.
  const auto snapped = [&](double x) {
    return std::abs(x - end) < 0.01 * std::abs(from - end) ? end : x;
  };
  // The root of the rise is nearly a straight line: steps along it, and halves where these leave
  // what is known to hold the place.  A line that is steep near `from` is met by steps of decades.
  double inside = from, outside = end, at = from + (end - from) / 2, rise_at = rise(at, much);
  for (int step = 0; step < 60 && rise_at > 100 * much && std::abs(at - from) > 1e-300; ++step) {
    outside = at;
    at = from + (at - from) / 10;
    rise_at = rise(at, much);
  }
  for (int step = 0; step < 30; ++step) {
    (rise_at < much ? inside : outside) = at;
    if (std::abs(outside - inside) < 0.01 * std::abs(outside - from)) break;
    const double next = from + (at - from) * std::sqrt(much / std::max(rise_at, 1e-3 * much));
    const bool between = (next - inside) * (next - outside) < 0;
    at = step % 3 < 2 && between ? next : (inside + outside) / 2;
    rise_at = rise(at, much);
    if (std::abs(std::sqrt(rise_at / much) - 1) < 0.01) return snapped(at);
  }
  return snapped(outside);
}

}  // namespace gonio
