#pragma once
/// \file
/// A number that writes down what is done to it, as a script for Gappa: the formula twice, every operation of
/// one rounded as the thread's Rounding has it and the other exact, so that Gappa can bound what the one is off
/// the other.
///
/// Forms of + − × ÷ √ only.  A comparison is decided where every value of the domain decides it alike, rounded and exact:
/// the enclosure (enclosure.h) and the interval that go with each number tell.  What cannot be written makes the
/// script say why.

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>

#include "number/enclosure.h"
#include "number/exact.h"
#include "number/interval.h"
#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Script of what this thread's numbers did; one at a time.
class Script {
 public:
  Script() : before_(now()) { now() = this; }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;
  ~Script() { now() = before_; }

  /// Its definitions, a line for each operation.
  const std::string& text() const { return text_; }
  /// Operation that a script cannot hold; empty where there is none.
  const std::string& refused() const { return refused_; }

  static Script*& now() {
    static thread_local Script* script = nullptr;
    return script;
  }
  void refuse(std::string_view what) {
    if (refused_.empty()) refused_ = what;
  }
  /// Hints that follow the goal.
  const std::string& hints() const { return hints_; }
  /// \return  number of the definition: r and e with it are its rounded and exact names
  int define(const std::string& rounded, const std::string& exact) {
    const auto number = std::to_string(++count_);
    text_ += "r" + number + " = " + rounded + "; e" + number + " = " + exact + ";\n";
    return count_;
  }
  /// Definition of a quotient or a root that errs by 2^−bits of it: Gappa knows such products, and that 1 · q is q.
  int define_within(int bits, const std::string& rounded, const std::string& exact) {
    const auto number = std::to_string(count_ + 1), q = "q" + number;
    text_ += q + " = " + rounded + ";\n";
    hints_ += "1 * " + q + " -> " + q + ";\n";
    return define("mul_rel<" + std::to_string(bits) + ">(1, " + q + ")", exact);
  }

 private:
  Script* before_;
  std::string text_, hints_, refused_;
  int count_ = 0;
};

/// A constant before it is rounded to F: exact formulas have it as it is written.
template <class F>
struct ScriptedConstant {
  long double value;
  explicit ScriptedConstant(std::floating_point auto x) : value(x) {}
};

/// Error terms (exact.h) are the number's, which has them because it rounds.
template <class F>
inline constexpr bool rounds_to_nearest<ScriptedConstant<F>> = rounds_to_nearest<F>;

template <class F>
class Scripted {
 public:
  Scripted() : Scripted(0) {}
  explicit Scripted(std::same_as<int> auto x)
      : rounded_(text(static_cast<long double>(x))),
        exact_(rounded_),
        value_(x),
        exact_value_{static_cast<double>(x), static_cast<double>(x)},
        least_(std::max(std::abs(x), 1)) {}
  explicit Scripted(const ScriptedConstant<F>& x)
      : rounded_(text(static_cast<long double>(static_cast<double>(static_cast<F>(x.value))))),
        exact_(text(x.value)),
        value_(static_cast<F>(x.value)),
        exact_value_(Interval::holding(x.value)),
        least_(std::max(value_.low(), -value_.high())) {
    if (auto* script = Script::now(); script && rounding_now.flushed && value_.may_be_subnormal())
      script->refuse("a constant that may be flushed");
  }
  explicit Scripted(F x) : Scripted(ScriptedConstant<F>(static_cast<double>(x))) {}
  /// An input that the script calls by that name, from low to high.
  static Scripted input(const std::string& name, F low, F high) {
    Scripted x;
    x.rounded_ = x.exact_ = name;
    x.value_ = Enclosure<F>::between(low, high);
    x.exact_value_ = {x.value_.low(), x.value_.high()};
    x.least_ = std::max({x.value_.low(), -x.value_.high(), 0.0});
    if (auto* script = Script::now(); script && rounding_now.flushed && x.least_ < least_normal)
      script->refuse("an input that may be subnormal");
    return x;
  }
  const std::string& rounded() const { return rounded_; }
  const std::string& exact() const { return exact_; }

