#pragma once
/// \file
/// All values that a formula computed in F can take while its inputs lie anywhere in a box.
///
/// An interval whose ends are rounded as F rounds.  Rounding is monotone, so the interval of
///
///   [a, b] ∘ [c, d]   holds   round(x ∘ y)   for all x in [a, b], y in [c, d]
///
/// for + − × ÷ √, and, operation by operation, all that the formula in F gives in this order: a bound
/// that it keeps is proved.  What may be no number is remembered; a mask is yes, no or either, and of
/// `either` select gives the hull of both sides.
///
/// Which arithmetic F has is said by the thread's Rounding (rounding.h), so that a formula is compiled once for it:
/// IEEE 754's, with subnormals or without, contracted or not, or all that Vulkan allows a GPU.
///
/// Four things make it narrower than intervals are:
///   - a value knows itself, copied or negated: x · x is no product of two, x − x is 0, max(x, −x) is |x|;
///   - a mask knows what it compared: of `select(0 < x, x, 1)` the first side is above 0;
///   - zeros have their sign: 1/(x · x) is not below 0;
///   - a value knows by which inputs it only rises or only falls, rounding included: its bounds over the box
///     are then those at the box's faces (prove.h uses it).
///
/// exp and log: of Half one rounding of the true value; of float and double they are within 1 ulp of it, and not above
/// 1 for exp(x ≤ 0).  glibc's err by less; the double ones are used here to bound them.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "number/enclosure_mask.h"
#include "number/half.h"
#include "number/real.h"
#include "number/rounding.h"

namespace gonio::inline GONIO_ARCH {

/// \tparam F  Half, float or double
template <class F>
class Enclosure {
 public:
  Enclosure() = default;
  explicit Enclosure(std::same_as<int> auto x) : Enclosure(point(nearest(x))) {}
  explicit Enclosure(F x) : Enclosure(point(static_cast<double>(x))) {}
  /// Enclosure in another number, rounded to F.
  template <class G>
  explicit Enclosure(const Enclosure<G>& x) requires(!std::same_as<F, G>)
      : Enclosure(made(rounding_now,
                       rounded(rounding_now, x.low(), false),
                       rounded(rounding_now, x.high(), true),
                       x.may_be_nan(),
                       x.directions())) {}
  /// A value that may be anything from low to high.  Its copies are the same value; two inputs that are free of
  /// one another are two of these.
  static Enclosure between(F low, F high) {
    return named(static_cast<double>(low), static_cast<double>(high), false);
  }
  /// Input of that number, by which results say whether they rise or fall.
  static Enclosure input(F low, F high, std::size_t number) {
    Enclosure x = between(low, high);
    x.by_ = Directions::rising(number);
    return x;
  }

  /// Hull of a formula's values over all ways through its comparisons, which is narrower than what select makes of
  /// each; as it is where there are more ways than `most`.
  static Enclosure over_all_ways(auto&& formula, int most = 16) {
    EnclosurePaths paths;
    Enclosure all;
    for (int way = 0; way < most; ++way) {
      const Enclosure one = [&] {
        const EnclosurePathsScope scope(paths);
        return formula();
      }();
      if (way == 0)
        all = one;
      else
        all.join(one);
      if (!paths.advance()) {
        // Of two inputs each may go another way, which says nothing of rise and fall.
        if (way > 0) all.by_ = all.by_.unknown();
        return all;
      }
    }
    return formula();
  }

  double low() const { return lo_; }
  double high() const { return hi_; }
  bool may_be_nan() const { return nan_; }
  const Directions& directions() const { return by_; }
  bool may_be_subnormal() const { return near_zero() && !(lo_ == 0 && hi_ == 0); }
  bool is_finite() const { return !nan_ && std::isfinite(lo_) && std::isfinite(hi_); }
  bool holds(double x) const { return std::isnan(x) ? nan_ : lo_ <= x && x <= hi_; }

  /// Neighbour of x in F towards `to`.
  static double after(double x, double to) {
    if (x == to) return x;
    if (digits_of == 53) return std::nextafter(x, to);
    if (digits_of == 24)
      return static_cast<double>(std::nextafter(static_cast<float>(x), static_cast<float>(to)));
    if (x == 0) return to > 0 ? least_step : -least_step;
    if (std::isinf(x)) return std::copysign(65504.0, x);
    const double size = std::abs(x);
    const bool outwards = (to > x) == (x > 0);
    int exponent = std::ilogb(size);
    if (!outwards && std::ldexp(1.0, exponent) == size) --exponent;
    const double step = std::max(std::ldexp(1.0, exponent + 1 - digits_of), least_step);
    const double moved = size + (outwards ? step : -step);
    return std::copysign(moved > 65504 ? infinity : moved, x);
  }

