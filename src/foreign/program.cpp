#include "foreign/program.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace gonio::foreign {
namespace {

std::size_t place(Ref r) {
  return static_cast<std::size_t>(r);
}

bool is_truth(Op op) {
  return op >= Op::less && op <= Op::inverse;
}

/// Copies the nodes that outputs need, one by one and in their order.
struct Copy {
  const Program& of;
  Program& to;
  std::vector<Ref> at;
  std::vector<bool> needed;

  Copy(const Program& from, Program& into, auto&& index)
      : of(from), to(into), at(from.nodes.size(), nothing), needed(from.nodes.size()) {
    to.most_nodes = std::max(of.most_nodes, to.most_nodes);
    for (const Ref o : of.outputs) needed[place(o)] = true;
    for (std::size_t i = of.nodes.size(); i-- > 0;)
      if (needed[i])
        for (const Ref r : {of.nodes[i].a, of.nodes[i].b, of.nodes[i].c})
          if (r >= 0) needed[place(r)] = true;
    for (const auto& i : of.inputs)
      if (needed[place(i.node)])
        at[place(i.node)] = to.input(i.of_sample, i.of_sample ? i.index : index(i.index));
  }
  Copy(const Program& from, Program& into) : Copy(from, into, [](std::size_t k) { return k; }) {}
  void all() {
    for (std::size_t i = 0; i < of.nodes.size(); ++i)
      if (needed[i]) node(i);
    for (const Ref o : of.outputs) to.outputs.push_back(ref(o));
  }
  Ref ref(Ref r) const { return r < 0 ? r : at[place(r)]; }
  void node(std::size_t i) {
    const Node& n = of.nodes[i];
    if (n.op == Op::input) return;
    at[i] = n.op == Op::constant ? to.constant(n.value, n.kind)
                                 : to.make(n.op, ref(n.a), ref(n.b), ref(n.c));
  }
};

/// Derivatives by the chain rule, forwards; what is 0 is left out.
class Slopes {
 public:
  Slopes(const Program& of, std::size_t count, bool turn)
      : of_(of), copy_(of, p_), count_(count), turn_(turn), n_(count + (turn ? 1 : 0)) {
    p_.most_nodes = 2'000'000;
  }
  Program made() {
    d_.resize(of_.nodes.size());
    for (const auto& i : of_.inputs)
      if (!i.of_sample && i.index < count_ && copy_.needed[place(i.node)]) {
        d_[place(i.node)].assign(n_, nothing);
        d_[place(i.node)][i.index] = p_.constant(1);
      }
    if (turn_) turn_frame();
    for (std::size_t i = 0; i < of_.nodes.size(); ++i) {
      if (!copy_.needed[i]) continue;
      copy_.node(i);
      if (of_.nodes[i].kind == Kind::number && of_.nodes[i].a >= 0) differentiate(i);
    }
    for (const Ref o : of_.outputs) {
      p_.outputs.push_back(copy_.ref(o));
      for (std::size_t k = 0; k < n_; ++k) {
        const Ref d = part(o, k);
        p_.outputs.push_back(d < 0 ? p_.constant(0) : d);
      }
    }
    return trimmed(p_);
  }

 private:
  /// x' = y π/180, y' = −x π/180, of h, l and v.
  void turn_frame() {
    for (const auto& i : of_.inputs) {
      if (!i.of_sample || i.index < first_of_frame || !copy_.needed[place(i.node)]) continue;
      const bool is_x = (i.index - first_of_frame) % 2 == 0;
      const Ref other = p_.input(true, is_x ? i.index + 1 : i.index - 1);
      const double degree = std::numbers::pi / 180;
      d_[place(i.node)].assign(n_, nothing);
      d_[place(i.node)][count_] = p_(Op::mul, other, p_.constant(is_x ? degree : -degree));
    }
  }
  bool has(Ref q) const { return q >= 0 && !d_[place(q)].empty(); }
  Ref part(Ref q, std::size_t k) const { return has(q) ? d_[place(q)][k] : nothing; }
  Ref times(Ref u, Ref v) { return u < 0 || v < 0 ? nothing : p_(Op::mul, u, v); }
  Ref plus(Ref u, Ref v) { return u < 0 ? v : v < 0 ? u : p_(Op::add, u, v); }
  Ref zero_if_none(Ref r) { return r < 0 ? p_.constant(0) : r; }
  /// u where it is above 0, else 1: what a slope divides by.
  Ref positive(Ref u) { return p_(Op::select, p_(Op::less, p_.constant(0), u), u, p_.constant(1)); }

