#include "fitting/judge/undetermined.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Problem of the model without its lobes.
Problem diffuse_alone(const Problem& p) {
  Problem q = p;
  q.start.model.lobes.clear();
  std::vector<bool> mask(p.free.mask().size(), false);
  q.bounds = {};
  q.narrowed.clear();
  for (const auto& t : p.start.model.diffuse)
    for (const std::size_t k : t.parameters) {
      const auto& parameter = p.start.model.parameters[k];
      for (std::size_t s = parameter.first; s < parameter.first + parameter.count; ++s)
        mask[s] = p.free.mask()[s];
    }
  for (const std::size_t s : p.free.slots())
    if (mask[s]) {
      q.bounds.low.push_back(p.bounds.low[p.free.index(s)]);
      q.bounds.high.push_back(p.bounds.high[p.free.index(s)]);
      q.narrowed.push_back(p.narrowed[p.free.index(s)]);
    }
  q.free = FreeSlots(q.start.model, std::move(mask));
  return q;
}

}  // namespace

bool find_undetermined(const Problem& p,
                       const FitData<double>& thin,
                       const Fitted& f,
                       std::size_t values_used,
                       Uncertainty& u) {
  const Accumulator<double> accumulate(p.start.model, thin, p.free, f.huber);
  const NormalEquations here = accumulate.normal_equations(f.model.values);
  const std::size_t n = p.free.size();
  if (thin.counts.used == 0) return false;
  const double count = static_cast<double>(thin.counts.used);
  double effect = 0;  // rounding is not evidence: residuals below 1e-7 of what a parameter can do
  for (std::size_t i = 0; i < n; ++i) {
    const double range = p.bounds.high[i] - p.bounds.low[i];
    effect = std::max(effect, here.h(i, i) * range * range);
  }
  const double variance = std::max(2 * here.cost, 1e-14 * effect) / count;
  const double share = static_cast<double>(thin.groups) / static_cast<double>(f.groups);
  const double luck = (3.84 + 2 * std::log(static_cast<double>(values_used))) * share;
  const auto costs = accumulate.channel_costs(f.model.values);
  const auto forget = [&](std::size_t i) {
    u.status[i] = ParameterStatus::not_identifiable;
    u.std_error[i] = nan;
  };
  for (const auto& q : p.start.model.parameters) {
    std::vector<std::size_t> asked;
    for (std::size_t s = q.first; s < q.first + q.count; ++s)
      if (p.free.mask()[s] &&
          (!q.about->per_channel || u.status[p.free.index(s)] == ParameterStatus::at_bound))
        asked.push_back(s);
    if (asked.empty()) continue;
    // All channels' values are moved at once: each changes its own channel's cost alone.
    std::vector<double> most(q.count);
    auto moved = f.model.values;
    for (const double part : {0.0, 0.03, 0.1, 0.3, 0.6, 1.0}) {
      for (const std::size_t s : asked) {
        const double low = p.bounds.low[p.free.index(s)], high = p.bounds.high[p.free.index(s)];
        moved[s] = low + part * (high - low);
      }
      const auto there = accumulate.channel_costs(moved);
      std::vector<double> change(q.count);
      for (std::size_t c = 0; c < there.size(); ++c)
        change[q.count > 1 ? c : 0] += there[c] - costs[c];
      for (std::size_t k = 0; k < q.count; ++k) most[k] = std::max(most[k], std::abs(change[k]));
    }
    for (const std::size_t s : asked)
      if (2 * most[s - q.first] < luck * variance) forget(p.free.index(s));
  }

  if (p.start.model.diffuse.empty() || p.start.model.lobes.empty()) return false;
  const Problem rest = diffuse_alone(p);
  const double without =
      minimise(rest, thin, {rest.start.model, f.model.values, {}}, f.huber).solution.at.cost;
  if (2 * (without - here.cost) >= luck * variance) return false;
  for (const auto& l : p.start.model.lobes)
    for (const auto* t : {&l.ndf, &l.masking, &l.fresnel})
      for (const std::size_t k : t->parameters) {
        const auto& q = p.start.model.parameters[k];
        for (std::size_t s = q.first; s < q.first + q.count; ++s)
          if (p.free.mask()[s]) forget(p.free.index(s));
      }
  return true;
}

}  // namespace gonio
