#pragma once
/// \file
/// A number that keeps what is done to it, as a graph: what a shader's source is written from (src/shader), and what
/// a derivative is taken of.
///
/// What is known is folded, in F, as F rounds; what is computed twice is one node; a comparison of what is not known stays
/// one.  A literal 0 of a formula is nothing: what is added to it, or multiplied by it, is not computed.  All
/// else is kept operation by operation, so that a compiler that does the same, and rounds as F does, gets the same bits, up to
/// the sign of a zero.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "number/real.h"

namespace gonio {

/// Graph of a formula: nodes in an order in which each follows what it is made of.
class Trace {
 public:
  // clang-format off
  enum class Kind {
    constant, input,                          // value; name
    negate, sqrt, exp, log,                   // of[0]
    add, subtract, multiply, divide, max, min, // of[0] ∘ of[1]
    select,                                   // of[0] ? of[1] : of[2]
    less, both, either, no                    // masks
  };
  // clang-format on
  using Operands = std::array<int, 3>;  // −1: none
  struct Node {
    Kind kind;
    Operands of{-1, -1, -1};
    double value = 0;
    std::string name;  ///< of an input; of others what they are called, empty: nothing
    std::string part;  ///< what of the formula was at work
  };

  /// Traces what the thread's Traced numbers do until it ends; one at a time.
  class Recording {
   public:
    explicit Recording(Trace& trace) : before_(std::exchange(now(), &trace)) {}
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    ~Recording() { now() = before_; }

   private:
    Trace* before_;
  };
  static Trace*& now() {
    static thread_local Trace* trace = nullptr;
    return trace;
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  const Node& operator[](int node) const { return nodes_[static_cast<std::size_t>(node)]; }

  int input(std::string name) {
    nodes_.push_back({Kind::input, {-1, -1, -1}, 0, std::move(name), {}});
    return last();
  }
  int constant(double value) {
    const auto [at, is_new] = constants_.try_emplace(std::bit_cast<std::uint64_t>(value));
    if (is_new) {
      nodes_.push_back({Kind::constant, {-1, -1, -1}, value, {}, {}});
      at->second = last();
    }
    return at->second;
  }
  /// Node of an operation, the same for the same; of sums, products and what joins masks in either order.
  int operation(Kind kind, Operands of) {
    if ((kind == Kind::add || kind == Kind::multiply || kind == Kind::both ||
         kind == Kind::either) &&
        of[1] < of[0])
      std::swap(of[0], of[1]);
    const auto [at, is_new] = operations_.try_emplace({kind, of});
    if (is_new) {
      nodes_.push_back({kind, of, 0, {}, part_});
      at->second = last();
    }
    return at->second;
  }
  /// What the nodes from now on belong to.
  void begin(std::string part) { part_ = std::move(part); }
  /// Names a node that has no name.
  void call(int node, const std::string& name) {
    auto& n = nodes_[static_cast<std::size_t>(node)];
    if (n.name.empty() && n.kind != Kind::constant) n.name = name;
  }

 private:
  int last() const { return static_cast<int>(nodes_.size()) - 1; }

  std::vector<Node> nodes_;
  std::map<std::pair<Kind, Operands>, int> operations_;
  std::map<std::uint64_t, int> constants_;
  std::string part_;
};

}  // namespace gonio

namespace gonio::inline GONIO_ARCH {

/// What a comparison of traced numbers gives: known, or a node.
class TracedMask {
 public:
  explicit TracedMask(bool known) : known_(known) {}
  static TracedMask at(int node) {
    TracedMask m(false);
    m.node_ = node;
    return m;
  }
  bool is_known() const { return node_ < 0; }
  bool known() const { return known_; }
  int node() const { return node_; }

  friend TracedMask operator&&(const TracedMask& a, const TracedMask& b) {
    if (a.is_known()) return a.known_ ? b : a;
    if (b.is_known()) return b.known_ ? a : b;
    return at(Trace::now()->operation(Trace::Kind::both, {a.node_, b.node_, -1}));
  }
  friend TracedMask operator||(const TracedMask& a, const TracedMask& b) {
    if (a.is_known()) return a.known_ ? a : b;
    if (b.is_known()) return b.known_ ? b : a;
    return at(Trace::now()->operation(Trace::Kind::either, {a.node_, b.node_, -1}));
  }
  friend TracedMask operator!(const TracedMask& a) {
    if (a.is_known()) return TracedMask(!a.known_);
    return at(Trace::now()->operation(Trace::Kind::no, {a.node_, -1, -1}));
  }