  /// Slopes of node i by its a and b.
  std::pair<Ref, Ref> slopes(const Node& x, Ref r, Ref a, Ref b) {
    const Ref one = p_.constant(1);
    const bool by_a = has(x.a), by_b = has(x.b);
    switch (x.op) {
      case Op::mul:
        return {b, a};
      case Op::div: {
        const Ref s = p_(Op::div, one, b);
        return {s, by_b ? p_(Op::neg, p_(Op::mul, r, s)) : nothing};
      }
      case Op::sqrt:
        return {p_(Op::div, p_.constant(0.5), positive(r)), nothing};
      case Op::exp:
        return {r, nothing};
      case Op::log:
        return {p_(Op::div, one, a), nothing};
      case Op::exp2:
        return {p_(Op::mul, r, p_.constant(std::log(2.0))), nothing};
      case Op::log2:
        return {p_(Op::div, p_.constant(1 / std::log(2.0)), a), nothing};
      case Op::sin:
        return {p_(Op::cos, a), nothing};
      case Op::cos:
        return {p_(Op::neg, p_(Op::sin, a)), nothing};
      case Op::asin:
      case Op::acos: {
        const Ref s =
            p_(Op::sqrt, p_(Op::max, p_(Op::sub, one, p_(Op::mul, a, a)), p_.constant(0)));
        return {p_(Op::div, p_.constant(x.op == Op::asin ? 1 : -1), positive(s)), nothing};
      }
      case Op::atan:
        return {p_(Op::div, one, p_(Op::add, one, p_(Op::mul, a, a))), nothing};
      case Op::atan2: {
        const Ref q = positive(p_(Op::add, p_(Op::mul, a, a), p_(Op::mul, b, b)));
        return {p_(Op::div, b, q), p_(Op::neg, p_(Op::div, a, q))};
      }
      case Op::pow: {
        const Ref base = positive(a);
        return {by_a ? p_(Op::mul, b, p_(Op::div, r, base)) : nothing,
                by_b ? p_(Op::mul, r, p_(Op::log, base)) : nothing};
      }
      default:
        return {nothing, nothing};
    }
  }

  void differentiate(std::size_t i) {
    const Node& x = of_.nodes[i];
    if (!has(x.a) && !has(x.b) && !has(x.c)) return;
    const Ref r = copy_.at[i], a = copy_.ref(x.a), b = copy_.ref(x.b);
    const auto [sa, sb] = slopes(x, r, a, b);
    std::vector<Ref> d(n_, nothing);
    for (std::size_t k = 0; k < n_; ++k) {
      const Ref da = part(x.a, k), db = part(x.b, k), dc = part(x.c, k);
      switch (x.op) {
        case Op::add:
          d[k] = plus(da, db);
          break;
        case Op::sub:
          d[k] = db < 0 ? da : da < 0 ? p_(Op::neg, db) : p_(Op::sub, da, db);
          break;
        case Op::neg:
          d[k] = da < 0 ? da : p_(Op::neg, da);
          break;
        case Op::floor:
          break;
        case Op::min:
        case Op::max:
          if (da >= 0 || db >= 0)
            d[k] = p_(Op::select, x.op == Op::max ? p_(Op::less, a, b) : p_(Op::less, b, a),
                      zero_if_none(db), zero_if_none(da));
          break;
        case Op::select:
          if (db >= 0 || dc >= 0) d[k] = p_(Op::select, a, zero_if_none(db), zero_if_none(dc));
          break;
        default:
          d[k] = plus(times(sa, da), times(sb, db));
      }
    }
    if (std::ranges::any_of(d, [](Ref q) { return q >= 0; })) d_[i] = std::move(d);
  }

  const Program& of_;
  Program p_;
  Copy copy_;
  std::size_t count_;
  bool turn_;
  std::size_t n_;                    ///< derivatives of a node
  std::vector<std::vector<Ref>> d_;  ///< by node; empty: all 0
};

}  // namespace

Ref Program::constant(double v, Kind kind) {
  return node({Op::constant, kind, nothing, nothing, nothing, v, true, true});
}

Ref Program::frame_zero() {
  if (frame_zero_ < 0) {
    nodes.push_back({Op::constant, Kind::number, nothing, nothing, nothing, 0, true, true});
    frame_zero_ = static_cast<Ref>(nodes.size() - 1);
  }
  return frame_zero_;
}

Ref Program::input(bool of_sample, std::size_t index) {
  for (const auto& i : inputs)
    if (i.of_sample == of_sample && i.index == index) return i.node;
  Node n{Op::input};
  n.uniform = !of_sample;
  nodes.push_back(n);
  inputs.push_back({of_sample, index, static_cast<Ref>(nodes.size() - 1)});
  return inputs.back().node;
}

bool Program::is(Ref r, double v) const {
  if (r < 0) return false;
  const Node& n =
      (*this)[r];  // a number that is computed may round to another: only constants are known
  return n.known && n.value == v && (n.op == Op::constant || n.kind != Kind::number);
}

