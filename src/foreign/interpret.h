#pragma once
/// \file
/// Runs straight-line code over columns of any number, in blocks that stay in the first cache.

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "foreign/functions_of_numbers.h"
#include "foreign/program.h"
#include "number/real.h"

namespace gonio::foreign::inline GONIO_ARCH {

template <class T>
class Interpreter {
 public:
  using Mask = mask_t<T>;

  /// \param block  elements of T in a column: each a register full of samples where T is one
  explicit Interpreter(const Program& p, std::size_t block = 1) : p_(p), block_(block) {
    const std::size_t n = p.nodes.size();
    std::vector<std::size_t> last(n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (const Ref r : {p.nodes[i].a, p.nodes[i].b, p.nodes[i].c})
        if (r >= 0) last[at(r)] = i;
    for (const Ref o : p.outputs) last[at(o)] = n;
    std::vector<std::size_t> free[2];
    std::size_t slots[2] = {0, 0};
    slot_.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const Node& x = p.nodes[i];
      if (x.uniform) continue;
      for (const Ref r :
           {x.a, x.b, x.c}) {  // a column that ends here may be written here: loops go in step
        if (r < 0 || p[r].uniform || last[at(r)] != i) continue;
        free[is_truth(p[r])].push_back(slot_[at(r)]);
        last[at(r)] = n + 1;
      }
      auto& spare = free[is_truth(x)];
      if (spare.empty() || x.op == Op::input) {  // inputs are there before any step
        slot_[i] = slots[is_truth(x)]++;
      } else {
        slot_[i] = spare.back();
        spare.pop_back();
      }
      if (x.op != Op::input) steps_.push_back(i);
    }
    numbers_.assign(slots[0] * block, T(0));
    truths_.assign(slots[1] * block, Cell{no()});
    uniform_.assign(n, T(0));
    uniform_truth_.assign(n, Cell{no()});
    set_constants();
  }
  Interpreter(const Interpreter&) = delete;

  /// The parameters of the runs that follow, by their index.
  void set(std::span<const T> parameters) {
    for (const auto& i : p_.inputs)
      if (!i.of_sample) uniform_[at(i.node)] = parameters[i.index];
    for (std::size_t i = 0; i < p_.nodes.size(); ++i) {
      const Node& x = p_.nodes[i];
      if (x.uniform && x.op != Op::input && x.op != Op::constant) step(i, 1);
    }
  }

  /// \param in   (index of an angle, element) → T
  /// \param out  (output, element, T)
  void run(std::size_t n, auto&& in, auto&& out) {
    for (std::size_t from = 0; from < n; from += block_) {
      const std::size_t m = std::min(block_, n - from);
      for (const auto& i : p_.inputs)
        if (i.of_sample) {
          T* const column = &numbers_[slot_[at(i.node)] * block_];
          for (std::size_t j = 0; j < m; ++j) column[j] = in(i.index, from + j);
        }
      for (const std::size_t i : steps_) step(i, m);
      for (std::size_t o = 0; o < p_.outputs.size(); ++o) {
        const auto x = number(p_.outputs[o]);
        for (std::size_t j = 0; j < m; ++j) out(o, from + j, x.one ? *x.first : x.first[j]);
      }
    }
  }

 private:
  struct Cell {
    Mask m;
  };
  template <class A>
  struct Operand {
    const A* first;
    bool one;  ///< the same for all samples
  };
  static std::size_t at(Ref r) { return static_cast<std::size_t>(r); }
  static bool is_truth(const Node& x) { return x.kind == Kind::truth; }
  static Mask no() { return T(1) < T(0); }

  void set_constants() {
    for (std::size_t i = 0; i < p_.nodes.size(); ++i) {
      const Node& x = p_.nodes[i];
      if (x.op != Op::constant) continue;
      if (is_truth(x))
        uniform_truth_[i] = {x.value != 0 ? !no() : no()};
      else if (x.value == std::numbers::pi)  // of fifty digits it has all
        uniform_[i] = pi<T>();
      else
        uniform_[i] = constant<T>(static_cast<long double>(x.value));
    }
  }

  Operand<T> number(Ref r) const {
    if (p_[r].uniform) return {&uniform_[at(r)], true};
    return {&numbers_[slot_[at(r)] * block_], false};
  }
  Operand<Cell> truth(Ref r) const {
    if (p_[r].uniform) return {&uniform_truth_[at(r)], true};
    return {&truths_[slot_[at(r)] * block_], false};
  }