  friend Enclosure operator-(const Enclosure& a) {
    Enclosure r = a;
    r.lo_ = -a.hi_;
    r.hi_ = -a.lo_;
    r.id_ = -a.id_;
    r.by_ = a.by_.reversed();
    r.factors_[0] = -a.factors_[1];
    r.factors_[1] = -a.factors_[0];
    return r;
  }

  friend Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule), y = b.read(rule);
    const bool fused = rule.contracted && (x.product_ || y.product_);
    const bool nan = x.nan_ || y.nan_ || (x.hi_ == infinity && y.lo_ == -infinity) ||
                     (x.lo_ == -infinity && y.hi_ == infinity);
    if (x.id_ && x.id_ == -y.id_ && !fused && !x.subnormal(rule))
      return made(rule, 0, 0, nan, x.by_);
    Enclosure r = made(rule, sum(rule, x.lo_, y.lo_, false), sum(rule, x.hi_, y.hi_, true), nan,
                       x.by_ | y.by_);
    if (fused) {
      if (x.product_) r.join(x.fused_with(rule, y));
      if (y.product_) r.join(y.fused_with(rule, x));
    }
    return r;
  }
  friend Enclosure operator-(const Enclosure& a, const Enclosure& b) { return a + -b; }

  friend Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule), y = b.read(rule);
    if (x.id_ && (x.id_ == y.id_ || x.id_ == -y.id_)) {
      const Enclosure s = x.squared(rule);
      return x.id_ == y.id_ ? s : -s;
    }
    Hull p;
    for (const double i : {x.lo_, x.hi_})
      for (const double j : {y.lo_, y.hi_}) p.take(i * j);
    const bool nan =
        x.nan_ || y.nan_ || (x.holds(0) && y.has_infinity()) || (y.holds(0) && x.has_infinity());
    Enclosure r = made(rule, rounded(rule, p.lo, false), rounded(rule, p.hi, true), nan,
                       x.by_.times(y.lo_, y.hi_) | y.by_.times(x.lo_, x.hi_));
    r.product_ = true;
    r.factors_ = {x.lo_, x.hi_, y.lo_, y.hi_};
    return r;
  }

  friend Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule), y = b.read(rule);
    const bool nan =
        x.nan_ || y.nan_ || (x.holds(0) && y.holds(0)) || (x.has_infinity() && y.has_infinity());
    const Directions by = (y.lo_ > 0 || y.hi_ < 0)
                              ? x.by_.times(y.lo_, y.hi_) | y.by_.reversed().times(x.lo_, x.hi_)
                              : (x.by_ | y.by_).unknown();
    if (rule.any_gpu) {
      constexpr double most = digits_of < 24 ? 0x1p14 : 0x1p126;
      const double nearest_0 = std::min(std::abs(y.lo_), std::abs(y.hi_));
      if (nan || y.lo_ * y.hi_ <= 0 || nearest_0 < 1 / most ||
          std::max(std::abs(y.lo_), std::abs(y.hi_)) > most)
        return anything(by);
    }
    Hull q;  // by a divisor of one sign the quotient is monotone, so its ends are at corners
    const auto divide = [&](double from, double to) {
      for (const double i : {x.lo_, x.hi_})
        for (const double j : {from, to}) q.take(i / j);
    };
    if (negative(y.lo_)) divide(y.lo_, negative(y.hi_) ? y.hi_ : -0.0);
    if (!negative(y.hi_)) divide(negative(y.lo_) ? 0.0 : y.lo_, y.hi_);
    if (rule.any_gpu) return spread(rule, q.lo, q.hi, 2.5, 2.5, 0, by);
    return made(rule, nearest(q.lo), nearest(q.hi), nan, by);
  }

  friend Enclosure operator+(std::same_as<int> auto s, const Enclosure& a) {
    return Enclosure(s) + a;
  }
  friend Enclosure operator+(const Enclosure& a, std::same_as<int> auto s) {
    return a + Enclosure(s);
  }
  friend Enclosure operator-(std::same_as<int> auto s, const Enclosure& a) {
    return Enclosure(s) - a;
  }
  friend Enclosure operator-(const Enclosure& a, std::same_as<int> auto s) {
    return a - Enclosure(s);
  }
  friend Enclosure operator*(std::same_as<int> auto s, const Enclosure& a) {
    return Enclosure(s) * a;
  }
  friend Enclosure operator*(const Enclosure& a, std::same_as<int> auto s) {
    return a * Enclosure(s);
  }
  friend Enclosure operator/(std::same_as<int> auto s, const Enclosure& a) {
    return Enclosure(s) / a;
  }
  friend Enclosure operator/(const Enclosure& a, std::same_as<int> auto s) {
    return a / Enclosure(s);
  }

  friend EnclosureMask operator<(const Enclosure& a, const Enclosure& b) { return less(a, b); }

  friend Enclosure sqrt(const Enclosure& a) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule);
    if (rule.any_gpu) {
      if (x.nan_ || !(x.lo_ >= 0) || x.hi_ == infinity) return anything(x.by_.unknown());
      if (x.hi_ == 0) return made(rule, 0, 0, false, {});
      return spread(rule, std::sqrt(x.lo_), std::sqrt(x.hi_), 4.51, 4.51, 0, x.by_.unknown());
    }
    const double lo = x.lo_ < 0 ? -0.0 : x.lo_, hi = x.hi_ < 0 ? infinity : x.hi_;
    return made(rule, nearest(std::sqrt(lo)), nearest(std::sqrt(hi)), x.nan_ || x.lo_ < 0, x.by_);
  }

  friend Enclosure exp(const Enclosure& a) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule);
    const Directions by = x.by_.unknown();
    const double lo = std::exp(x.lo_), hi = std::exp(x.hi_);
    if (rule.any_gpu) {
      if (x.nan_ || x.has_infinity()) return anything(by);
      const auto ulps = [](double at) { return (digits_of < 24 ? 1 : 3) + 2 * std::abs(at); };
      // Where e^x is subnormal the last digit is no longer in proportion to it, and there are more
      // of them.
      const double steps = lo < least_normal ? ulps(x.lo_) : ulps(x.hi_);
      return finite_or_anything(
          spread(rule, lo, hi, ulps(x.lo_), ulps(x.hi_), steps * least_step, by));
    }
    if (digits_of < 24)
      return made(rule, nearest(lo * (1 - slack)), nearest(hi * (1 + slack)), x.nan_, by);
    Enclosure r = spread(rule, lo, hi, library_ulps, library_ulps, 0, by);
    r.lo_ = std::max(r.lo_, 0.0);
    if (x.hi_ <= 0) r.hi_ = std::min(r.hi_, 1.0);
    if (x.lo_ == 0 && x.hi_ == 0) r = with_bounds(1, 1, false, by);
    r.nan_ = x.nan_;
    return r;
  }

  friend Enclosure log(const Enclosure& a) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule);
    const Directions by = x.by_.unknown();
    if (rule.any_gpu && (x.nan_ || !(x.lo_ > 0) || x.hi_ == infinity)) return anything(by);
    const bool nan = x.nan_ || x.lo_ < 0;
    const double lo = std::log(std::max(x.lo_, 0.0)), hi = std::log(x.hi_ < 0 ? infinity : x.hi_);
    if (rule.any_gpu) {
      const double about_1 = x.lo_ <= 2 && x.hi_ >= 0.5 ? (digits_of < 24 ? 0x1p-7 : 0x1p-21) : 0;
      return spread(rule, lo, hi, 3, 3, about_1, by);
    }
    if (digits_of < 24)
      return made(rule, nearest(lo - std::abs(lo) * slack), nearest(hi + std::abs(hi) * slack), nan,
                  by);
    Enclosure r = spread(rule, lo, hi, library_ulps, library_ulps, 0, by);
    if (x.lo_ == 1) r.lo_ = 0;
    if (x.hi_ == 1) r.hi_ = 0;
    r.nan_ = nan;
    return r;
  }

 private:
  friend struct RealTraits<Enclosure>;
  using Limits = std::numeric_limits<F>;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int digits_of = Limits::digits;
  static constexpr double library_ulps = 1;  // of exp and log of float and double
  static constexpr double slack = 0x1p-50;   // more than double's own errors
  inline static const double least_normal = std::ldexp(1.0, Limits::min_exponent - 1);
  inline static const double least_step = std::ldexp(1.0, Limits::min_exponent - digits_of);
  /// Size of the last digit of Vulkan's bounds over the value: of double they are float's.
  inline static const double gpu_unit = std::ldexp(1.0, 1 - std::min(digits_of, 24));

  /// Sums, products, quotients and roots of F, computed in double first, are as if rounded once: 53 ≥ 2 · 24 + 2.
  static double nearest(double x) { return static_cast<double>(static_cast<F>(x)); }
  static bool negative(double x) { return std::signbit(x); }

  /// Value of F next to x on the side told, or x.
  static double outwards(double x, bool up) {
    const double n = nearest(x);
    return up ? (n < x ? after(n, infinity) : n) : (n > x ? after(n, -infinity) : n);
  }

  /// Bound of what x, an exact end, is rounded to; `rest` is what x was rounded off by.
  static double rounded(const Rounding& rule, double x, bool up, double rest = 0) {
    if (!rule.any_gpu) return nearest(x);
    if (digits_of == 53)
      return std::isinf(x) ? x : x + (up ? 1 : -1) * (std::abs(x) * gpu_unit + least_step);
    if ((up && rest > 0) || (!up && rest < 0)) x = std::nextafter(x, up ? infinity : -infinity);
    return outwards(x, up);
  }
  static double sum(const Rounding& rule, double a, double b, bool up) {
    const double s = a + b;
    if (std::isnan(s)) return up ? infinity : -infinity;
    if (std::isinf(s)) return s;
    return rounded(rule, s, up, sum_rest(a, b, s));
  }
  /// a + b − s exactly, where s is their sum rounded                                    [Knuth 1969]
  static double sum_rest(double a, double b, double s) {
    const double of_b = s - a;
    return (a - (s - of_b)) + (b - of_b);
  }

  /// Hull of what is taken, −0 below 0; of no number none.
  struct Hull {
    double lo = infinity, hi = -infinity;
    bool any = false;
    void take(double x) {
      if (std::isnan(x)) return;
      if (!any || x < lo || (x == lo && negative(x))) lo = x;
      if (!any || x > hi || (x == hi && !negative(x))) hi = x;
      any = true;
    }
  };

  static Enclosure point(double x) {
    Enclosure r;
    r.lo_ = r.hi_ = x;
    r.nan_ = std::isnan(x);
    if (r.nan_) r.lo_ = -infinity, r.hi_ = infinity;
    return r;
  }
  /// Names no two values have, whichever thread made them; that of a constant is 0.
  static Enclosure named(double lo, double hi, bool nan) {
    static std::atomic<std::int64_t> threads = 0;
    static thread_local std::int64_t last = threads++ << 44;
    Enclosure r;
    r.lo_ = lo;
    r.hi_ = hi;
    r.nan_ = nan;
    if (lo != hi) r.id_ = ++last;
    return r;
  }
  static Enclosure anything(Directions by) {
    Enclosure r = named(-infinity, infinity, true);
    r.by_ = by.unknown();
    return r;
  }
  /// Result of a function, of which Vulkan preserves no infinity whatever a shader declares.
  static Enclosure finite_or_anything(const Enclosure& r) {
    return r.is_finite() ? r : anything(r.by_);
  }
  /// Result of an operation with these ends.
  static Enclosure made(const Rounding& rule, double lo, double hi, bool nan, Directions by) {
    if (!(lo <= hi)) return anything(by);  // no number at all
    if (rule.flushed) {
      if (lo > 0 && lo <= least_normal) lo = 0;
      if (hi < 0 && hi >= -least_normal) hi = -0.0;
    }
    if (rule.any_gpu) {
      if (!rule.infinities && (nan || std::isinf(lo) || std::isinf(hi))) return anything(by);
      if (lo == 0) lo = -0.0;
      if (hi == 0) hi = 0.0;
      by = by.unknown();  // of two neighbours either: nothing need be monotone
    }
    Enclosure r = named(lo, hi, nan);
    r.by_ = by;
    return r;
  }
  /// Result whose true value lies between lo and hi, and which errs by a number of last digits; more by `off`.
  static Enclosure spread(const Rounding& rule,
                          double lo,
                          double hi,
                          double ulps_lo,
                          double ulps_hi,
                          double off,
                          Directions by) {
    const double unit = rule.any_gpu ? gpu_unit : std::ldexp(1.0, 1 - digits_of);
    const auto moved = [&](double x, double ulps, double sign) {
      if (std::isinf(x)) return x;
      const double error =
          std::max({std::abs(x) * (ulps * unit + slack), ulps * least_step, off + slack * off});
      return outwards(x + sign * error, sign > 0);
    };
    return made(rule, moved(lo, ulps_lo, -1), moved(hi, ulps_hi, 1), false, by);
  }

  bool has_infinity() const { return lo_ == -infinity || hi_ == infinity; }
  bool holds_negative_zero() const { return negative(lo_) && hi_ >= 0; }
  bool near_zero() const { return lo_ < least_normal && hi_ > -least_normal; }
  /// True where subnormals are flushed and this may be one.
  bool subnormal(const Rounding& rule) const { return rule.flushed && may_be_subnormal(); }
  /// This as an operation reads it.
  Enclosure read(const Rounding& rule) const {
    Enclosure r = *this;
    if (rule.flushed) {
      if (lo_ > 0 && lo_ < least_normal) r.lo_ = 0;
      if (hi_ < 0 && hi_ > -least_normal) r.hi_ = -0.0;
    }
    return r;
  }
  void join(const Enclosure& other) {
    Hull h;
    for (const double x : {lo_, hi_, other.lo_, other.hi_}) h.take(x);
    *this = with_bounds(h.lo, h.hi, nan_ || other.nan_, by_ | other.by_);
  }
  static Enclosure with_bounds(double lo, double hi, bool nan, Directions by) {
    Enclosure r = named(lo, hi, nan);
    r.by_ = by;
    return r;
  }

  Enclosure squared(const Rounding& rule) const {
    const double most = std::max(std::abs(lo_), std::abs(hi_));
    const double least = holds(0) ? 0 : std::min(std::abs(lo_), std::abs(hi_));
    Enclosure r = made(rule, rounded(rule, least * least, false), rounded(rule, most * most, true),
                       nan_, by_.times(lo_, hi_));
    r.product_ = true;
    r.factors_ = {least, most, least, most};
    return r;
  }

  /// a b + c rounded once, of a product a b and of c.
  Enclosure fused_with(const Rounding& rule, const Enclosure& c) const {
    Hull h;
    bool nan = c.nan_ || nan_;
    const auto fma = [&](double a, double b, double end, bool up) {
      if (digits_of == 53) {
        const double r = std::fma(a, b, end);
        return rule.any_gpu ? rounded(rule, r, up) : r;
      }
      const double p = a * b, s = p + end;  // p is exact
      if (!std::isfinite(s)) return s;
      const double rest = sum_rest(p, end, s);
      if (rule.any_gpu) return rounded(rule, s, up, rest);
      return nearest(to_odd(s, rest));
    };
    for (const double a : {factors_[0], factors_[1]})
      for (const double b : {factors_[2], factors_[3]}) {
        const double low = fma(a, b, c.lo_, false), high = fma(a, b, c.hi_, true);
        nan = nan || std::isnan(low) || std::isnan(high);
        h.take(low);
        h.take(high);
      }
    return made(rule, h.lo, h.hi, nan, by_ | c.by_);
  }
  /// s, or its neighbour on the side of the rest, whose last digit is odd: it rounds on as s + rest would.
  ///                                                                     [Boldo & Melquiond 2008]
  static double to_odd(double s, double rest) {
    if (rest == 0 || (std::bit_cast<std::uint64_t>(s) & 1)) return s;
    return std::nextafter(s, rest > 0 ? infinity : -infinity);
  }

  /// This where a comparison had the outcome that these bounds belong to; not a number: it had another.
  Enclosure within(const EnclosureMask::Bounds& bounds, bool held) const {
    Enclosure r = *this;
    for (const auto& bound : bounds) {
      if (bound.id == 0 || (bound.id != id_ && bound.id != -id_)) continue;
      const bool same = bound.id == id_, below = bound.below == same;
      const double x = same ? bound.x : -bound.x;
      if (below && x < r.hi_) r.hi_ = x;
      if (!below && x > r.lo_) r.lo_ = x;
      if (held && !(rounding_now.any_gpu && !rounding_now.infinities)) r.nan_ = false;
    }
    if (!(r.lo_ <= r.hi_)) return *this;
    return r;
  }
  static EnclosureMask less(const Enclosure& a, const Enclosure& b) {
    const Rounding& rule = rounding_now;
    const Enclosure x = a.read(rule), y = b.read(rule);
    EnclosureMask m(x.lo_ < y.hi_, x.hi_ >= y.lo_ || x.nan_ || y.nan_);
    m.inputs_ = x.by_ | y.by_;
    if (enclosure_paths && m.can_hold_ && m.can_fail_) {
      m.can_hold_ = enclosure_paths->next();
      m.can_fail_ = !m.can_hold_;
    }
    // What is flushed for the comparison alone makes it tell less.
    const auto tells = [&](const Enclosure& of, bool held) {
      return !of.subnormal(rule) && (held || !rule.flushed || !of.holds(0));
    };
    if (tells(b, true)) m.held_[0] = {a.id_, true, after(b.hi_, -infinity)};
    if (tells(a, true)) m.held_[1] = {b.id_, false, after(a.lo_, infinity)};
    if (tells(b, false)) m.failed_[0] = {x.nan_ || y.nan_ ? 0 : a.id_, false, b.lo_};
    if (tells(a, false)) m.failed_[1] = {x.nan_ || y.nan_ ? 0 : b.id_, true, a.hi_};
    return m;
  }
  static Enclosure select(const EnclosureMask& m, const Enclosure& a, const Enclosure& b) {
    if (!m.can_fail_) return a.within(m.held_, true);
    if (!m.can_hold_) return b.within(m.failed_, false);
    Enclosure r = a.within(m.held_, true);
    r.join(b.within(m.failed_, false));
    r.by_ = (a.by_ | b.by_ | m.inputs_).unknown();
    return r;
  }
  /// Maximum as gonio::max chooses it, and as a GPU may: of what is no number the other.
  static Enclosure max(const Enclosure& a, const Enclosure& b) {
    // Flushed for the comparison alone, subnormals are all alike: the lesser may be taken.
    const Rounding& rule = rounding_now;
    const bool alike = rule.flushed && a.near_zero() && b.near_zero();
    if (!a.nan_ && !b.nan_ && !alike) {
      if (a.lo_ >= b.hi_) return a;
      if (b.lo_ > a.hi_) return b;
    }
    double lo = std::max(a.lo_, b.lo_), hi = std::max(a.hi_, b.hi_);
    Directions by = a.by_ | b.by_;
    if (a.id_ && a.id_ == -b.id_) {
      lo = a.holds(0) ? 0 : std::min(std::abs(a.lo_), std::abs(a.hi_));
      by = a.by_.times(a.lo_, a.hi_);
    }
    // Of zeros either is taken, whatever its sign.
    if (lo == 0 && (a.holds_negative_zero() || b.holds_negative_zero())) lo = -0.0;
    if (hi == 0 && !(negative(a.hi_) && negative(b.hi_))) hi = 0.0;
    if (alike) lo = std::min(lo, std::max(std::min(a.lo_, b.lo_), -least_normal));
    Enclosure r = with_bounds(lo, hi, a.nan_ || b.nan_, by);
    if (a.nan_ || b.nan_) {
      r.join(a);
      r.join(b);
      r.by_ = r.by_.unknown();
    }
    return r;
  }
  static Enclosure min(const Enclosure& a, const Enclosure& b) { return -max(-a, -b); }

  double lo_ = 0, hi_ = 0;
  std::int64_t id_ = 0;  // the value's name; −id: the same negated; 0: a constant
  Directions by_;
  bool nan_ = false, product_ = false;  // may be no number; is a product of
  std::array<double, 4> factors_{};     // factors from [0] to [1] and from [2] to [3]
};

template <class F>
struct RealTraits<Enclosure<F>> {
  using Base = F;
  using Plain = Enclosure<F>;
  using Mask = EnclosureMask;
  static Plain select(const Mask& m, const Plain& a, const Plain& b) {
    return Plain::select(m, a, b);
  }
  static Plain max(const Plain& a, const Plain& b) { return Plain::max(a, b); }
  static Plain min(const Plain& a, const Plain& b) { return Plain::min(a, b); }
  static auto roomy(const Plain& x) requires requires(const F& f) { RealTraits<F>::roomy(f); }
  { return Enclosure<decltype(RealTraits<F>::roomy(F()))>(x); }
};

}  // namespace gonio::inline GONIO_ARCH

template <class F>
class std::numeric_limits<gonio::Enclosure<F>> : public std::numeric_limits<F> {};
