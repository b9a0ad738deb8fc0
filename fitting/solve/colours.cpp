#include "fitting/solve/colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "brdf/model/roughness.h"

namespace gonio {
namespace {

/// Nearest that a search comes to an index of 1 and an extinction of 0.
constexpr double beside_one = 1e-3, beside_zero = 1e-2;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A cost that can be compared: infinite where it is none.
double finite(double cost) {
  return std::isfinite(cost) ? cost : infinite;
}

Problem with_shapes_held(const Problem& p) {
  auto mask = p.free.mask();
  for (const auto& q : p.start.model.parameters)
    if (is_shape(q))
      for (std::size_t c = 0; c < q.count; ++c) mask[q.first + c] = false;
  return with_free(p, p.start.model, mask);
}

/// Origins for a descent: 0 of widths, exponents and extinctions, and of indices with an extinction; 1 of
/// other indices; none of a tangent.
std::vector<double> origins_of(const Problem& p) {
  std::vector<double> origins(p.free.size(), std::numeric_limits<double>::quiet_NaN());
  const auto set = [&](const ModelParameter& q, double origin) {
    for (std::size_t s = q.first; s < q.first + q.count; ++s)
      if (p.free.mask()[s]) origins[p.free.index(s)] = origin;
  };
  const Model& m = p.start.model;
  for (const auto& q : m.parameters)
    if (is_shape(q) && &q != m.tangent()) set(q, 0);
  for (const auto& lobe : m.lobes) {
    const bool absorbs = std::ranges::any_of(
        lobe.fresnel.parameters, [&](std::size_t i) { return m.parameters[i].about->name == "k"; });
    for (const std::size_t i : lobe.fresnel.parameters)
      if (const auto& q = m.parameters[i]; q.about->name == "k" || q.about->name == "eta")
        set(q, absorbs ? 0 : 1);
  }
  return origins;
}

/// From a place, inside bounds that may be narrower than the problem's.
template <class F>
Start descended_inside(const Accumulator<F>& accumulate,
                       const Problem& p,
                       const Bounds& bounds,
                       std::vector<double> values,
                       const DescentOptions& o) {
  const auto evaluate = [&](const std::vector<double>& x) {
    p.free.put(x, values);
    return accumulate.normal_equations(values);
  };
  auto x = p.free.of(values);
  const double cost = finite(descend(evaluate, x, bounds, o, origins_of(p)).cost);
  p.free.put(x, values);
  return {cost, std::move(values)};
}

}  // namespace

bool is_shape(const ModelParameter& q) {
  return is_alpha(q.name) || q.about->name == "gamma" || q.about->name == "tail" ||
         q.about->name == "tangent";
}

void keep_best(std::vector<Start>& starts, std::size_t most) {
  constexpr double same = 1e-4;
  std::ranges::stable_sort(starts, {}, &Start::cost);
  std::vector<Start> kept;
  for (auto& s : starts)
    if (kept.size() < most && (kept.empty() || !(s.cost <= kept.back().cost * (1 + same))))
      kept.push_back(std::move(s));
  starts = std::move(kept);
}

template <class F>
Start descended(const Accumulator<F>& accumulate,
                const Problem& p,
                std::vector<double> values,
                const DescentOptions& o) {
  return descended_inside(accumulate, p, p.bounds, std::move(values), o);
}

Bounds bounds_of_valley(const Problem& p, const std::vector<double>& values) {
  Bounds b = p.bounds;
  const Model& m = p.start.model;
  const auto narrow = [&](const ModelParameter& q, auto&& low_of, auto&& high_of) {
    for (std::size_t s = q.first; s < q.first + q.count; ++s) {
      if (!p.free.mask()[s]) continue;
      const std::size_t i = p.free.index(s);
      const double low = std::max(b.low[i], low_of(values[s])),
                   high = std::min(b.high[i], high_of(values[s]));
      if (low <= high) {
        b.low[i] = low;
        b.high[i] = high;
      }
    }
  };
  for (const auto& lobe : m.lobes) {
    const ModelParameter *eta = nullptr, *k = nullptr;
    for (const std::size_t i : lobe.fresnel.parameters) {
      const auto& q = m.parameters[i];
      if (q.about->name == "eta") eta = &q;
      if (q.about->name == "k") k = &q;
    }
    if (k)
      narrow(
          *k, [](double v) { return v > 0 ? beside_zero : 0; },
          [](double v) { return v > 0 ? infinite : 0; });
    else if (eta)
      narrow(
          *eta, [](double v) { return v > 1 ? 1 + beside_one : -infinite; },
          [](double v) { return v > 1 ? infinite : 1 - beside_one; });
  }
  return b;
}

template <class F>
Start descended_in_valley(const Accumulator<F>& accumulate,
                          const Problem& p,
                          std::vector<double> values,
                          const DescentOptions& o) {
  const Bounds bounds = bounds_of_valley(p, values);
  Start s = descended_inside(accumulate, p, bounds, std::move(values), o);
  return descended(accumulate, p, std::move(s.values), o);
}

template <class F>
Colours<F>::Colours(const Problem& p, const FitData<F>& data, double huber)
    : held_(with_shapes_held(p)), accumulate_(held_.start.model, data, held_.free, huber) {
  for (const auto& l : held_.start.model.lobes) lobes_.push_back(lobe_of(l.fresnel));
}

template <class F>
typename Colours<F>::Lobe Colours<F>::lobe_of(const TermUse& fresnel) const {
  static constexpr std::array reflectances{0.02, 0.06, 0.2, 0.6, 0.95};
  static constexpr std::array indices{1.1, 1.35, 1.8, 3.0, 7.0, 0.97, 0.6};
  static constexpr std::array extinctions{0.3, 1.0, 3.0, 8.0};
  static constexpr std::array<std::pair<double, double>, 8> metals{
      {{1.5, 0.2}, {1.3, 1}, {0.2, 3}, {1.5, 4}, {4, 3}, {0.6, 0.2}, {7, 1}, {2, 10}}};
  static constexpr std::array<std::pair<double, double>, 6> workflows{
      {{0.1, 0.05}, {0.5, 0.05}, {0.3, 0.5}, {0.8, 0.5}, {0.3, 0.95}, {0.9, 0.95}}};
  constexpr Range anything{-infinite, infinite};
  const auto side = [&](double eta) {
    return eta > 1 ? Range{1 + beside_one, infinite} : Range{-infinite, 1 - beside_one};
  };
  constexpr Range absorbing{beside_zero, infinite};
  const ModelParameter *f0 = nullptr, *eta = nullptr, *k = nullptr, *base = nullptr,
                       *metallic = nullptr;
  std::size_t i_f0 = 0, i_eta = 0, i_k = 0, i_base = 0, i_metallic = 0;
  for (const std::size_t i : fresnel.parameters) {
    const auto& q = held_.start.model.parameters[i];
    if (!held_.free.mask()[q.first]) continue;
    if (q.about->name == "f0") f0 = &q, i_f0 = i;
    if (q.about->name == "eta") eta = &q, i_eta = i;
    if (q.about->name == "k") k = &q, i_k = i;
    if (q.about->name == "base_color") base = &q, i_base = i;
    if (q.about->name == "metallic") metallic = &q, i_metallic = i;
  }
  Lobe lobe;
  if (eta && k) {
    for (const auto& [n, extinction] : metals)
      lobe.looks.push_back({{{i_eta, n, anything}, {i_k, extinction, absorbing}}});
    for (const double n : {0.7, 0.97, 1.3, 4.0})
      lobe.looks.push_back({{{i_eta, n, side(n)}, {i_k, 0, {0, 0}}}, true});
  } else if (eta)
    for (const double n : indices) lobe.looks.push_back({{{i_eta, n, side(n)}}});
  else if (k)
    for (const double extinction : extinctions)
      lobe.looks.push_back({{{i_k, extinction, absorbing}}});
  else if (f0)
    for (const double r : reflectances) lobe.looks.push_back({{{i_f0, r, anything}}});
  else if (base && metallic)
    for (const auto& [colour, metal] : workflows)
      lobe.looks.push_back({{{i_base, colour, anything}, {i_metallic, metal, anything}}});
  else if (metallic)
    for (const double metal : {0.05, 0.5, 0.95})
      lobe.looks.push_back({{{i_metallic, metal, anything}}});
  // Those that lie outside the bounds of some channel are none.
  std::erase_if(lobe.looks, [&](const Look& look) {
    return std::ranges::any_of(look.places, [&](const Place& at) {
      const auto& q = held_.start.model.parameters[at.parameter];
      for (std::size_t c = 0; c < q.count; ++c) {
        const std::size_t i = held_.free.index(q.first + c);
        if (at.valley.high < held_.bounds.low[i] || at.valley.low > held_.bounds.high[i])
          return true;
      }
      return false;
    });
  });
  const std::size_t channels = held_.start.model.channels;
  lobe.has_valleys = eta || k || metallic;
  lobe.apart = (eta || k) && channels > 1 && (!eta || eta->count == channels) &&
               (!k || k->count == channels);
  return lobe;
}

template <class F>
bool Colours<F>::has_valleys() const {
  return std::ranges::any_of(lobes_, &Lobe::has_valleys);
}

template <class F>
void Colours<F>::set(const Look& look,
                     std::size_t channel,
                     std::vector<double>& values,
                     Bounds& bounds) const {
  for (const auto& [parameter, value, valley] : look.places) {
    const std::size_t s = held_.start.model.parameters[parameter].slot(channel);
    const std::size_t i = held_.free.index(s);
    const double low = std::max(held_.bounds.low[i], valley.low),
                 high = std::min(held_.bounds.high[i], valley.high);
    bounds.low[i] = low;
    bounds.high[i] = high;
    values[s] = std::clamp(value, low, high);
  }
}

template <class F>
std::vector<double> Colours<F>::channel_costs(const Lobe& lobe,
                                              const std::vector<double>& values) const {
  if (lobe.apart) {
    auto costs = accumulate_.channel_costs(values);
    for (double& c : costs) c = finite(c);
    return costs;
  }
  return std::vector<double>(held_.start.model.channels,
                             finite(accumulate_.normal_equations(values).cost));
}

template <class F>
Start Colours<F>::from(std::vector<double> values, const DescentOptions& o) const {
  return descended(accumulate_, held_, std::move(values), o);
}

template <class F>
Start Colours<F>::from_best_valley(std::vector<double> values,
                                   std::size_t number,
                                   const DescentOptions& o) const {
  const Lobe& lobe = lobes_[number];
  if (lobe.looks.empty()) return from(std::move(values), o);
  const std::size_t channels = held_.start.model.channels;
  std::vector<double> least(channels, infinite);
  std::vector<const Look*> best(channels, &lobe.looks.front());
  Bounds bounds = held_.bounds;
  auto tried = values;
  for (const Look& look : lobe.looks) {
    if (look.at_saddle) continue;
    for (std::size_t c = 0; c < channels; ++c) set(look, c, tried, bounds);
    const auto costs = channel_costs(lobe, tried);
    for (std::size_t c = 0; c < channels; ++c)
      if (costs[c] < least[c]) {
        least[c] = costs[c];
        best[c] = &look;
      }
  }
  for (std::size_t c = 0; c < channels; ++c) set(*best[c], c, values, bounds);
  return descended_inside(accumulate_, held_, bounds, std::move(values), o);
}

template <class F>
Start Colours<F>::in_valley(const Look& look,
                            std::vector<double> values,
                            const DescentOptions& o) const {
  Bounds bounds = held_.bounds;
  for (std::size_t c = 0; c < held_.start.model.channels; ++c) set(look, c, values, bounds);
  return descended_inside(accumulate_, held_, bounds, std::move(values), o);
}

template <class F>
void Colours<F>::take(std::size_t channel,
                      const std::vector<double>& from,
                      std::vector<double>& to) const {
  for (const auto& q : held_.start.model.parameters)
    if (q.count > 1) to[q.slot(channel)] = from[q.slot(channel)];
}

template <class F>
Start Colours<F>::from_every_valley(std::vector<double> values, const DescentOptions& o) const {
  Start best = from(std::move(values), o);
  for (const Lobe& lobe : lobes_) {
    if (!lobe.has_valleys) continue;
    const Start before = best;
    auto least = channel_costs(lobe, best.values);
    for (const Look& look : lobe.looks) {
      const Start end = in_valley(look, before.values, o);
      if (!lobe.apart) {
        if (end.cost < best.cost) best = end;
        continue;
      }
      const auto costs = channel_costs(lobe, end.values);
      for (std::size_t c = 0; c < costs.size(); ++c) {
        if (!(costs[c] < least[c])) continue;
        least[c] = costs[c];
        take(c, end.values, best.values);
      }
    }
    if (lobe.apart) best.cost = finite(accumulate_.normal_equations(best.values).cost);
    if (!(best.cost <= before.cost)) best = before;  // where channels share a value that moved
  }
  return best;
}

template <class F>
std::vector<Start> Colours<F>::other_valleys(const Start& place,
                                             const DescentOptions& o,
                                             double worth,
                                             std::size_t most) const {
  struct Bottom {
    double cost;
    const Start* end;
    std::optional<std::size_t> channel;  // that alone goes there
  };
  std::vector<Bottom> bottoms;
  std::deque<Start> ends;
  for (const Lobe& lobe : lobes_) {
    if (!lobe.has_valleys) continue;
    const auto stay = lobe.apart ? channel_costs(lobe, place.values) : std::vector<double>();
    const double whole = std::accumulate(stay.begin(), stay.end(), 0.0);
    for (const Look& look : lobe.looks) {
      Start& end = ends.emplace_back(in_valley(look, place.values, o));
      if (!lobe.apart) {
        bottoms.push_back({end.cost, &end, {}});
        continue;
      }
      // Channels share no colour that is taken: what one costs there does not depend on the others.
      auto all = place.values;
      for (std::size_t c = 0; c < stay.size(); ++c) take(c, end.values, all);
      const auto go = channel_costs(lobe, all);
      for (std::size_t c = 0; c < stay.size(); ++c)
        bottoms.push_back({finite(whole - stay[c] + go[c]), &end, c});
    }
  }
  std::erase_if(bottoms, [&](const Bottom& b) { return !(b.cost <= place.cost * (1 + worth)); });
  if (bottoms.size() > most) {
    std::ranges::stable_sort(bottoms, {}, &Bottom::cost);
    bottoms.resize(most);
  }
  std::vector<Start> others;
  for (const auto& [cost, end, channel] : bottoms) {
    Start& one = others.emplace_back(channel ? place : *end);
    if (channel) take(*channel, end->values, one.values);
    one.cost = cost;
  }
  return others;
}

template Start descended(const Accumulator<float>&,
                         const Problem&,
                         std::vector<double>,
                         const DescentOptions&);
template Start descended(const Accumulator<double>&,
                         const Problem&,
                         std::vector<double>,
                         const DescentOptions&);
template Start descended_in_valley(const Accumulator<float>&,
                                   const Problem&,
                                   std::vector<double>,
                                   const DescentOptions&);
template Start descended_in_valley(const Accumulator<double>&,
                                   const Problem&,
                                   std::vector<double>,
                                   const DescentOptions&);
template class Colours<float>;
template class Colours<double>;

}  // namespace gonio