 private:
  int node_ = -1;
  bool known_;
};

/// \tparam F  number that constants are folded in: float or Half
template <class F>
class Traced {
 public:
  using Kind = Trace::Kind;

  Traced() = default;
  explicit Traced(std::same_as<int> auto x) : value_(static_cast<F>(x)), nothing_(x == 0) {}
  explicit Traced(F x) : value_(x), nothing_(false) {}
  static Traced at(int node) {
    Traced x;
    x.nothing_ = false;
    x.node_ = node;
    return x;
  }
  static Traced input(const std::string& name) { return at(Trace::now()->input(name)); }
  /// Its node in the thread's trace, where a constant gets one.
  int node() const {
    return is_known() ? Trace::now()->constant(static_cast<double>(value_)) : node_;
  }
  bool is_known() const { return node_ < 0; }
  const F& known() const { return value_; }

  friend Traced operator-(const Traced& a) {
    if (a.nothing_) return a;
    if (a.is_known()) return Traced(-a.value_);
    return done(Kind::negate, a);
  }
  friend Traced operator+(const Traced& a, const Traced& b) {
    if (a.nothing_) return b;
    if (b.nothing_) return a;
    if (a.is_known() && b.is_known()) return Traced(a.value_ + b.value_);
    if (a.is(0)) return b;
    if (b.is(0)) return a;
    return done(Kind::add, a, b);
  }
  friend Traced operator-(const Traced& a, const Traced& b) {
    if (b.nothing_) return a;
    if (a.nothing_) return -b;
    if (a.is_known() && b.is_known()) return Traced(a.value_ - b.value_);
    return done(Kind::subtract, a, b);
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    if (a.nothing_ || a.is(1)) return a.nothing_ ? a : b;
    if (b.nothing_ || b.is(1)) return b.nothing_ ? b : a;
    if (a.is_known() && b.is_known()) return Traced(a.value_ * b.value_);
    if (a.is(-1)) return -b;
    if (b.is(-1)) return -a;
    return done(Kind::multiply, a, b);
  }
  /// Quotient; by a power of two it is a product, which is the same to the bit.
  friend Traced operator/(const Traced& a, const Traced& b) {
    if (a.nothing_ || b.is(1)) return a;
    if (a.is_known() && b.is_known()) return Traced(a.value_ / b.value_);
    if (b.is_known()) {
      int exponent = 0;
      const double x = static_cast<double>(b.value_);
      if (std::abs(std::frexp(x, &exponent)) == 0.5 && std::abs(exponent) < 14)
        return a * Traced(F(1) / b.value_);
    }
    return done(Kind::divide, a, b);
  }
  friend Traced operator+(std::same_as<int> auto s, const Traced& a) { return Traced(s) + a; }
  friend Traced operator+(const Traced& a, std::same_as<int> auto s) { return a + Traced(s); }
  friend Traced operator-(std::same_as<int> auto s, const Traced& a) { return Traced(s) - a; }
  friend Traced operator-(const Traced& a, std::same_as<int> auto s) { return a - Traced(s); }
  friend Traced operator*(std::same_as<int> auto s, const Traced& a) { return Traced(s) * a; }
  friend Traced operator*(const Traced& a, std::same_as<int> auto s) { return a * Traced(s); }
  friend Traced operator/(std::same_as<int> auto s, const Traced& a) { return Traced(s) / a; }
  friend Traced operator/(const Traced& a, std::same_as<int> auto s) { return a / Traced(s); }
  friend TracedMask operator<(const Traced& a, const Traced& b) {
    if (a.is_known() && b.is_known()) return TracedMask(a.value_ < b.value_);
    return TracedMask::at(Trace::now()->operation(Kind::less, {a.node(), b.node(), -1}));
  }
  friend Traced sqrt(const Traced& a) {
    using gonio::sqrt;
    return a.is_known() ? Traced(sqrt(a.value_)) : done(Kind::sqrt, a);
  }
  friend Traced exp(const Traced& a) {
    using gonio::exp;
    return a.is_known() ? Traced(exp(a.value_)) : done(Kind::exp, a);
  }
  friend Traced log(const Traced& a) {
    using gonio::log;
    return a.is_known() ? Traced(log(a.value_)) : done(Kind::log, a);
  }

