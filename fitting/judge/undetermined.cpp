#include "fitting/judge/undetermined.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "fitting/judge/arrow_inverse.h"
#include "fitting/judge/cost_along.h"
#include "fitting/solve/start.h"
#include "number/distributions.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Sum of squares of the residuals if the model were 0, or off by a factor e under logs.
double signal(const FitData<double>& d, std::size_t channels) {
  double squares = 0;
  for (const auto& task : d.tasks)
    for (const auto& b : task)
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < b.n; ++i) {
          const double x = b.weight(c)[i] * (d.link == Link::log ? 1 : b.target(c)[i]);
          squares += x * x;
        }
  return squares;
}

/// Parts of a range at which an unknown is held.
constexpr std::array places{0.0, 0.03, 0.1, 0.3, 0.6, 1.0};

/// Ends of intervals by the cost itself, where a parabola is no likeness of it.
class Ends {
 public:
  /// \param thin  a thinned table   \param best  fit of that   \param f  of the whole
  /// \param variance  of a value's residual   \param share  of the whole table that is looked at
  Ends(const Problem& p,
       const FitData<double>& thin,
       const Fitted& best,
       const Fitted& f,
       double variance,
       double share,
       double freedom,
       Uncertainty& u)
      : problem_(p),
        thin_(thin),
        best_(best),
        fitted_(f),
        share_(share),
        freedom_(std::max(freedom, 1.0)),
        u_(u) {
    // Of what has no error of its own the least well known one's.
    for (const auto& v : u.verdicts)
      if (v.variance > variance) variance = v.variance;
    variance_ = variance;
  }

  /// Limit of what stands at a bound, unless it is pushed against that, or is not known to within its
  /// range.  \param widened  by a misfit: a limit at the range's end is the model's fault, and the value still its best
  void find_limit(std::size_t i, double luck, bool widened) const {
    const double low = problem_.bounds.low[i], high = problem_.bounds.high[i];
    const auto forget = [&] {
      u_[i].forget(fmt::format("any value from {:.3g} to {:.3g} does as well", low, high));
    };
    const double t = students_t_quantile(0.95, freedom(i)), much = t * t * variance(i) * share_;
    CostAlong along(problem_, thin_, best_, i);
    const bool below = along.rise(low, luck) < luck, above = along.rise(high, luck) < luck;
    if (below && above) return forget();
    if (!below && !above) return find_ends(i);
    const double end = below ? high : low;
    const double limit = along.reach(end, much);
    if (limit == end) return widened ? find_ends(i) : forget();
    u_[i].keep_limit(
        below ? ParameterStatus::upper_limit : ParameterStatus::lower_limit, limit,
        fmt::format("values {} to {:.3g} do as well", below ? "down" : "up", below ? low : high));
  }

  /// Two ends.  \param more  rise of twice the cost that does as well
  void find_ends(std::size_t i, double more = 0) const {
    const double t = students_t_quantile(0.975, freedom(i)),
                 much = t * t * variance(i) * share_ + std::max(more, 0.0);
    CostAlong along(problem_, thin_, best_, i);
    const double here = best_.model.values[problem_.free.slots()[i]];
    const double found = fitted_.model.values[problem_.free.slots()[i]];
    u_[i].status = ParameterStatus::free;
    // Of the thinned samples, moved to the value of all; a bound is a bound of both.
    const auto reached = [&](double bound) {
      const double end = along.reach(bound, much);
      return end == bound ? bound : found + end - here;
    };
    u_[i].low = reached(problem_.bounds.low[i]);
    u_[i].high = reached(problem_.bounds.high[i]);
    if (std::isnan(u_[i].std_error)) u_[i].std_error = (u_[i].high - u_[i].low) / (2 * t);
    u_[i].reason.clear();
  }

