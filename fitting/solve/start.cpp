#include "fitting/solve/start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>

#include "base/quantile.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/roughness.h"

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

Range bounds_of(const Problem& p, const ModelParameter& q) {
  const std::size_t i = p.free.index(q.first);
  return {p.bounds.low[i], p.bounds.high[i]};
}

/// Rungs of a ladder that lie inside; where these are few, as many more spread evenly by ratio, from 0 evenly.
std::vector<double> rungs_inside(std::span<const double> ladder, const Range& range) {
  constexpr std::size_t few = 4;
  std::vector<double> inside;
  for (const double x : ladder)
    if (x >= range.low && x <= range.high) inside.push_back(x);
  if (inside.size() >= few) return inside;
  inside.clear();
  for (std::size_t k = 0; k < few; ++k) {
    const double part = (0.5 + static_cast<double>(k)) / few;
    inside.push_back(range.low > 0 ? range.low * std::pow(range.high / range.low, part)
                                   : range.low + part * (range.high - range.low));
  }
  return inside;
}

/// A shape's parameter and the values to try.
struct Axis {
  std::size_t parameter;
  std::vector<double> at;
};

std::size_t cells_of(const std::vector<Axis>& axes) {
  std::size_t cells = 1;
  for (const auto& a : axes) cells *= a.at.size();
  return cells;
}

/// Those of the free shapes of a lobe that no earlier one shares.
std::vector<Axis> axes_of(const Problem& p, const Lobe& lobe, const std::vector<bool>& before) {
  static constexpr std::array widths{0.001, 0.003, 0.01, 0.03, 0.07, 0.15, 0.3, 0.5, 0.8};
  static constexpr std::array exponents{0.7, 1.3, 2.0, 3.5, 8.0}, tails{0.0, 0.2, 0.5, 1.0, 1.3};
  static constexpr std::array tangents{0.0, 30.0, 60.0, 90.0, 120.0, 150.0};
  const Model& m = p.start.model;
  std::vector<Axis> axes;
  std::vector<bool> seen(p.start.model.parameters.size());
  for (const auto* t : {&lobe.ndf, &lobe.masking})
    for (const std::size_t k : t->parameters) {
      const auto& q = p.start.model.parameters[k];
      if (seen[k] || before[q.first] || !is_free(p, q)) continue;
      seen[k] = true;
      const std::span<const double> ladder = is_alpha(q.name) ? std::span<const double>(widths)
                                             : q.about->name == "tail"
                                                 ? std::span<const double>(tails)
                                                 : std::span<const double>(exponents);
      axes.push_back({k, rungs_inside(ladder, bounds_of(p, q))});
    }
  const bool turned =
      catalogue()[lobe.ndf.term].anisotropic || catalogue()[lobe.masking.term].anisotropic;
  if (const auto* t = m.tangent(); turned && !before[t->first] && is_free(p, *t))
    axes.push_back({static_cast<std::size_t>(t - m.parameters.data()),
                    rungs_inside(tangents, bounds_of(p, *t))});
  // Of many axes every second rung of the longest has to do.
  constexpr std::size_t most_cells = 1000;
  while (cells_of(axes) > most_cells) {
    auto& rungs = std::ranges::max_element(axes, {}, [](const Axis& a) { return a.at.size(); })->at;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < rungs.size(); k += 2) rungs[kept++] = rungs[k];
    rungs.resize(kept);
  }
  return axes;
}

/// Steps of a cell along each axis.
std::vector<std::size_t> steps_of(const std::vector<Axis>& axes, std::size_t cell) {
  std::vector<std::size_t> steps;
  for (const auto& a : axes) {
    steps.push_back(cell % a.at.size());
    cell /= a.at.size();
  }
  return steps;
}

