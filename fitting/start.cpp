#include "fitting/start.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// The brightness below which a fifth of a channel's samples lie: where no highlight is.
double dim(const FitData& d, std::size_t channel) {
  std::vector<double> y;
  for (std::size_t i = 0; i < d.samples(); ++i)
    if (d.y[channel][i] >= 0) y.push_back(d.y[channel][i]);
  if (y.empty()) return 0;
  const auto at = y.begin() + static_cast<std::ptrdiff_t>(y.size() / 5);
  std::ranges::nth_element(y, at);
  return *at;
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

std::vector<double> find_start(const Model& m,
                               const FitData& thin,
                               const FreeSlots& free,
                               const Objective& objective,
                               const Bounds& bounds,
                               std::vector<double> values) {
  for (const auto& p : m.parameters)
    if (is_named(p.name, "kd"))
      for (std::size_t c = 0; c < p.count; ++c)
        if (free.mask()[p.first + c])
          values[p.first + c] = std::clamp(std::numbers::pi * dim(thin, c), 1e-3, 0.95);

  // A ladder of widths; later lobes are wider by two rungs each.
  std::vector<std::vector<double>> candidates;
  constexpr std::array widths{0.001, 0.003, 0.01, 0.03, 0.07, 0.15, 0.3, 0.5, 0.8};
  for (std::size_t w = 0; w < widths.size(); ++w)
    for (const double f0 : {0.04, 0.6}) {
      auto v = values;
      set(m, free, "f0", v, f0);
      for (std::size_t l = 0; l < m.lobes.size(); ++l) {
        const auto* alpha = m.find(l == 0 ? "alpha" : "alpha_" + std::to_string(l + 1));
        if (alpha && free.mask()[alpha->first])
          v[alpha->first] = widths[std::min(w + 2 * l, widths.size() - 1)];
      }
      if (std::ranges::find(candidates, v) == candidates.end()) candidates.push_back(std::move(v));
    }

  const auto slots = free.slots();
  const Accumulator accumulate(m, thin, free, objective);
  std::vector<std::pair<double, std::vector<double>>> tried(candidates.size());
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t k) {
    auto v = candidates[k];
    const auto evaluate = [&](const std::vector<double>& x) {
      for (std::size_t i = 0; i < x.size(); ++i) v[slots[i]] = x[i];
      return accumulate.normal_equations(v);
    };
    std::vector<double> x;
    for (const std::size_t s : slots) x.push_back(v[s]);
    SolveOptions o;
    o.max_iterations = 25;
    o.function_tolerance = 1e-4;
    const auto s = solve(evaluate, std::move(x), bounds, o);
    for (std::size_t i = 0; i < slots.size(); ++i) v[slots[i]] = s.x[i];
    tried[k] = {s.at.cost, std::move(v)};
  });
  return std::ranges::min_element(tried, {}, [](const auto& t) { return t.first; })->second;
}

}  // namespace gonio