 private:
  friend struct RealTraits<Traced>;

  bool is(int x) const { return is_known() && static_cast<double>(value_) == x; }
  static Traced done(Kind kind, const Traced& a) {
    return at(Trace::now()->operation(kind, {a.node(), -1, -1}));
  }
  static Traced done(Kind kind, const Traced& a, const Traced& b) {
    const int x = a.node();
    return at(Trace::now()->operation(kind, {x, b.node(), -1}));
  }
  bool same(const Traced& b) const {
    if (is_known() != b.is_known()) return false;
    return is_known() ? static_cast<double>(value_) == static_cast<double>(b.value_)
                      : node_ == b.node_;
  }

  F value_{};
  int node_ = -1;
  bool nothing_ = true;
};

template <class F>
struct RealTraits<Traced<F>> {
  using Base = F;
  using Plain = Traced<F>;
  using Mask = TracedMask;
  static Plain select(const Mask& m, const Plain& a, const Plain& b) {
    if (m.is_known()) return m.known() ? a : b;
    if (a.same(b)) return a;
    const int x = a.node();
    return Plain::at(Trace::now()->operation(Trace::Kind::select, {m.node(), x, b.node()}));
  }
  static Plain max(const Plain& a, const Plain& b) {
    if (a.is_known() && b.is_known()) return a.known() < b.known() ? b : a;
    return Plain::done(Trace::Kind::max, a, b);
  }
  static Plain min(const Plain& a, const Plain& b) {
    if (a.is_known() && b.is_known()) return b.known() < a.known() ? b : a;
    return Plain::done(Trace::Kind::min, a, b);
  }
};

/// What was traced, done again in another number: each node's value, masks' in `masks`.
///
/// \param inputs  of each input in the order in which they were made
/// \param settle  (node, value): called of each but masks, may set the value
template <class T>
std::vector<T> replay(const Trace& trace, const std::vector<T>& inputs, auto&& settle) {
  using Kind = Trace::Kind;
  std::vector<T> x;
  std::vector<mask_t<T>> masks;
  std::vector<std::size_t> mask_of;
  std::size_t next = 0;
  x.reserve(trace.nodes().size());
  for (const auto& n : trace.nodes()) {
    const auto of = [&](std::size_t k) -> const T& { return x[static_cast<std::size_t>(n.of[k])]; };
    const auto mask = [&](std::size_t k) -> mask_t<T> {
      return masks[mask_of[static_cast<std::size_t>(n.of[k])]];
    };
    mask_of.push_back(masks.size());
    const auto value = [&]() -> T {
      switch (n.kind) {
        case Kind::constant:
          return T(static_cast<base_t<T>>(n.value));
        case Kind::input:
          return inputs[next++];
        case Kind::negate:
          return -of(0);
        case Kind::sqrt:
          return sqrt(of(0));
        case Kind::exp:
          return exp(of(0));
        case Kind::log:
          return log(of(0));
        case Kind::add:
          return of(0) + of(1);
        case Kind::subtract:
          return of(0) - of(1);
        case Kind::multiply:
          return of(0) * of(1);
        case Kind::divide:
          return of(0) / of(1);
        case Kind::max:
          return gonio::select<T>(of(0) < of(1), of(1), of(0));
        case Kind::min:
          return gonio::select<T>(of(1) < of(0), of(1), of(0));
        case Kind::select:
          return gonio::select<T>(mask(0), of(1), of(2));
        case Kind::less:
          masks.push_back(of(0) < of(1));
          break;
        case Kind::both:
          masks.push_back(mask(0) && mask(1));
          break;
        case Kind::either:
          masks.push_back(mask(0) || mask(1));
          break;
        case Kind::no:
          masks.push_back(!mask(0));
          break;
      }
      return T(0);
    };
    x.push_back(value());
    settle(static_cast<int>(x.size()) - 1, x.back());
  }
  return x;
}
template <class T>
std::vector<T> replay(const Trace& trace, const std::vector<T>& inputs) {
  return replay<T>(trace, inputs, [](int, T&) {});
}

}  // namespace gonio::inline GONIO_ARCH