  /// Widens what is known of the others by as far as they move while an unknown is anywhere that it may be.
  /// \param luck  rise of twice the cost that does as well
  void hold_over_unknowns(double luck) const {
    using enum ParameterStatus;
    const std::size_t n = u_.verdicts.size();
    std::vector<double> down(n), up(n);
    for (std::size_t k = 0; k < n; ++k) {
      const auto& v = u_[k];
      if (v.status == free || problem_.narrowed[k]) continue;
      const double low = problem_.bounds.low[k], high = problem_.bounds.high[k];
      const double here = best_.model.values[problem_.free.slots()[k]];
      const double t = students_t_quantile(0.975, freedom(k));
      const double much = std::max(luck, t * t * variance(k) * share_);
      CostAlong along(problem_, thin_, best_, k);
      for (const double part : places) {
        const double at = low + part * (high - low);
        // On the way to its limit others move as far as their own intervals say.
        if ((v.status == upper_limit && at > here) || (v.status == lower_limit && at < here))
          continue;
        if (!(along.rise(at, much) < much)) continue;
        for (std::size_t i = 0; i < n; ++i) {
          const std::size_t slot = problem_.free.slots()[i];
          const double by = along.last()[slot] - best_.model.values[slot];
          down[i] = std::min(down[i], by), up[i] = std::max(up[i], by);
        }
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      auto& v = u_[i];
      const auto within = [&](double x) {
        return std::clamp(x, problem_.bounds.low[i], problem_.bounds.high[i]);
      };
      if (v.status == upper_limit) v.limit = within(v.limit + up[i]);
      if (v.status == lower_limit) v.limit = within(v.limit + down[i]);
      if (std::isnan(v.std_error)) continue;
      const double x = fitted_.model.values[problem_.free.slots()[i]];
      const double low = v.low_end(x), high = v.high_end(x);
      constexpr double little = 0.05;  // of the interval: lets ± stay
      if (!(std::max(up[i], -down[i]) > little * (high - low))) continue;
      v.low = within(low + down[i]), v.high = within(high + up[i]);
    }
  }

  /// True where the cost half-way to the ends of x ± t σ, all others moving along a straight line, is
  /// that of a parabola to a fifth.
  bool is_parabola(std::size_t i, const Accumulator<double>& accumulate) const {
    const auto& h = best_.solution.at.h;
    std::vector<std::size_t> moving;
    for (std::size_t k = 0; k < h.size(); ++k)
      if (!std::isnan(u_[k].std_error)) moving.push_back(k);
    const auto layout = std::make_shared<const ArrowLayout>(h.layout().part(moving));
    const ArrowInverse inverse(h.part(layout, moving));
    const auto at = static_cast<std::size_t>(std::ranges::find(moving, i) - moving.begin());
    // The interval of so many values as are looked at.
    const double width = u_[i].t * u_[i].std_error / std::sqrt(share_);
    for (const double step : {-width, width}) {
      auto values = best_.model.values;
      for (std::size_t k = 0; k < moving.size(); ++k) {
        const std::size_t slot = problem_.free.slots()[moving[k]];
        values[slot] = std::clamp(values[slot] + step * inverse(k, at) / inverse(at, at),
                                  problem_.bounds.low[moving[k]], problem_.bounds.high[moving[k]]);
      }
      const double rise = 2 * (accumulate.normal_equations(values).cost - best_.solution.at.cost);
      constexpr double alike = 0.2;
      if (!(std::abs(rise / (step * step / inverse(at, at)) - 1) < alike)) return false;
    }
    return true;
  }

  /// True where an unknown that has a limit may move this one: at a bound without a slope nothing tells.
  bool is_tied_to_a_limit(std::size_t i) const {
    const auto& h = best_.solution.at.h;
    const auto& layout = h.layout();
    for (std::size_t k = 0; k < h.size(); ++k) {
      if (u_[k].status != ParameterStatus::upper_limit &&
          u_[k].status != ParameterStatus::lower_limit)
        continue;
      const bool meet = layout.arm(i) == layout.arm(k) || layout.arm(i) == ArrowLayout::none ||
                        layout.arm(k) == ArrowLayout::none;
      constexpr double loosely = 0.1, flat = 1e-6;
      const double range = problem_.bounds.high[k] - problem_.bounds.low[k];
      if (meet && (!(h(k, k) * range * range > flat * best_.solution.at.cost) ||
                   h(i, k) * h(i, k) > loosely * loosely * h(i, i) * h(k, k)))
        return true;
    }
    return false;
  }

 private:
  double freedom(std::size_t i) const {
    return std::isnan(u_[i].freedom) ? freedom_ : u_[i].freedom;
  }
  double variance(std::size_t i) const {
    return std::isnan(u_[i].variance) ? variance_ : u_[i].variance;
  }

  const Problem& problem_;
  const FitData<double>& thin_;
  const Fitted& best_;
  const Fitted& fitted_;
  double variance_, share_, freedom_;
  Uncertainty& u_;
};

/// True where a parameter at its bound would lower the cost beyond it by more than noise does.
bool is_pushed(const NormalEquations& e, std::size_t i, double left, double rounding) {
  if (!(e.h(i, i) > 0)) return false;
  const double gain = e.g[i] * e.g[i] / e.h(i, i);
  const double variance = std::max((2 * e.cost - gain) / std::max(left, 1.0), rounding);
  return gain > 3.84 * variance;
}

/// Takes the values of all lobes away, where a fit of the diffuse terms alone raises twice the cost by less than `luck`.
/// Returns that rise; nothing where the lobes keep their values.
std::optional<double> forget_needless_lobes(const Problem& p,
                                            const FitData<double>& thin,
                                            const Fitted& f,
                                            double cost,
                                            double luck,
                                            bool misses,
                                            Uncertainty& u) {
  if (p.start.model.diffuse.empty() || p.start.model.lobes.empty()) return {};
  const Model diffuse = with_lobes(p.start.model, {});
  const Problem rest = with_free(p, diffuse, slots_read(diffuse));
  if (rest.free.size() == p.free.size()) return {};  // its lobes are given
  // Not from the values beside the lobe: a diffuse term that it took to 0 has no logarithm.
  const auto start = find_starts(rest, thin, f.huber)[0].values;
  const double without =
      minimise(rest, thin, {rest.start.model, start, {}}, f.huber).solution.at.cost;
  if (2 * (without - cost) >= luck) return {};
  forget_lobes(p, u, Lobes::whole,
               misses ? "the model misses the table with and without the lobe"
                      : "without the lobe the model meets the table as well");
  return 2 * (without - cost);
}

bool is(const ParameterVerdict& v, ParameterStatus status) {
  return v.status == status;
}

/// Unknowns of a lobe, by the number of the free slot.
std::vector<std::size_t> unknowns_of(const Problem& p, const Lobe& l) {
  std::vector<std::size_t> all;
  for (const auto* t : {&l.ndf, &l.masking, &l.fresnel})
    for (const std::size_t k : t->parameters) {
      const auto& q = p.start.model.parameters[k];
      for (std::size_t s = q.first; s < q.first + q.count; ++s)
        if (p.free.mask()[s]) all.push_back(p.free.index(s));
    }
  return all;
}

}  // namespace

