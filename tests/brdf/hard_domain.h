#pragma once
/// \file
/// Parameters and angles where formulas lose their digits, for tests over the whole catalogue.

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "brdf/terms.h"

namespace gonio::test {

/// Draws that crowd at the ends of what formulas are given.
class HardDraws {
 public:
  /// \param least_width  below 1e-4, where what is legal begins, too
  explicit HardDraws(std::uint64_t seed, double least_width = 1e-6)
      : random_(seed), least_width_(least_width) {}

  /// Parameters of a term.
  Parameters parameters(std::span<const Parameter> all) {
    Parameters p;
    for (const auto& q : all) p.push_back(value(q));
    return p;
  }
  /// Angles that belong together: h from the peak to the horizon, light and viewer at all heights.
  Row angles(const TermEntry& t, const Parameters& p) {
    const double h = std::asin(below_one(1e-12)), phi_h = uniform(-3, 3);
    const double l = cosine(), v = cosine(), phi_l = uniform(-3, 3), phi_v = uniform(-3, 3);
    const auto sine = [](double c) { return std::sqrt((1 - c) * (1 + c)); };
    const double sin_h = std::sin(h);
    double voh = std::max(cosine(), (l + v) / 2);
    if (t.role() == Role::fresnel && !t.parameters.empty() && t.parameters[0].name == "eta") {
      // about where total reflection begins
      const double k = t.parameters.size() > 1 ? p[1] : 0, q = 1 - p[0] * p[0] + k * k;
      if (one_in(3) && 0 < q && q < 1)
        voh = std::min(1.0, std::sqrt(q) * (1 + sign() * by_factors(1e-11, 0.1)));
    }
    return {{l, v, std::cos(h), voh, sin_h * sin_h},
            sin_h * std::cos(phi_h),
            sin_h * std::sin(phi_h),
            sine(l) * std::cos(phi_l),
            sine(l) * std::sin(phi_l),
            sine(v) * std::cos(phi_v),
            sine(v) * std::sin(phi_v)};
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  double by_factors(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool one_in(int n) { return std::uniform_int_distribution(1, n)(random_) == 1; }
  double sign() { return one_in(2) ? 1 : -1; }
  double below_one(double least) {
    if (one_in(4)) return uniform(0, 1);
    return one_in(3) ? 1 - by_factors(1e-12, 1) : by_factors(least, 1);
  }
  double cosine() { return one_in(8) ? 1 : below_one(1e-8); }
  double value(const Parameter& q) {
    const auto [low, high] = q.legal;
    if (q.name.starts_with("alpha"))
      return one_in(8) ? 1 : std::clamp(below_one(least_width_), least_width_, high);
    if (one_in(10)) return low;
    if (one_in(10)) return high;
    if (q.legal.holds(1) && high > 1 && one_in(3))
      return std::clamp(1 + sign() * by_factors(1e-14, 0.1), low, high);
    return low == 0 ? high * below_one(1e-12) : by_factors(low, high);
  }

  std::mt19937_64 random_;
  double least_width_;
};

}  // namespace gonio::test
