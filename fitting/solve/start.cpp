#include "fitting/solve/start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/quantile.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// The brightness below which a fifth of a channel's samples lie: where no highlight is.
template <class F>
double dim(const FitData<F>& d, std::size_t channel) {
  std::vector<double> targets;
  for (const auto& task : d.tasks)
    for (const auto& b : task)
      for (std::size_t i = 0; i < b.n; ++i)
        if (b.weight(channel)[i] > 0) targets.push_back(static_cast<double>(b.target(channel)[i]));
  if (targets.empty()) return 0;
  const double t = quantile(targets, 0.2);
  return d.link == Link::log ? std::exp(t) - static_cast<double>(d.offset) : t;
}

/// A cost that can be compared: infinite where it is none.
double finite(double cost) {
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

bool is_named(std::string_view name, std::string_view base) {
  return name == base || name.starts_with(std::string(base) + "_");
}

/// Sets every free slot of the parameters called `base` (or base_2 …).
void set(const Model& m,
         const FreeSlots& free,
         std::string_view base,
         std::vector<double>& values,
         double value) {
  for (const auto& p : m.parameters)
    if (is_named(p.name, base))
      for (std::size_t c = 0; c < p.count; ++c)
        if (free.mask()[p.first + c]) values[p.first + c] = value;
}

}  // namespace

template <class F>
std::vector<double> find_start(const Model& m,
                               const FitData<F>& thin,
                               const FreeSlots& free,
                               const Bounds& bounds,
                               std::vector<double> values) {
  for (const auto& p : m.parameters)
    if (is_named(p.name, "kd"))
      for (std::size_t c = 0; c < p.count; ++c)
        if (free.mask()[p.first + c])
          values[p.first + c] = std::clamp(std::numbers::pi * dim(thin, c), 1e-3, 0.95);

  // A ladder of widths; later lobes are wider by two rungs each.
  constexpr std::array widths{0.001, 0.003, 0.01, 0.03, 0.07, 0.15, 0.3, 0.5, 0.8};
  constexpr std::array reflectances{0.02, 0.06, 0.2, 0.6, 0.95};
  const Accumulator<F> accumulate(m, thin, free);
  using Tried = std::pair<double, std::vector<double>>;
  std::vector<Tried> rungs(widths.size());
  tbb::parallel_for(std::size_t{0}, widths.size(), [&](std::size_t w) {
    auto v = values;
    for (std::size_t l = 0; l < m.lobes.size(); ++l) {
      const auto* alpha = m.find(l == 0 ? "alpha" : "alpha_" + std::to_string(l + 1));
      if (alpha && free.mask()[alpha->first])
        v[alpha->first] = widths[std::min(w + 2 * l, widths.size() - 1)];
    }
    rungs[w].first = std::numeric_limits<double>::infinity();
    for (const double f0 : reflectances) {
      set(m, free, "f0", v, f0);
      const double cost = finite(accumulate.normal_equations(v).cost);
      if (rungs[w].second.empty() || cost < rungs[w].first) rungs[w] = {cost, v};
    }
  });
  std::ranges::stable_sort(rungs, {}, &Tried::first);
  constexpr std::size_t kept = 4;
  rungs.resize(kept);

  tbb::parallel_for(std::size_t{0}, rungs.size(), [&](std::size_t k) {
    auto& v = rungs[k].second;
    const auto evaluate = [&](const std::vector<double>& x) {
      free.put(x, v);
      return accumulate.normal_equations(v);
    };
    auto x = free.of(v);
    SolveOptions o;
    o.max_iterations = 25;
    o.function_tolerance = 1e-4;
    const double cost = solve(evaluate, x, bounds, o).at.cost;
    free.put(x, v);
    rungs[k].first = finite(cost);
  });
  return std::ranges::min_element(rungs, {}, &Tried::first)->second;
}

template std::vector<double> find_start(
    const Model&, const FitData<float>&, const FreeSlots&, const Bounds&, std::vector<double>);
template std::vector<double> find_start(
    const Model&, const FitData<double>&, const FreeSlots&, const Bounds&, std::vector<double>);

}  // namespace gonio
