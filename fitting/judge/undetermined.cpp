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
  q.free = FreeSlots(std::move(mask));
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
    effect = std::max(effect, here.h[i * n + i] * range * range);
  }
  const double variance = std::max(2 * here.cost, 1e-14 * effect) / count;
  const double share = static_cast<double>(thin.groups) / static_cast<double>(f.groups);
  const double luck = (3.84 + 2 * std::log(static_cast<double>(values_used))) * share;
  for (const auto& q : p.start.model.parameters)
    for (std::size_t s = q.first; s < q.first + q.count; ++s) {
      if (!p.free.mask()[s]) continue;
      const std::size_t i = p.free.index(s);
      if (q.about->per_channel && u.status[i] != ParameterStatus::at_bound) continue;
      auto moved = f.model.values;
      const double low = p.bounds.low[i], high = p.bounds.high[i];
      double most = 0;
      for (const double part : {0.0, 0.03, 0.1, 0.3, 0.6, 1.0}) {
        moved[s] = low + part * (high - low);
        most = std::max(most, std::abs(accumulate.normal_equations(moved).cost - here.cost));
      }
      if (2 * most < luck * variance) {
        u.status[i] = ParameterStatus::not_identifiable;
        u.std_error[i] = nan;
      }
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
          if (p.free.mask()[s]) {
            u.status[p.free.index(s)] = ParameterStatus::not_identifiable;
            u.std_error[p.free.index(s)] = nan;
          }
      }
  return true;
}

}  // namespace gonio
