#include "fitting/solve/order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "brdf/catalogue/registry.h"
#include "brdf/model/roughness.h"

namespace gonio {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  ///< of parameters

/// Values that change places, and what they are called afterwards.
class Order {
 public:
  explicit Order(const Problem& p)
      : problem_(p), from_(p.start.model.value_count), notes_(p.free.size()) {
    std::iota(from_.begin(), from_.end(), std::size_t{0});
  }

  /// True where a fit knows no difference between the two of each pair.
  bool are_alike(const Pairs& pairs) const {
    return std::ranges::all_of(pairs, [&](const auto& pair) {
      const auto &a = parameter(pair.first), &b = parameter(pair.second);
      if (a.count != b.count) return false;
      for (std::size_t c = 0; c < a.count; ++c)
        if (!are_alike(a.first + c, b.first + c)) return false;
      return true;
    });
  }
  void exchange(const Pairs& pairs) {
    for (const auto& [a, b] : pairs)
      for (std::size_t c = 0; c < parameter(a).count; ++c)
        std::swap(from_[parameter(a).first + c], from_[parameter(b).first + c]);
  }
  void note(std::size_t parameter_index, const char* why) {
    notes_[problem_.free.index(parameter(parameter_index).first)] = why;
  }
  /// Slot that a slot's value comes from.
  std::size_t from(std::size_t slot) const { return from_[slot]; }
  const ModelParameter& parameter(std::size_t k) const {
    return problem_.start.model.parameters[k];
  }
  bool is_free(std::size_t k) const { return problem_.free.mask()[parameter(k).first]; }
  const std::vector<std::string>& notes() const { return notes_; }

  void apply_to(Fitted& f) const {
    const auto values = f.model.values;
    for (std::size_t s = 0; s < from_.size(); ++s) f.model.values[s] = values[from_[s]];
    const FreeSlots& free = problem_.free;
    NormalEquations& e = f.solution.at;
    if (e.g.size() != free.size()) return;
    std::vector<std::size_t> unknown;
    for (const std::size_t s : free.slots()) unknown.push_back(free.index(from_[s]));
    const NormalEquations old = e;
    e.h = ArrowMatrix(old.h.shared_layout());
    for (std::size_t i = 0; i < free.size(); ++i) {
      e.g[i] = old.g[unknown[i]];
      for (std::size_t j = i; j < free.size(); ++j)
        if (e.h.layout().at(i, j) != ArrowLayout::none)
          e.h.add(i, j, old.h(unknown[i], unknown[j]));
    }
  }

 private:
  bool are_alike(std::size_t a, std::size_t b) const {
    const auto& p = problem_;
    if (p.free.mask()[a] != p.free.mask()[b]) return false;
    if (!p.free.mask()[a]) return p.start.values[a] == p.start.values[b];
    const std::size_t i = p.free.index(a), j = p.free.index(b);
    return p.bounds.low[i] == p.bounds.low[j] && p.bounds.high[i] == p.bounds.high[j];
  }

