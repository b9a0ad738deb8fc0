#pragma once
/// \file
/// Bounds of a real number, which is what an exact formula gives, where an enclosure (enclosure.h) has what a machine
/// makes of it: ends in double, exact where they can be, else the next double outwards.

#include <algorithm>
#include <cmath>
#include <limits>

#include "number/exact.h"

namespace gonio::inline GONIO_ARCH {

struct Interval {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double low = -infinity, high = infinity;

  static Interval holding(long double x) {
    const auto near = static_cast<double>(x);
    const bool exact = static_cast<long double>(near) == x;
    return {outwards(near, exact, false), outwards(near, exact, true)};
  }

  friend Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
  friend Interval operator+(const Interval& a, const Interval& b) {
    return {sum(a.low, b.low, false), sum(a.high, b.high, true)};
  }
  friend Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    return hull(a, b, [](double x, double y) {
      const double p = x * y;
      return End{p, x == 0 || y == 0 || (!small(p) && std::fma(x, y, -p) == 0)};
    });
  }
  friend Interval square(const Interval& a) {
    const Interval s = a * a;
    return {std::max(s.low, 0.0), s.high};
  }
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (!(0 < b.low || b.high < 0)) return {};
    return hull(a, b, [](double x, double y) {
      const double q = x / y;
      return End{q, x == 0 || (!small(q) && !small(x) && std::fma(-q, y, x) == 0)};
    });
  }
  friend Interval sqrt(const Interval& a) {
    if (!(0 <= a.low)) return {};
    const auto root = [](double x, bool up) {
      const double r = std::sqrt(x);
      return outwards(r, x == 0 || (!small(x) && std::fma(-r, r, x) == 0), up);
    };
    return {root(a.low, false), root(a.high, true)};
  }

 private:
  /// End rounded to nearest, and whether that is the end itself.
  struct End {
    double near;
    bool exact;
  };
  static double outwards(double near, bool exact, bool up) {
    const double end = up ? infinity : -infinity;
    if (std::isnan(near)) return end;
    return exact ? near : std::nextafter(near, end);
  }
  /// True of what is so small that its error, 53 digits below it, may be 0 without being so.
  static bool small(double x) { return std::abs(x) < 0x1p-900; }
  static double sum(double a, double b, bool up) {
    const double s = a + b;
    return outwards(s, sum_error(a, b, s) == 0, up);
  }
  static Interval hull(const Interval& a, const Interval& b, auto&& operation) {
    Interval r{infinity, -infinity};
    for (const double x : {a.low, a.high})
      for (const double y : {b.low, b.high}) {
        const End end = operation(x, y);
        r.low = std::min(r.low, outwards(end.near, end.exact, false));
        r.high = std::max(r.high, outwards(end.near, end.exact, true));
      }
    return r;
  }
};

}  // namespace gonio::inline GONIO_ARCH