/// True of a cell that another one repeats: widths exchanged are a tangent a quarter turn further, and equal ones have none.
bool repeats_another(const Model& m,
                     const std::vector<Axis>& axes,
                     std::span<const std::size_t> steps) {
  std::optional<double> x, y;
  std::optional<std::size_t> turn;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const auto name = m.parameters[axes[k].parameter].about->name;
    if (name == "alpha_x") x = axes[k].at[steps[k]];
    if (name == "alpha_y") y = axes[k].at[steps[k]];
    if (name == "tangent") turn = steps[k];
  }
  return x && y && turn && (*x < *y || (*x == *y && *turn > 0));
}

bool are_neighbours(std::span<const std::size_t> x, std::span<const std::size_t> y) {
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] > y[k] + 1 || y[k] > x[k] + 1) return false;
  return true;
}

/// The cells that no neighbour is below, the best first, then the best of the rest: at most so many.
std::vector<std::size_t> best_cells(const std::vector<Axis>& axes,
                                    const std::vector<Start>& cells,
                                    std::size_t most) {
  std::vector<std::size_t> order(cells.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return cells[i].cost; });
  std::vector<bool> is_lowest(cells.size(), true);
  std::vector<std::vector<std::size_t>> steps;
  for (std::size_t i = 0; i < cells.size(); ++i) steps.push_back(steps_of(axes, i));
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (are_neighbours(steps[i], steps[j]))
        is_lowest[cells[i].cost < cells[j].cost ? j : i] = false;
  std::ranges::stable_partition(order, [&](std::size_t i) { return is_lowest[i]; });
  std::erase_if(order, [&](std::size_t i) { return cells[i].values.empty(); });
  order.resize(std::min(order.size(), most));
  return order;
}

/// Starts of a model that a lobe has just joined.
/// \param lobe  by its number   \param before  slots that the model without it reads   \param from  starts of that model
template <class F>
std::vector<Start> join(const Problem& p,
                        std::size_t lobe,
                        const FitData<F>& thin,
                        double huber,
                        const std::vector<bool>& before,
                        const std::vector<Start>& from) {
  constexpr std::size_t most_cells = 4, kept = 4;
  constexpr DescentOptions closely{40, 1e-5};
  constexpr double worth_a_descent = 0.2;
  const Model& m = p.start.model;
  const auto axes = axes_of(p, m.lobes[lobe], before);
  const Colours<F> colours(p, thin, huber);
  const Accumulator<F> whole(m, thin, p.free, huber);
  std::vector<Start> starts;
  for (const Start& base : from) {
    std::vector<Start> cells(cells_of(axes));
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      auto values = base.values;
      const auto steps = steps_of(axes, i);
      if (repeats_another(m, axes, steps)) {
        cells[i].cost = std::numeric_limits<double>::infinity();
        return;
      }
      for (std::size_t k = 0; k < axes.size(); ++k)
        values[m.parameters[axes[k].parameter].first] = axes[k].at[steps[k]];
      cells[i] = colours.from_best_valley(std::move(values), lobe, {4, 1e-3});
    });
    const auto best = best_cells(axes, cells, most_cells);
    std::vector<Start> ends(best.size());
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t k) {
      ends[k] = descended_in_valley(whole, p, cells[best[k]].values, closely);
    });
    for (auto& e : ends) starts.push_back(std::move(e));
    if (!colours.has_valleys()) continue;
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t k) {
      ends[k] = colours.from_every_valley(cells[best[k]].values, {8, 1e-3});
      ends[k] = descended_in_valley(whole, p, ends[k].values, closely);
    });
    for (auto& e : ends) starts.push_back(std::move(e));
  }
  keep_best(starts, kept);
  if (!colours.has_valleys()) return starts;
  // With these shapes, which are none of the grid's, another valley may be the better one.
  std::vector<Start> others;
  for (const Start& s : starts) {
    auto of_one = colours.other_valleys(s, {12, 1e-5}, worth_a_descent);
    keep_best(of_one, most_cells);
    for (auto& o : of_one) others.push_back(std::move(o));
  }
  tbb::parallel_for(std::size_t{0}, others.size(), [&](std::size_t k) {
    others[k] = descended_in_valley(whole, p, others[k].values, closely);
  });
  for (auto& o : others) starts.push_back(std::move(o));
  keep_best(starts, kept);
  return starts;
}

