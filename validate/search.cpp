#include "validate/search.h"

#include <algorithm>
#include <cmath>

namespace gonio::validating {
namespace {

constexpr Choice::Ends all_cosines{0.05, 1};

/// Value between two ends where a function is greatest, if it has one peak there.
template <class Function>
double peak_between(double low, double high, const Function& f) {
  constexpr int most = 12;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < most; ++i)
    if (fa > fb) {
      high = b, b = a, fb = fa;
      a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb;
      b = low + golden * (high - low), fb = f(b);
    }
  return fa > fb ? a : b;
}

}  // namespace

std::vector<double> steps(const Choice::Ends& e, int n) {
  if (e[0] == e[1]) return {e[0]};
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(i == n - 1 ? e[1] : e[0] + (e[1] - e[0]) * i / (n - 1));
  return all;
}

std::vector<double> roughnesses(const Choice& c, const Effort& effort) {
  return c.domain.roughness ? steps(*c.domain.roughness, effort.roughness_steps) : std::vector{1.0};
}
std::vector<double> cosines(const Choice& c, const Effort& effort) {
  return steps(c.domain.mu.value_or(all_cosines), effort.cosine_steps);
}

std::vector<Found> on_grid(const Choice& c,
                           const Effort& effort,
                           const ErrorAt& error,
                           const std::function<void(double)>& done) {
  const auto all = substances(c);
  const auto rough = roughnesses(c, effort);
  const auto mu = cosines(c, effort);
  std::vector<Found> grid;
  for (std::size_t s = 0; s < all.size(); ++s)
    for (std::size_t r = 0; r < rough.size(); ++r) {
      const auto errors = error(all[s], rough[r], mu);
      for (std::size_t m = 0; m < mu.size(); ++m)
        grid.push_back(
            {errors[m],
             {all[s],
              all.size() > 1 ? static_cast<double>(s) / static_cast<double>(all.size() - 1) : 0,
              rough[r], mu[m]}});
      if (done)
        done(static_cast<double>(s * rough.size() + r + 1) /
             static_cast<double>(all.size() * rough.size()));
    }
  return grid;
}

Found worst(const Choice& c,
            const Effort& effort,
            const std::vector<Found>& grid,
            const ErrorAt& error) {
  // What is no number is as bad as can be.
  const auto badness = [](double v) { return std::isnan(v) ? HUGE_VAL : v; };
  Found best =
      *std::ranges::max_element(grid, {}, [&](const Found& f) { return badness(f.value); });
  if (!effort.refined || !std::isfinite(badness(best.value))) return best;
  const auto value_at = [&](const Point& p) {
    return badness(error(p.substance, p.roughness, std::span(&p.mu, 1))[0]);
  };
  const auto along = [&](double now, const Choice::Ends& ends, double step, const auto& moved) {
    const double low = std::max(ends[0], now - step), high = std::min(ends[1], now + step);
    if (!(low < high)) return;
    const double x = peak_between(low, high, [&](double v) { return value_at(moved(v)); });
    const Point p = moved(x);
    if (const double v = value_at(p); v > best.value) best = {v, p};
  };
  const auto width = [](const Choice::Ends& e, int n) { return (e[1] - e[0]) / (n - 1); };
  for (int round = 0; round < 2 && std::isfinite(best.value); ++round) {
    const auto mu = c.domain.mu.value_or(all_cosines);
    along(best.at.mu, mu, width(mu, effort.cosine_steps), [&](double v) {
      Point p = best.at;
      p.mu = v;
      return p;
    });
    if (c.domain.roughness)
      along(best.at.roughness, *c.domain.roughness,
            width(*c.domain.roughness, effort.roughness_steps), [&](double v) {
              Point p = best.at;
              p.roughness = v;
              return p;
            });
    if (has_range(c))
      along(best.at.part, {0, 1}, 0.25, [&](double v) {
        Point p = best.at;
        p.part = v;
        p.substance = substance_at(c, v);
        return p;
      });
  }
  return best;
}

}  // namespace gonio::validating
