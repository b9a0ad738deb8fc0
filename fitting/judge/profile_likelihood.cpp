#include "fitting/judge/profile_likelihood.h"

#include <algorithm>
#include <cmath>

namespace gonio {

ProfileLikelihood::ProfileLikelihood(const Problem& p, const FitData<double>& data, const Fitted& f)
    : problem_(p), data_(data), best_(minimise(p, data, f.model, f.huber)) {
  best_.huber = f.huber;
}

double ProfileLikelihood::rise(std::size_t unknown, double value) const {
  Problem q = problem_;
  auto mask = q.free.mask();
  const std::size_t slot = q.free.slots()[unknown];
  mask[slot] = false;
  const auto leave_out = [&](auto& list) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(unknown));
  };
  leave_out(q.bounds.low);
  leave_out(q.bounds.high);
  leave_out(q.narrowed);
  q.free = FreeSlots(q.start.model, std::move(mask));
  BoundModel from = best_.model;
  from.values[slot] = value;
  double cost = 0;
  if (q.free.size() == 0)
    cost = Accumulator<double>(from.model, data_, q.free, best_.huber)
               .normal_equations(from.values)
               .cost;
  else
    cost = minimise(q, data_, std::move(from), best_.huber).solution.at.cost;
  return std::max(0.0, 2 * (cost - best_.solution.at.cost));
}

double ProfileLikelihood::reach(std::size_t unknown, double end, double much) const {
  const double from = best_.model.values[problem_.free.slots()[unknown]];
  if (rise(unknown, end) < much) return end;
  // The root of the rise is nearly a straight line: steps along it, and halves where these leave
  // what is known to hold the place.  A line that is steep near `from` is met by steps of decades.
  double inside = from, outside = end, at = from + (end - from) / 2, rise_at = rise(unknown, at);
  for (int step = 0; step < 60 && rise_at > 100 * much && std::abs(at - from) > 1e-300; ++step) {
    outside = at;
    at = from + (at - from) / 10;
    rise_at = rise(unknown, at);
  }
  for (int step = 0; step < 30; ++step) {
    (rise_at < much ? inside : outside) = at;
    if (std::abs(outside - inside) < 0.01 * std::abs(outside - from)) break;
    const double next = from + (at - from) * std::sqrt(much / std::max(rise_at, 1e-3 * much));
    const bool between = (next - inside) * (next - outside) < 0;
    at = step % 3 < 2 && between ? next : (inside + outside) / 2;
    rise_at = rise(unknown, at);
    if (std::abs(std::sqrt(rise_at / much) - 1) < 0.01) return at;
  }
  return outside;
}

}  // namespace gonio