void forget_lobes(const Problem& p, Uncertainty& u, Lobes part, const std::string& why) {
  for (const auto& l : p.start.model.lobes)
    for (const auto* t : {&l.ndf, &l.masking, &l.fresnel}) {
      if (part == Lobes::fresnel && t != &l.fresnel) continue;
      for (const std::size_t k : t->parameters) {
        const auto& q = p.start.model.parameters[k];
        for (std::size_t s = q.first; s < q.first + q.count; ++s) {
          if (p.free.mask()[s]) u[p.free.index(s)].forget(why);
        }
      }
    }
}

bool find_undetermined(const Problem& p,
                       const FitData<double>& thin,
                       const Fitted& f,
                       const SampleCounts& counts,
                       bool widened,
                       Uncertainty& u,
                       std::span<const double> lost_below) {
  const Accumulator<double> accumulate(p.start.model, thin, p.free, f.huber);
  const NormalEquations here = accumulate.normal_equations(f.model.values);
  const std::size_t n = p.free.size();
  if (thin.counts.used == 0) return false;
  const double count =
      static_cast<double>(thin.counts.used) * counts.samples / static_cast<double>(counts.used);
  // Rounding is not evidence: residuals below 1e-7 of what there is to describe.
  const double rounding = 1e-14 * signal(thin, p.start.model.channels) / count;
  const double variance = std::max(2 * here.cost / count, rounding);
  const double share = static_cast<double>(thin.groups) / static_cast<double>(f.groups);
  const double luck = (3.84 + 2 * std::log(counts.samples)) * share;
  const auto costs = accumulate.channel_costs(f.model.values);
  std::vector<bool> had_range(n);  // in which it is known no better: a limit may be
  for (std::size_t i = 0; i < n; ++i)
    had_range[i] = u[i].status == ParameterStatus::not_identifiable && !std::isnan(u[i].freedom);
  for (const auto& q : p.start.model.parameters) {
    std::vector<std::size_t> asked;
    for (std::size_t s = q.first; s < q.first + q.count; ++s)
      if (p.free.mask()[s] &&
          (!q.about->per_channel || u[p.free.index(s)].status == ParameterStatus::at_bound))
        asked.push_back(s);
    if (asked.empty()) continue;
    // All channels' values are moved at once: each changes its own channel's cost alone.
    std::vector<double> most(q.count);
    auto moved = f.model.values;
    for (const double part : places) {
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
      if (2 * most[s - q.first] < luck * variance)
        u[p.free.index(s)].forget("moved over its whole range it changes no more than luck does");
  }

  const auto needless = forget_needless_lobes(p, thin, f, here.cost, luck * variance, widened, u);

  // What is left has a value with an interval, or a limit.
  constexpr std::size_t many = 32;  // unknowns, each of which would take fits of all the others
  if (n > many) return needless.has_value();
  Fitted best = minimise(p, thin, f.model, f.huber);
  best.huber = f.huber;
  const double left = count / share - static_cast<double>(n);
  const Ends ends(p, thin, best, f, variance, share, left, u);
  if (needless) {  // whose light may be the diffuse terms', or not
    const auto diffuse = slots_read(with_lobes(p.start.model, {}));
    for (std::size_t i = 0; i < n; ++i)
      if (diffuse[p.free.slots()[i]]) ends.find_ends(i, *needless);
    return true;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (u[i].status == ParameterStatus::at_bound) {
      if (!p.narrowed[i] && !is_pushed(here, i, count - static_cast<double>(n), rounding))
        ends.find_limit(i, luck * variance, widened);
    } else if (u[i].status == ParameterStatus::not_identifiable && had_range[i]) {
      ends.find_limit(i, luck * variance, widened);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(u[i].std_error) || !std::isnan(u[i].low)) continue;
    const double x = f.model.values[p.free.slots()[i]], width = u[i].t * u[i].std_error;
    constexpr double small = 0.03;  // of the value: no cost bends within so little
    if (ends.is_tied_to_a_limit(i) ||
        (width > small * std::abs(x) && !ends.is_parabola(i, accumulate)))
      ends.find_ends(i);
  }
  const auto leave_out_whole_ranges = [&] {
    using enum ParameterStatus;
    const auto leave_unbounded = [&](std::size_t i) {
      u[i].leave_unbounded("for this model", p.bounds.at_end(i, f.model.values[p.free.slots()[i]]),
                           "the model is too wrong to bound it");
    };
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isnan(u[i].std_error) || u[i].status == ParameterStatus::unbounded) continue;
      const double x = f.model.values[p.free.slots()[i]];
      const double low = u[i].low_end(x), high = u[i].high_end(x);
      const double some = 0.01 * (p.bounds.high[i] - p.bounds.low[i]);
      if (!(low <= p.bounds.low[i] + some && high >= p.bounds.high[i] - some)) continue;
      if (widened) {  // by what the model cannot describe: of this model it is still the best value
        leave_unbounded(i);
        continue;
      }
      u[i].forget("its interval is as wide as its range");
    }
    for (const auto& lobe : p.start.model.lobes) {
      const auto own = unknowns_of(p, lobe);
      if (std::ranges::any_of(own, [&](std::size_t i) { return is(u[i], unbounded); }))
        for (const std::size_t i : own)
          if (is(u[i], free)) leave_unbounded(i);
    }
  };
  leave_out_whole_ranges();
  for (const auto& q : p.start.model.parameters)
    for (std::size_t s = q.first; !lost_below.empty() && s < q.first + q.count; ++s) {
      if (!q.name.starts_with("kd") || !p.free.mask()[s]) continue;
      // One for all channels is known by those that lost nothing.
      const double lost = q.count > 1 ? lost_below[s - q.first] : std::ranges::min(lost_below);
      if (!(lost > 0)) continue;
      const std::size_t i = p.free.index(s);
      const bool is_limit = is(u[i], ParameterStatus::upper_limit);
      const double high = is_limit ? u[i].limit : u[i].high_end(f.model.values[s]);
      const bool at_low =
          is(u[i], ParameterStatus::at_bound) && f.model.values[s] < p.bounds.high[i];
      if (!is(u[i], ParameterStatus::free) && !is_limit && !at_low) continue;
      u[i].keep_limit(
          ParameterStatus::upper_limit,
          std::min((std::isnan(high) ? 0 : high) + std::numbers::pi * lost, p.bounds.high[i]),
          "noise or digits took dark values away: it may be less");
    }
  ends.hold_over_unknowns(luck * variance);
  leave_out_whole_ranges();
  return false;
}

}  // namespace gonio
