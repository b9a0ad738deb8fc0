#include "stability/regroup.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/random.h"
#include "stability/evaluate.h"
#include "stability/value_over.h"

#include <fmt/format.h>

namespace gonio::stability {
namespace {

using Kind = Trace::Kind;

/// Part of a sum or a product: of a sum `other` means subtracted, of a product that it divides.
struct Part {
  int node;
  bool other;
};

bool is_sum(Kind k) {
  return k == Kind::add || k == Kind::subtract || k == Kind::negate;
}
bool is_product(Kind k) {
  return k == Kind::multiply || k == Kind::divide;
}

class Regrouper {
 public:
  Regrouper(const Graph& graph, std::uint64_t seed)
      : from_(graph.trace), draws_(seed), made_(from_.nodes().size(), -1) {
    for (std::size_t k = 0; k < made_.size(); ++k)
      if (from_.nodes()[k].kind == Kind::input) made_[k] = to_.trace.input(from_.nodes()[k].name);
    uses_.resize(made_.size());
    for (const auto& n : from_.nodes())
      for (const int of : n.of)
        if (of >= 0) ++uses_[static_cast<std::size_t>(of)];
    to_.value = make(graph.value);
  }
  Graph take() { return std::move(to_); }

 private:
  bool coin() { return draws_.uniform() < 0.5; }

  int make(int k) {
    if (int& at = made_[static_cast<std::size_t>(k)]; at < 0) {
      const auto& n = from_[k];
      const int made = n.kind == Kind::constant ? to_.trace.constant(n.value)
                       : is_sum(n.kind)         ? joined(k, is_sum)
                       : is_product(n.kind)     ? joined(k, is_product)
                                                : copied(n);
      at = made;
    }
    return made_[static_cast<std::size_t>(k)];
  }
  int copied(const Trace::Node& n) {
    Trace::Operands of{-1, -1, -1};
    for (std::size_t i = 0; i < of.size(); ++i)
      if (n.of[i] >= 0) of[i] = make(n.of[i]);
    return to_.trace.operation(n.kind, of);
  }

  /// Parts of a sum of sums, or of a product of products.  What is used elsewhere, too, may be computed twice.
  void gather(int k, bool other, bool (*same)(Kind), std::vector<Part>& parts) {
    constexpr std::size_t most = 32;
    const auto& n = from_[k];
    for (std::size_t i = 0; i < 2 && n.of[i] >= 0; ++i) {
      const bool turned = n.kind == Kind::negate ||
                          (i == 1 && (n.kind == Kind::subtract || n.kind == Kind::divide));
      const int of = n.of[i];
      if (same(from_[of].kind) && parts.size() < most &&
          (uses_[static_cast<std::size_t>(of)] == 1 || coin()))
        gather(of, other != turned, same, parts);
      else
        parts.push_back({make(of), other != turned});
    }
  }
  int joined(int k, bool (*same)(Kind)) {
    std::vector<Part> parts;
    gather(k, false, same, parts);
    const bool sums = same == is_sum;
    while (parts.size() > 1) {
      const Part a = drawn(parts), b = drawn(parts);
      parts.push_back(sums ? sum(a, b) : product(a, b));
    }
    const auto [node, other] = parts[0];
    if (!other) return node;
    return sums ? to_.trace.operation(Kind::negate, {node, -1, -1}) : inverse(node);
  }
  /// One of the parts, which it is taken from.
  Part drawn(std::vector<Part>& parts) {
    const auto n = static_cast<double>(parts.size());
    const auto at = std::min(static_cast<std::size_t>(draws_.uniform() * n), parts.size() - 1);
    std::swap(parts[at], parts.back());
    const Part p = parts.back();
    parts.pop_back();
    return p;
  }
  Part sum(Part a, Part b) {
    if (a.other == b.other) return {to_.trace.operation(Kind::add, {a.node, b.node, -1}), a.other};
    if (a.other) std::swap(a, b);
    return {to_.trace.operation(Kind::subtract, {a.node, b.node, -1}), false};
  }
  Part product(Part a, Part b) {
    if (a.other == b.other)
      return {to_.trace.operation(Kind::multiply, {a.node, b.node, -1}), a.other};
    if (a.other) std::swap(a, b);
    if (coin()) return {to_.trace.operation(Kind::divide, {a.node, b.node, -1}), false};
    return {to_.trace.operation(Kind::multiply, {a.node, inverse(b.node), -1}), false};
  }
  int inverse(int node) {
    return to_.trace.operation(Kind::divide, {to_.trace.constant(1), node, -1});
  }

