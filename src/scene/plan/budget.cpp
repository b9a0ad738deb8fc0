#include "scene/plan/budget.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "scene/plan/cost.h"

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

/// Gives what is left of a budget to those that err by more than enough.
void spend(Shares& s, const std::vector<Sharer>& all, double budget_ns, double enough) {
  double covered = 0;
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) covered += all[order[i] = i].coverage;
  const auto chosen = [&](std::size_t i) -> const Choice& { return all[i].choices[s.choice[i]]; };
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return chosen(i).error; });
  for (const std::size_t i : order) {
    if (!(chosen(i).error > enough) || !(covered > 0)) continue;
    const double share = all[i].coverage / covered;
    const Choice before = chosen(i);
    const auto better = [&](const Choice& a, const Choice& b) {
      return std::max(a.error, enough) < std::max(b.error, enough) ||
             (a.error <= enough && b.error <= enough && a.ns < b.ns);
    };
    for (std::size_t k = 0; k < all[i].choices.size(); ++k) {
      const Choice& c = all[i].choices[k];
      if (s.ns + share * (c.ns - before.ns) <= budget_ns && better(c, chosen(i))) s.choice[i] = k;
    }
    s.ns += share * (chosen(i).ns - before.ns);
  }
}

/// Takes the lowest rank of those that are as fast.
void settle_ties(Shares& s, const std::vector<Sharer>& all, double budget_ns, double enough) {
  double covered = 0;
  for (const auto& sharer : all) covered += sharer.coverage;
  if (!(covered > 0)) return;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& choices = all[i].choices;
    const Choice& taken = choices[s.choice[i]];
    const double most = std::max(taken.error, std::min(s.error, enough));
    const auto ns_with = [&](const Choice& c) {
      return s.ns + all[i].coverage / covered * (c.ns - taken.ns);
    };
    std::size_t best = s.choice[i];
    for (std::size_t k = 0; k < choices.size(); ++k)
      if (const Choice& c = choices[k];
          c.rank < choices[best].rank && c.error <= most && ns_with(c) <= budget_ns &&
          are_too_near({c.ns, c.spread_ns}, {taken.ns, taken.spread_ns}))
        best = k;
    s.ns = ns_with(choices[best]);
    s.choice[i] = best;
  }
}

}  // namespace

Shares share_out(std::vector<Sharer> all, double budget_ns, double enough) {
  std::vector<double> errors;
  for (auto& sharer : all)
    for (auto& c : sharer.choices) {
      if (c.breaks) c.error = std::max(c.error, std::nextafter(enough, infinity));
      errors.push_back(c.error);
    }
  std::ranges::sort(errors);
  // More error never costs more time.
  const auto fits = [&](double error) { return cheapest(all, error).ns <= budget_ns; };
  const auto least = std::ranges::partition_point(errors, [&](double e) { return !fits(e); });
  Shares s = cheapest(all, least == errors.end() ? infinity : *least);
  s.fits = least != errors.end();
  if (s.fits) {
    spend(s, all, budget_ns, enough);
    settle_ties(s, all, budget_ns, enough);
  }
  return s;
}

}  // namespace gonio::scene
