#pragma once
/// \file
/// How long something takes, told with its spread.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace gonio {

struct Timing {
  double ns, spread_ns;  ///< median, and half the distance of the quartiles
};

/// Of at least 7 runs and 2 ms.
template <class F>
Timing time_of(const F& f) {
  using Clock = std::chrono::steady_clock;
  const auto once = [&](int repeats) {
    const auto from = Clock::now();
    for (int i = 0; i < repeats; ++i) f();
    return std::chrono::duration<double, std::nano>(Clock::now() - from).count() / repeats;
  };
  // A look at the clock takes some 20 ns: what is short is done several times between two.
  const int repeats = static_cast<int>(std::clamp(20'000 / std::max(once(1), 1.0), 1.0, 1000.0));
  std::vector<double> ns;
  for (const auto begin = Clock::now();
       ns.size() < 7 || Clock::now() - begin < std::chrono::milliseconds(2);)
    ns.push_back(once(repeats));
  std::ranges::sort(ns);
  const auto at = [&](std::size_t quarters) { return ns[quarters * (ns.size() - 1) / 4]; };
  return {at(2), (at(3) - at(1)) / 2};
}

}  // namespace gonio
