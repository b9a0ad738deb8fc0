#include "integrate/albedo/ggx_albedo.h"

#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "brdf/formula/masking.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/cubature.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// A direction by the tangent τ of half its elevation; 1 − τ beside it, which near the normal cancels.
struct Elevation {
  double tau, rest;
};
Elevation elevation(double mu) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  return {mu / (1 + sine), (1 - mu + sine) / (1 + sine)};
}

/// The line that E is integrated over: below `join` the horizon's part, above it the peak's.
class Line {
 public:
  Line(double alpha, double mu)
      : v_(elevation(mu)),
        width_(alpha * (1 + square(v_.tau))),
        layer_(std::min(alpha, mu) / 2),
        low_(0),
        join_(0),
        high_(0) {
    const double tau = std::min(1.0, std::max(v_.tau / 2, width_));
    join_ = std::asinh((tau - v_.tau) / width_);
    low_ = join_ - std::asinh(tau / layer_);
    high_ = std::max(join_, std::asinh(v_.rest / width_));
  }
  std::vector<Rectangle> pieces() const {
    std::vector<Rectangle> all;
    const auto add = [&](double from, double to) {
      const double n = std::ceil((to - from) / longest);
      for (double i = 0; i < n; ++i)
        all.push_back({{from + (to - from) * (i / n), 0}, {from + (to - from) * ((i + 1) / n), 0}});
    };
    add(low_, join_);
    add(join_, high_);
    return all;
  }

  struct Point {
    Elevation l;
    double difference;  ///< τ − τ_v
    double dtau_dx;
  };
  Point operator()(double x) const {
    const bool peak = x > join_;
    const double scale = peak ? width_ : layer_, e = std::exp(peak ? x : x - low_);
    const double from = scale * (e - 1 / e) / 2, slope = scale * (e + 1 / e) / 2;
    if (!peak) return {{from, 1 - from}, from - v_.tau, slope};
    return {{v_.tau + from, std::max(v_.rest - from, 0.0)}, from, slope};
  }
  const Elevation& view() const { return v_; }

 private:
  static constexpr double longest = 4;
  Elevation v_;
  double width_, layer_, low_, join_, high_;
};

template <class Masking>
Bounded albedo_of(const Masking& masking, double alpha, double mu, double error) {
  const Line line(alpha, mu);
  const auto& v = line.view();
  const double alpha2 = square(alpha), k = (1 - alpha) * (1 + alpha);
  const auto f = [&](std::span<const double> x, std::span<const double>,
                     std::span<double* const> out) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto at = line(x[i]);
      const auto& l = at.l;
      const double p = square(at.difference / (1 + l.tau * v.tau)) + alpha2;
      const double q = square((l.rest + l.tau * v.rest) / (l.tau + v.tau)) + alpha2;
      const double r = 1 / std::sqrt(p * q), kr = k * r;
      const double mean = 1 + kr * (2 + kr * (p + q) * r / 2);
      const double one = 1 + square(l.tau), nol = 2 * l.tau / one;
      const double dnol_dtau = 2 * l.rest * (1 + l.tau) / square(one);
      const double visibility = masking({nol, mu, 1, 1, 0}).value();
      out[0][i] = 2 * alpha2 * mean * visibility * nol * dnol_dtau * at.dtau_dx;
    }
  };
  const auto i = integrate(f, 1, line.pieces(), {error, 100'000});
  return {i.value[0], i.error};
}

Bounded albedo_of(SmithGgx masking, double alpha, double mu, double error) {
  const std::array p{alpha};
  return masking == SmithGgx::correlated
             ? albedo_of(SmithGgxCorrelated<double>(p), alpha, mu, error)
             : albedo_of(SmithGgxSeparable<double>(p), alpha, mu, error);
}

}  // namespace

Bounded ggx_albedo(double alpha, double mu, SmithGgx masking, double error) {
  check_range(alpha_parameter, "alpha", alpha);
  check_cosines({&mu, 1});
  return albedo_of(masking, alpha, mu, error);
}

Bounded ggx_average_albedo(double alpha, SmithGgx masking, double error) {
  check_range(alpha_parameter, "alpha", alpha);
  // μ = x²: E may rise from the horizon as μ ln μ.
  double inner = 0;
  const auto f = [&](std::span<const double> x, std::span<const double>,
                     std::span<double* const> out) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto e = albedo_of(masking, alpha, square(x[i]), error / 4);
      out[0][i] = 4 * e.value * square(x[i]) * x[i];
      inner = std::max(inner, e.error);
    }
  };
  const auto i = integrate(f, 1, {{{0, 0}, {1, 0}}}, {error / 2, 10'000});
  return {i.value[0], i.error + inner};
}

std::vector<Bounded> ggx_albedo_table(std::span<const double> alpha,
                                      std::span<const double> mu,
                                      SmithGgx masking,
                                      double error) {
  for (const double a : alpha) check_range(alpha_parameter, "alpha", a);
  check_cosines(mu);
  std::vector<Bounded> table(alpha.size() * mu.size());
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t i) {
    table[i] = albedo_of(masking, alpha[i / mu.size()], mu[i % mu.size()], error);
  });
  return table;
}

}  // namespace gonio
