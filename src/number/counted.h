#pragma once
/// \file
/// A number that counts what is done to it, by kind: what a formula costs.
///
/// The rules: a difference is an addition; multiplying by an integer is a multiplication, squaring
/// too; comparing and selecting count both, so min and max count one of each; a negation, a mask's
/// logic, a constant and a copy are free (shaders have them as modifiers of an operation).  select
/// evaluates both its sides, and both count.

#include <array>
#include <string_view>

#include "number/real.h"

namespace gonio {

enum class Operation { add, mul, div, sqrt, exp, log, compare, select };
inline constexpr std::array<std::string_view, 8> operation_names{"add", "mul", "div",     "sqrt",
                                                                 "exp", "log", "compare", "select"};

struct Operations {
  std::array<std::size_t, operation_names.size()> by_kind{};

  std::size_t& operator[](Operation kind) { return by_kind[static_cast<std::size_t>(kind)]; }
  std::size_t operator[](Operation kind) const { return by_kind[static_cast<std::size_t>(kind)]; }
  /// All kinds alike.
  std::size_t total() const {
    std::size_t sum = 0;
    for (const auto count : by_kind) sum += count;
    return sum;
  }
  Operations& operator+=(const Operations& other) {
    for (std::size_t k = 0; k < by_kind.size(); ++k) by_kind[k] += other.by_kind[k];
    return *this;
  }
  friend bool operator==(const Operations&, const Operations&) = default;
};

}  // namespace gonio

namespace gonio::inline GONIO_ARCH {

/// Operations that this thread's Counted numbers have done so far.
inline thread_local Operations operations_so_far;

/// Operations that `work` does with Counted numbers.
Operations count_operations(auto&& work) {
  const Operations before = operations_so_far;
  work();
  Operations done = operations_so_far;
  for (std::size_t k = 0; k < done.by_kind.size(); ++k) done.by_kind[k] -= before.by_kind[k];
  return done;
}

template <class B>
class Counted {
 public:
  Counted() = default;
  explicit Counted(std::same_as<int> auto x) : v_(static_cast<B>(x)) {}
  explicit Counted(B x) : v_(x) {}
  const B& value() const { return v_; }

  friend Counted operator+(const Counted& a, const Counted& b) { return done(add, a.v_ + b.v_); }
  friend Counted operator-(const Counted& a, const Counted& b) { return done(add, a.v_ - b.v_); }
  friend Counted operator*(const Counted& a, const Counted& b) { return done(mul, a.v_ * b.v_); }
  friend Counted operator/(const Counted& a, const Counted& b) { return done(div, a.v_ / b.v_); }
  friend Counted operator-(const Counted& a) { return Counted(-a.v_); }
  friend Counted operator+(std::same_as<int> auto s, const Counted& a) { return Counted(s) + a; }
  friend Counted operator+(const Counted& a, std::same_as<int> auto s) { return a + Counted(s); }
  friend Counted operator-(std::same_as<int> auto s, const Counted& a) { return Counted(s) - a; }
  friend Counted operator-(const Counted& a, std::same_as<int> auto s) { return a - Counted(s); }
  friend Counted operator*(std::same_as<int> auto s, const Counted& a) { return Counted(s) * a; }
  friend Counted operator*(const Counted& a, std::same_as<int> auto s) { return a * Counted(s); }
  friend Counted operator/(std::same_as<int> auto s, const Counted& a) { return Counted(s) / a; }
  friend Counted operator/(const Counted& a, std::same_as<int> auto s) { return a / Counted(s); }
  friend mask_t<B> operator<(const Counted& a, const Counted& b) {
    ++operations_so_far[Operation::compare];
    return a.v_ < b.v_;
  }

  friend Counted sqrt(const Counted& a) {
    using std::sqrt;
    return done(Operation::sqrt, sqrt(a.v_));
  }
  friend Counted exp(const Counted& a) {
    using std::exp;
    return done(Operation::exp, exp(a.v_));
  }
  friend Counted log(const Counted& a) {
    using std::log;
    return done(Operation::log, log(a.v_));
  }

 private:
  friend struct RealTraits<Counted>;
  static constexpr auto add = Operation::add, mul = Operation::mul, div = Operation::div;
  static Counted done(Operation kind, const B& result) {
    ++operations_so_far[kind];
    return Counted(result);
  }

  B v_{};
};

template <class B>
struct RealTraits<Counted<B>> {
  using Base = B;
  using Plain = Counted<B>;
  using Mask = mask_t<B>;
  static Counted<B> select(const Mask& m, const Counted<B>& a, const Counted<B>& b) {
    return Counted<B>::done(Operation::select, RealTraits<B>::select(m, a.v_, b.v_));
  }
};

}  // namespace gonio::inline GONIO_ARCH