Ref Program::node(const Node& n) {
  const bool leaf = n.op == Op::constant;
  const Key key{n.op, n.kind, n.a, n.b, n.c, leaf ? std::bit_cast<std::uint64_t>(n.value) : 0};
  const auto [at, fresh] = same_.try_emplace(key, static_cast<Ref>(nodes.size()));
  if (!fresh) return at->second;
  if (nodes.size() >= most_nodes)
    refuse("a function of more than " + std::to_string(most_nodes) + " operations");
  nodes.push_back(n);
  return at->second;
}

/// Logic of masks, without which a branch's sides never meet again.
Ref Program::fold_truths(Op op, Ref a, Ref b) {
  const Node& x = (*this)[a];
  if (op == Op::inverse) {
    if (x.known) return truth(x.value == 0);
    return x.op == Op::inverse ? x.a : nothing;
  }
  const Node& y = (*this)[b];
  const auto opposite = [&](Ref u, Ref v) {
    return ((*this)[u].op == Op::inverse && (*this)[u].a == v) ||
           ((*this)[v].op == Op::inverse && (*this)[v].a == u);
  };
  const bool all = op == Op::both;  // the value that leaves the other as it is
  if (is(a, all ? 0 : 1) || is(b, all ? 0 : 1) || opposite(a, b)) return truth(!all);
  if (is(a, all ? 1 : 0) || a == b) return b;
  if (is(b, all ? 1 : 0)) return a;
  if (!all && x.op == Op::both && y.op == Op::both)  // (p ∧ q) ∨ (p ∧ ¬q) = p
    for (const auto& [p, q] : {std::pair{x.a, x.b}, std::pair{x.b, x.a}})
      for (const auto& [r, s] : {std::pair{y.a, y.b}, std::pair{y.b, y.a}})
        if (p == r && opposite(q, s)) return p;
  return nothing;
}

Ref Program::make(Op op, Ref a, Ref b, Ref c) {
  if (op == Op::select && (b == nothing || b == c)) return c;
  if (op == Op::select && c == nothing) return b;
  if (a == nothing) refuse("a variable is read before it is written");
  const Node x = (*this)[a];
  const Node* const y = b >= 0 ? &(*this)[b] : nullptr;
  const Node* const z = c >= 0 ? &(*this)[c] : nullptr;
  const bool known = x.known && y && y->known;
  if (op == Op::both || op == Op::either || op == Op::inverse)
    if (const Ref r = fold_truths(op, a, b); r >= 0) return r;
  if (op == Op::select && x.known) return x.value != 0 ? b : c;
  if (known && op == Op::less) return truth(x.value < y->value);
  if (known && op == Op::less_equal) return truth(x.value <= y->value);
  if (known && op == Op::equal) return truth(x.value == y->value);
  if (op == Op::mul && is(a, 1)) return b;
  if ((op == Op::mul || op == Op::div) && is(b, 1)) return a;
  if (frame_zero_ >= 0 && (a == frame_zero_ || b == frame_zero_)) {
    if (op == Op::mul) return frame_zero_;
    if (op == Op::add) return a == frame_zero_ ? b : a;
    if (op == Op::sub && b == frame_zero_) return a;
  }
  if (op == Op::neg && x.op == Op::neg) return x.a;
  if (op == Op::neg && x.op == Op::constant) return constant(-x.value, x.kind);
  Node n{op, is_truth(op) ? Kind::truth : Kind::number, a, b, c};
  n.uniform = x.uniform && (!y || y->uniform) && (!z || z->uniform);
  if (known &&
      (op == Op::add || op == Op::sub || op == Op::mul)) {  // a loop's counter that is a float
    n.known = true;
    n.value = op == Op::add   ? x.value + y->value
              : op == Op::sub ? x.value - y->value
                              : x.value * y->value;
  }
  return node(n);
}

Program trimmed(const Program& of) {
  Program to;
  Copy(of, to).all();
  return to;
}

Program merged(const std::vector<const Program*>& all,
               const std::function<std::size_t(std::size_t, std::size_t)>& index) {
  Program to;
  for (std::size_t k = 0; k < all.size(); ++k)
    Copy(*all[k], to, [&](std::size_t i) { return index(k, i); }).all();
  return to;
}

bool reads(const Program& p, bool of_sample, std::size_t index) {
  return std::ranges::any_of(
      p.inputs, [&](const Input& i) { return i.of_sample == of_sample && i.index == index; });
}

Program with_derivatives(const Program& of, std::size_t count, bool turn) {
  return Slopes(of, count, turn).made();
}

}  // namespace gonio::foreign