/// A person's own function says nothing of its parameters: starts all over their bounds, by ratio where these span decades; of
/// the catalogue's diffuse terms the one given.
std::vector<std::vector<double>> spread_starts(const Problem& p, std::vector<double> first) {
  std::vector<std::vector<double>> all{first};
  const Model& m = p.start.model;
  if (m.diffuse.empty() || !foreign_term(m.diffuse[0].term)) return all;
  constexpr std::size_t starts = 24,
                        primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59};
  for (std::size_t k = 1; k < starts; ++k) {
    auto values = first;
    for (std::size_t q = 0; q < m.parameters.size(); ++q) {
      const auto& parameter = m.parameters[q];
      if (!is_free(p, parameter)) continue;
      double part = 0, digit = 1;
      for (std::size_t n = k, base = primes[q % std::size(primes)]; n > 0; n /= base) {
        digit /= static_cast<double>(base);
        part += digit * static_cast<double>(n % base);  // Halton's sequence
      }
      const auto [low, high] = bounds_of(p, parameter);
      const double v =
          low > 0 && high > 20 * low ? low * std::pow(high / low, part) : low + part * (high - low);
      for (std::size_t c = 0; c < parameter.count; ++c)
        if (p.free.mask()[parameter.first + c]) values[parameter.first + c] = v;
    }
    all.push_back(std::move(values));
  }
  return all;
}

/// Orders in which the lobes join: each may be the last one, where it is not like the others.
std::vector<std::vector<std::size_t>> orders_of(const Model& m) {
  std::vector<std::size_t> in_order(m.lobes.size());
  for (std::size_t l = 0; l < in_order.size(); ++l) in_order[l] = l;
  std::vector<std::vector<std::size_t>> orders{in_order};
  if (m.lobes.size() < 2) return orders;
  if (are_alike(m.lobes.front(), m.lobes.back())) return orders;
  std::ranges::reverse(in_order);
  orders.push_back(in_order);
  return orders;
}

}  // namespace

template <class F>
std::vector<Start> find_starts(const Problem& p, const FitData<F>& thin, double huber) {
  constexpr std::size_t kept = 4;
  const Model& m = p.start.model;
  auto first = p.start.values;
  for (const auto& q : m.parameters)
    if (q.about->name == "kd" || q.about->name == "base_color")
      for (std::size_t c = 0; c < q.count; ++c)
        if (p.free.mask()[q.first + c])
          first[q.first + c] = std::clamp(std::numbers::pi * dim(thin, c), 1e-3, 0.95);
  if (m.lobes.empty()) {
    const Accumulator<F> accumulate(m, thin, p.free, huber);
    auto from = spread_starts(p, std::move(first));
    std::vector<Start> ends(from.size());
    tbb::parallel_for(std::size_t{0}, from.size(), [&](std::size_t k) {
      ends[k] = descended(accumulate, p, std::move(from[k]), {40, 1e-5});
    });
    keep_best(ends, kept);
    return ends;
  }
  std::vector<Start> starts;
  for (const auto& order : orders_of(m)) {
    std::vector<Start> from{{0, first}};
    std::vector<bool> before(m.value_count);
    for (std::size_t l = 1; l <= order.size(); ++l) {
      const bool whole = l == order.size();
      const Model part = whole ? m : with_lobes(m, std::span(order).first(l));
      const auto read = slots_read(part);
      from =
          join(with_free(p, part, read), whole ? order[l - 1] : l - 1, thin, huber, before, from);
      before = read;
    }
    for (auto& s : from) starts.push_back(std::move(s));
  }
  keep_best(starts, kept);
  return starts;
}

template std::vector<Start> find_starts(const Problem&, const FitData<float>&, double);
template std::vector<Start> find_starts(const Problem&, const FitData<double>&, double);

}  // namespace gonio