  friend Scripted operator-(const Scripted& a) {
    return defined(-a.value_, -a.exact_value_, a.least_,
                   [&](Script& script) { return script.define("-" + a.rounded_, "-" + a.exact_); });
  }
  friend Scripted operator+(const Scripted& a, const Scripted& b) {
    return binary(a, "+", "add_rel", b, a.value_ + b.value_, a.exact_value_ + b.exact_value_,
                  least_of_sum(a, b, 1));
  }
  friend Scripted operator-(const Scripted& a, const Scripted& b) {
    return binary(a, "-", "sub_rel", b, a.value_ - b.value_, a.exact_value_ - b.exact_value_,
                  least_of_sum(a, b, -1));
  }
  friend Scripted operator*(const Scripted& a, const Scripted& b) {
    const bool same = !a.exact_.empty() && a.exact_ == b.exact_;
    return binary(a, "*", "mul_rel", b, a.value_ * b.value_,
                  same ? square(a.exact_value_) : a.exact_value_ * b.exact_value_,
                  a.least_ * b.least_);
  }
  friend Scripted operator/(const Scripted& a, const Scripted& b) {
    return defined(
        a.value_ / b.value_, a.exact_value_ / b.exact_value_, a.least_ / size(b),
        [&](Script& script) {
          const auto r = a.rounded_ + " / " + b.rounded_, e = a.exact_ + " / " + b.exact_;
          return rounding_now.any_gpu ? script.define_within(unit_bits - 2, r, e)  // 2.5 < 4
                                      : script.define("rnd(" + r + ")", e);
        });
  }
  friend Scripted operator+(std::same_as<int> auto s, const Scripted& a) { return Scripted(s) + a; }
  friend Scripted operator+(const Scripted& a, std::same_as<int> auto s) { return a + Scripted(s); }
  friend Scripted operator-(std::same_as<int> auto s, const Scripted& a) { return Scripted(s) - a; }
  friend Scripted operator-(const Scripted& a, std::same_as<int> auto s) { return a - Scripted(s); }
  friend Scripted operator*(std::same_as<int> auto s, const Scripted& a) { return Scripted(s) * a; }
  friend Scripted operator*(const Scripted& a, std::same_as<int> auto s) { return a * Scripted(s); }
  friend Scripted operator/(std::same_as<int> auto s, const Scripted& a) { return Scripted(s) / a; }
  friend Scripted operator/(const Scripted& a, std::same_as<int> auto s) { return a / Scripted(s); }
  friend EnclosureMask operator<(const Scripted& a, const Scripted& b) {
    const EnclosureMask m = a.value_ < b.value_;
    const Interval &x = a.exact_value_, &y = b.exact_value_;
    return EnclosureMask(m.can_hold() || x.low < y.high, m.can_fail() || y.low <= x.high);
  }

  friend Scripted sqrt(const Scripted& a) {
    return defined(sqrt(a.value_), sqrt(a.exact_value_), std::sqrt(a.least_), [&](Script& script) {
      const auto r = "sqrt(" + a.rounded_ + ")", e = "sqrt(" + a.exact_ + ")";
      return rounding_now.any_gpu ? script.define_within(unit_bits - 3, r, e)  // 4.51 < 8
                                  : script.define("rnd(" + r + ")", e);
    });
  }
  friend Scripted exp(const Scripted& a) {
    return refused("exp, which Gappa does not know", exp(a.value_));
  }
  friend Scripted log(const Scripted& a) {
    return refused("log, which Gappa does not know", log(a.value_));
  }

 private:
  friend struct RealTraits<Scripted>;

  /// Gappa reads C's hexadecimal numbers, in which these are exact.
  static std::string text(long double x) {
    std::ostringstream out;
    out << std::hexfloat << x;
    return x < 0 ? "(" + out.str() + ")" : out.str();
  }
  inline static const double least_normal =
      std::ldexp(1.0, std::numeric_limits<F>::min_exponent - 1);
  /// Digits of the unit of Vulkan's bounds, 2^−unit_bits of a value; of double they are float's.
  static constexpr int unit_bits = std::min(std::numeric_limits<F>::digits, 24) - 1;