  const Problem& problem_;
  std::vector<std::size_t> from_;
  std::vector<std::string> notes_;
};

/// Parameters of one lobe beside those of another of the same terms; those that they share are left out.
Pairs parameters_of(const Lobe& a, const Lobe& b) {
  Pairs pairs;
  for (const auto part : {&Lobe::ndf, &Lobe::masking, &Lobe::fresnel})
    for (std::size_t k = 0; k < (a.*part).parameters.size(); ++k) {
      const std::pair pair((a.*part).parameters[k], (b.*part).parameters[k]);
      if (pair.first != pair.second && std::ranges::find(pairs, pair) == pairs.end())
        pairs.push_back(pair);
    }
  return pairs;
}

/// The lobe's first width that is free.
std::optional<std::size_t> width_of(const Order& o, const Lobe& l) {
  for (const std::size_t k : l.ndf.parameters)
    if (is_alpha(o.parameter(k).name) && o.is_free(k)) return k;
  return {};
}

void order_lobes(const Model& m, const std::vector<double>& values, Order& order) {
  const bool is_first_coupled =
      std::ranges::any_of(m.diffuse, [](const TermUse& t) { return catalogue()[t.term].coupled; });
  const auto width = [&](const Lobe& l) {  // the wider one, whichever of two that is
    double widest = 0;
    for (const std::size_t k : l.ndf.parameters)
      if (is_alpha(order.parameter(k).name))
        widest = std::max(widest, values[order.from(order.parameter(k).first)]);
    return widest;
  };
  for (std::size_t end = m.lobes.size(); end > 1; --end)
    for (std::size_t b = 1; b < m.lobes.size(); ++b)
      for (std::size_t a = is_first_coupled; a < b; ++a) {
        const Lobe &first = m.lobes[a], &second = m.lobes[b];
        if (!are_alike(first, second) || !width_of(order, first)) continue;
        const Pairs pairs = parameters_of(first, second);
        if (!order.are_alike(pairs)) continue;
        order.note(*width_of(order, second), "lobes of like terms stand in the order of alpha");
        if (width(second) < width(first)) order.exchange(pairs);
      }
}

/// Widths along the tangent beside those along the bitangent, of all lobes; none where something forbids to exchange them.
Pairs widths_of(const Model& m, const Order& order) {
  Pairs pairs;
  for (const TermUse* t : terms_of(m)) {
    if (!catalogue()[t->term].anisotropic) continue;
    const auto find = [&](std::string_view name) {
      return std::ranges::find(t->parameters, name,
                               [&](std::size_t k) { return order.parameter(k).about->name; });
    };
    const auto x = find("alpha_x"), y = find("alpha_y");
    if (x == t->parameters.end() || y == t->parameters.end()) return {};
    if (const std::pair pair(*x, *y); std::ranges::find(pairs, pair) == pairs.end())
      pairs.push_back(pair);
  }
  const bool are_free =
      std::ranges::all_of(pairs, [&](const auto& p) { return order.is_free(p.first); });
  return are_free && order.are_alike(pairs) ? pairs : Pairs{};
}

constexpr double quarter_turn = 90;  // [°]

/// Order of values, and the tangent afterwards; none where it stays as it is.
std::pair<Order, std::optional<double>> order_of(const Problem& p,
                                                 const std::vector<double>& values) {
  constexpr double lowest = -45, half_turn = 2 * quarter_turn;
  const Model& m = p.start.model;
  Order order(p);
  order_lobes(m, values, order);
  const auto* const tangent = m.tangent();
  const bool is_free = tangent && p.free.mask()[tangent->first];
  if (!is_free || p.narrowed[p.free.index(tangent->first)]) return {std::move(order), {}};
  const auto value = [&](std::size_t k) { return values[order.from(order.parameter(k).first)]; };
  const Pairs widths = widths_of(m, order);
  const bool turns = !widths.empty() && value(widths[0].first) < value(widths[0].second);
  if (turns) order.exchange(widths);
  double t = values[tangent->first];
  if (turns) t += quarter_turn;
  t -= half_turn * std::floor((t - lowest) / half_turn);
  order.note(static_cast<std::size_t>(tangent - m.parameters.data()),
             widths.empty() ? "the same half a turn further"
                            : "of the wider width; the same half a turn further");
  return {std::move(order), t};
}

}  // namespace

std::vector<std::string> put_in_order(Problem& p, Fitted& f) {
  const Model& m = p.start.model;
  const auto [order, tangent] = order_of(p, f.model.values);
  order.apply_to(f);
  if (tangent) {
    const std::size_t slot = m.tangent()->first, i = p.free.index(slot);
    f.model.values[slot] = *tangent;
    p.bounds.low[i] = *tangent - quarter_turn;
    p.bounds.high[i] = *tangent + quarter_turn;
  }
  return order.notes();
}

std::vector<std::size_t> put_in_order(const Problem& p, std::vector<double>& values) {
  const auto [order, tangent] = order_of(p, values);
  const auto old = values;
  std::vector<std::size_t> from;
  for (std::size_t s = 0; s < values.size(); ++s) {
    from.push_back(order.from(s));
    values[s] = old[from[s]];
  }
  if (tangent) values[p.start.model.tangent()->first] = *tangent;
  return from;
}

}  // namespace gonio