  /// A loop for each way in which operands are columns or one value.
  template <class R, class A>
  static void each(R* r, Operand<A> a, std::size_t n, auto f) {
    if (a.one) {
      const R x = f(*a.first);
      for (std::size_t j = 0; j < n; ++j) r[j] = x;
    } else {
      for (std::size_t j = 0; j < n; ++j) r[j] = f(a.first[j]);
    }
  }
  template <class R, class A>
  static void each(R* r, Operand<A> a, Operand<A> b, std::size_t n, auto f) {
    if (a.one) {
      const A x = *a.first;
      for (std::size_t j = 0; j < n; ++j) r[j] = f(x, b.first[b.one ? 0 : j]);
    } else if (b.one) {
      const A x = *b.first;
      for (std::size_t j = 0; j < n; ++j) r[j] = f(a.first[j], x);
    } else {
      for (std::size_t j = 0; j < n; ++j) r[j] = f(a.first[j], b.first[j]);
    }
  }

  void step(std::size_t i, std::size_t n) {
    using F = Functions<T>;
    using std::exp, std::log, std::sqrt;
    const Node& x = p_.nodes[i];
    T* const r = is_truth(x) ? nullptr : x.uniform ? &uniform_[i] : &numbers_[slot_[i] * block_];
    Cell* const t = !is_truth(x) ? nullptr
                    : x.uniform  ? &uniform_truth_[i]
                                 : &truths_[slot_[i] * block_];
    const auto one = [&](auto f) { each(r, number(x.a), n, f); };
    const auto two = [&](auto f) { each(r, number(x.a), number(x.b), n, f); };
    const auto call = [&]<Call f>() { one([](const T& a) { return F::template call<f>(a, a); }); };
    const auto call2 = [&]<Call f>() {
      two([](const T& a, const T& b) { return F::template call<f>(a, b); });
    };
    const auto compare = [&](auto f) {
      each(t, number(x.a), number(x.b), n, [&](const T& a, const T& b) { return Cell{f(a, b)}; });
    };
    const auto logic = [&](auto f) {
      each(t, truth(x.a), truth(x.b), n,
           [&](const Cell& a, const Cell& b) { return Cell{f(a.m, b.m)}; });
    };
    switch (x.op) {
      case Op::add:
        return two([](const T& a, const T& b) { return a + b; });
      case Op::sub:
        return two([](const T& a, const T& b) { return a - b; });
      case Op::mul:
        return two([](const T& a, const T& b) { return a * b; });
      case Op::div:
        return two([](const T& a, const T& b) { return a / b; });
      case Op::min:
        return two([](const T& a, const T& b) { return gonio::min<T>(a, b); });
      case Op::max:
        return two([](const T& a, const T& b) { return gonio::max<T>(a, b); });
      case Op::pow:
        return call2.template operator()<Call::pow>();
      case Op::atan2:
        return call2.template operator()<Call::atan2>();
      case Op::neg:
        return one([](const T& a) { return -a; });
      case Op::sqrt:
        return one([](const T& a) { return sqrt(a); });
      case Op::exp:
        return one([](const T& a) { return exp(a); });
      case Op::log:
        return one([](const T& a) { return log(a); });
      case Op::exp2:
        return call.template operator()<Call::exp2>();
      case Op::log2:
        return call.template operator()<Call::log2>();
      case Op::sin:
        return call.template operator()<Call::sin>();
      case Op::cos:
        return call.template operator()<Call::cos>();
      case Op::asin:
        return call.template operator()<Call::asin>();
      case Op::acos:
        return call.template operator()<Call::acos>();
      case Op::atan:
        return call.template operator()<Call::atan>();
      case Op::floor:
        return call.template operator()<Call::floor>();
      case Op::less:
        return compare([](const T& a, const T& b) { return a < b; });
      case Op::less_equal:
        return compare([](const T& a, const T& b) { return F::less_equal(a, b); });
      case Op::equal:
        return compare([](const T& a, const T& b) { return F::equal(a, b); });
      case Op::both:
        return logic([](const Mask& a, const Mask& b) -> Mask { return a && b; });
      case Op::either:
        return logic([](const Mask& a, const Mask& b) -> Mask { return a || b; });
      case Op::inverse:
        return each(t, truth(x.a), n, [](const Cell& a) { return Cell{!a.m}; });
      case Op::select: {
        const auto m = truth(x.a);
        const auto a = number(x.b), b = number(x.c);
        for (std::size_t j = 0; j < n; ++j)
          r[j] = gonio::select<T>(m.first[m.one ? 0 : j].m, a.first[a.one ? 0 : j],
                                  b.first[b.one ? 0 : j]);
        return;
      }
      case Op::constant:
      case Op::input:
        return;
    }
  }

  const Program& p_;
  std::size_t block_;
  std::vector<std::size_t> slot_, steps_;
  std::vector<T> numbers_, uniform_;
  std::vector<Cell> truths_, uniform_truth_;
};

}  // namespace gonio::foreign::inline GONIO_ARCH