  const Trace& from_;
  Draws draws_;
  std::vector<int> made_;  ///< node of the new graph, −1: none yet
  std::vector<std::size_t> uses_;
  Graph to_;
};

template <class F>
Graph graph_of(const Subject& s) {
  Graph g;
  const Trace::Recording recording(g.trace);
  std::vector<Traced<F>> inputs;
  for (const auto& input : s.inputs) inputs.push_back(Traced<F>::input(input.name));
  g.value = value_over<Traced<F>>(s, inputs).node();
  return g;
}

/// Inputs of a domain: towards either end in logarithms of the distance, or anywhere.
std::vector<double> drawn_inputs(const Subject& s, Number number, std::uint64_t row) {
  Draws draws(1, row);
  std::vector<double> x;
  for (std::size_t k = 0; k < s.inputs.size(); ++k) {
    const auto [low, high] = s.inputs[k].domain;
    const double way = draws.uniform(), u = draws.uniform();
    const double even = low + u * (high - low);
    const double near_low = low > 0 ? low * std::pow(high / low, u) : even;
    const double v = way < 1 / 3.0 ? near_low : way < 2 / 3.0 ? low + high - near_low : even;
    x.push_back(std::clamp(v, low, high));
  }
  return rounded(s, number, x);
}

template <class F>
std::optional<Regrouping> looked_at(const Subject& s, Number number, double least) {
  const Graph written = graph_of<F>(s);
  for (const auto& n : written.trace.nodes())
    if (n.kind == Kind::constant && !std::isfinite(n.value)) return {};
  std::vector<Graph> orders;
  for (std::uint64_t seed = 1; seed <= regroupings; ++seed)
    orders.push_back(regrouped(written, seed));
  Regrouping r;
  r.inputs = std::clamp<std::uint64_t>(400'000 / written.trace.nodes().size(), 128, 4096);
  for (std::uint64_t row = 0; row < r.inputs; ++row) {
    const auto x = drawn_inputs(s, number, row);
    const double truth = value_of(s, Number::double_, x);
    if (!std::isfinite(truth)) continue;
    std::vector<F> in;
    for (const double v : x) in.push_back(static_cast<F>(v));
    const auto error = [&](const Graph& g) {
      const auto y = static_cast<double>(replay<F>(g.trace, in)[static_cast<std::size_t>(g.value)]);
      return std::abs(y - truth) / std::max(std::abs(truth), least);
    };
    const double own = error(written);
    if (!std::isfinite(own)) {
      ++r.no_value;
      continue;
    }
    r.written = std::max(r.written, own);
    bool is_lost = false;
    for (const auto& g : orders) {
      const double e = error(g);
      is_lost |= !std::isfinite(e);
      if (std::isfinite(e) && (e > r.regrouped || r.at.empty())) r.regrouped = e, r.at = x;
    }
    r.lost += is_lost;
  }
  return r;
}

}  // namespace

Graph regrouped(const Graph& g, std::uint64_t seed) {
  return Regrouper(g, seed).take();
}

std::optional<Regrouping> regrouping(const Subject& s, Number number) {
  if (number == Number::half) return looked_at<Half>(s, number, 0x1p-14);
  if (number == Number::float_) return looked_at<float>(s, number, 0x1p-64);
  throw wrong_usage(
      fmt::format("{}: orders are looked at in half and float, not in {}", s.id, name_of(number)));
}

}  // namespace gonio::stability
