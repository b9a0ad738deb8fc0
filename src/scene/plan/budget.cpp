#include "scene/plan/budget.h"

#include <algorithm>
#include <limits>

namespace gonio::scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Everyone's cheapest choice of at most that error; none fits where someone has none.
Shares cheapest(const std::vector<Sharer>& all, double most_error) {
  Shares s;
  double covered = 0;
  for (const auto& sharer : all) {
    std::size_t best = sharer.choices.size();
    for (std::size_t i = 0; i < sharer.choices.size(); ++i)
      if (sharer.choices[i].error <= most_error &&
          (best == sharer.choices.size() || sharer.choices[i].ns < sharer.choices[best].ns))
        best = i;
    if (best == sharer.choices.size()) return {{}, infinity, infinity, false};
    s.choice.push_back(best);
    s.ns += sharer.coverage * sharer.choices[best].ns;
    s.error = std::max(s.error, sharer.choices[best].error);
    covered += sharer.coverage;
  }
  if (covered > 0) s.ns /= covered;
  return s;
}

}  // namespace

Shares share_out(const std::vector<Sharer>& all, double budget_ns) {
  std::vector<double> errors;
  for (const auto& sharer : all)
    for (const auto& c : sharer.choices) errors.push_back(c.error);
  std::ranges::sort(errors);
  // More error never costs more time.
  const auto fits = [&](double error) { return cheapest(all, error).ns <= budget_ns; };
  const auto least = std::ranges::partition_point(errors, [&](double e) { return !fits(e); });
  Shares s = cheapest(all, least == errors.end() ? infinity : *least);
  s.fits = least != errors.end();
  return s;
}

}  // namespace gonio::scene