  /// Number that `define` defines, of whose values but 0 none is less than `least`.  Gappa's floats neither overflow nor are
  /// they flushed.
  static Scripted defined(const Enclosure<F>& value,
                          const Interval& exact_value,
                          double least,
                          auto&& define) {
    Scripted r;
    r.value_ = value;
    r.exact_value_ = exact_value;
    r.least_ = std::max({least * (1 - 0x1p-8), value.low(), -value.high()});  // roundings and more
    if (!value.is_finite()) return refused("a value that is not proved to be finite", value);
    if (rounding_now.flushed && r.least_ < least_normal)
      return refused("a value that may be subnormal", value);
    if (rounding_now.contracted) return refused("contraction", value);
    if (auto* script = Script::now()) {
      const auto number = std::to_string(define(*script));
      r.rounded_ = "r" + number;
      r.exact_ = "e" + number;
    }
    return r;
  }
  static Scripted binary(const Scripted& a,
                         const std::string& sign,
                         const std::string& relative,
                         const Scripted& b,
                         const Enclosure<F>& value,
                         const Interval& exact_value,
                         double least) {
    return defined(value, exact_value, least, [&](Script& script) {
      const auto e = a.exact_ + " " + sign + " " + b.exact_;
      if (rounding_now.any_gpu)
        return script.define(relative + "<" + std::to_string(unit_bits) + ">(" + a.rounded_ + ", " +
                                 b.rounded_ + ")",
                             e);
      return script.define("rnd(" + a.rounded_ + " " + sign + " " + b.rounded_ + ")", e);
    });
  }
  /// Sum's: of two values of F it is a multiple of the last digit of the lesser, or, where they have one sign, no less.
  static double least_of_sum(const Scripted& a, const Scripted& b, double sign) {
    const bool alike =
        a.value_.low() >= 0 && (sign > 0 ? b.value_.low() >= 0 : b.value_.high() <= 0);
    return std::min(a.least_, b.least_) *
           (alike ? 1 : std::ldexp(1.0, -std::numeric_limits<F>::digits));
  }
  static double size(const Scripted& x) {
    return std::max(std::abs(x.value_.low()), std::abs(x.value_.high()));
  }
  static Scripted refused(std::string_view what, const Enclosure<F>& value) {
    if (auto* script = Script::now()) script->refuse(what);
    Scripted r;
    r.value_ = value;
    r.exact_value_ = {};
    return r;
  }
  /// True where a is b or greater, whatever the inputs, rounded and exact.
  static bool not_below(const Scripted& a, const Scripted& b) {
    return a.value_.low() >= b.value_.high() && a.exact_value_.low >= b.exact_value_.high &&
           !a.value_.may_be_nan();
  }
  static Scripted select(const EnclosureMask& m, const Scripted& a, const Scripted& b) {
    if (!m.can_fail()) return a;
    if (!m.can_hold()) return b;
    return refused("a choice that inputs of the domain make differently",
                   gonio::select<Enclosure<F>>(m, a.value_, b.value_));
  }

  std::string rounded_, exact_;
  Enclosure<F> value_;
  Interval exact_value_;
  double least_ = 0;  // of its sizes but 0
};

template <class F>
struct RealTraits<Scripted<F>> {
  using Base = ScriptedConstant<F>;
  using Plain = Scripted<F>;
  using Mask = EnclosureMask;
  static Plain select(const Mask& m, const Plain& a, const Plain& b) {
    return Plain::select(m, a, b);
  }
  /// Greater one; of values that touch, as 1 − x and 0 for x up to 1, either is it there.
  static Plain max(const Plain& a, const Plain& b) {
    if (Plain::not_below(a, b)) return a;
    if (Plain::not_below(b, a)) return b;
    return Plain::select(a < b, b, a);
  }
  static Plain min(const Plain& a, const Plain& b) {
    if (Plain::not_below(b, a)) return a;
    if (Plain::not_below(a, b)) return b;
    return Plain::select(b < a, b, a);
  }
};

}  // namespace gonio::inline GONIO_ARCH

template <class F>
class std::numeric_limits<gonio::ScriptedConstant<F>> : public std::numeric_limits<F> {};
template <class F>
class std::numeric_limits<gonio::Scripted<F>> : public std::numeric_limits<F> {};
