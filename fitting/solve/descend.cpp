#include "fitting/solve/descend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fitting/solve/matrix.h"

#include <Eigen/Cholesky>

namespace gonio {
namespace {

/// A x of an arrow matrix.
std::vector<double> times(const ArrowMatrix& m, const std::vector<double>& x) {
  const auto& layout = m.layout();
  std::vector<double> y(x.size());
  const auto& head = layout.head();
  for (std::size_t i = 0; i < head.size(); ++i)
    for (std::size_t j = 0; j < head.size(); ++j)
      y[head[i]] += m.head()[i * head.size() + j] * x[head[j]];
  for (std::size_t a = 0; a < layout.arms().size(); ++a) {
    const auto& arm = layout.arms()[a];
    for (std::size_t i = 0; i < arm.size(); ++i) {
      for (std::size_t j = 0; j < arm.size(); ++j)
        y[arm[i]] += m.own(a)[i * arm.size() + j] * x[arm[j]];
      for (std::size_t j = 0; j < head.size(); ++j) {
        const double b = m.border(a)[i * head.size() + j];
        y[arm[i]] += b * x[head[j]];
        y[head[j]] += b * x[arm[i]];
      }
    }
  }
  return y;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Solution y of (S H S + λ) y = S r with S = diag(H)^(−1/2), some unknowns left out, as S y; arms are
/// eliminated one by one.  None where rounding leaves no positive matrix.
std::optional<std::vector<double>> damped_solution(const ArrowMatrix& h,
                                                   const std::vector<double>& r,
                                                   double lambda,
                                                   const std::vector<bool>& out) {
  const auto& layout = h.layout();
  const auto scale_of = [&](const std::vector<std::size_t>& unknowns) {
    Eigen::VectorXd s(index(unknowns.size()));
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      s[index(i)] = out[unknowns[i]] ? 0 : 1 / std::sqrt(h(unknowns[i], unknowns[i]));
    return s;
  };
  const auto part_of = [&](const std::vector<std::size_t>& unknowns, const Eigen::VectorXd& s) {
    Eigen::VectorXd v(s.size());
    for (std::size_t i = 0; i < unknowns.size(); ++i) v[index(i)] = s[index(i)] * r[unknowns[i]];
    return v;
  };
  const auto damped = [&](const double* entries, const Eigen::VectorXd& s) {
    const Eigen::Map<const RowMajor> m(entries, s.size(), s.size());
    Eigen::MatrixXd a = s.asDiagonal() * m * s.asDiagonal();
    for (Eigen::Index i = 0; i < s.size(); ++i) a(i, i) = 1 + lambda;
    return a;
  };
  const auto& head = layout.head();
  const Eigen::VectorXd head_scale = scale_of(head);
  Eigen::MatrixXd complement = damped(h.head(), head_scale);
  Eigen::VectorXd right = part_of(head, head_scale);
  struct Arm {
    Eigen::VectorXd scale, y;
    Eigen::MatrixXd w;
    Eigen::LLT<Eigen::MatrixXd> root;
  };
  std::vector<Arm> arms(layout.arms().size());
  for (std::size_t a = 0; a < arms.size(); ++a) {
    Arm& arm = arms[a];
    arm.scale = scale_of(layout.arms()[a]);
    arm.root.compute(damped(h.own(a), arm.scale));
    if (arm.root.info() != Eigen::Success) return {};
    const Eigen::Map<const RowMajor> border(h.border(a), arm.scale.size(), head_scale.size());
    arm.w = arm.scale.asDiagonal() * border * head_scale.asDiagonal();
    arm.root.matrixL().solveInPlace(arm.w);
    arm.y = arm.root.matrixL().solve(part_of(layout.arms()[a], arm.scale));
    complement -= arm.w.transpose() * arm.w;
    right -= arm.w.transpose() * arm.y;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(complement);
  if (root.info() != Eigen::Success) return {};
  const Eigen::VectorXd y = root.solve(right);
  std::vector<double> x(h.size());
  for (std::size_t i = 0; i < head.size(); ++i) x[head[i]] = head_scale[index(i)] * y[index(i)];
  for (std::size_t a = 0; a < arms.size(); ++a) {
    const Eigen::VectorXd z =
        arms[a].root.matrixU().solve(Eigen::VectorXd(arms[a].y - arms[a].w * y));
    const auto& unknowns = layout.arms()[a];
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      x[unknowns[i]] = arms[a].scale[index(i)] * z[index(i)];
  }
  return x;
}

/// Step of damping λ inside the bounds, and what the quadratic model promises of it.
struct Step {
  std::vector<double> to;
  double decrease = 0;
};
std::optional<Step> step_from(const NormalEquations& e,
                              const std::vector<double>& x,
                              const Bounds& bounds,
                              double lambda) {
  const std::size_t n = x.size();
  // Derivatives of an unknown without effect are rounding, which may look like another's.
  const double least = 1e-20 * e.cost;
  const auto has_effect = [&](std::size_t i) {
    const double range = bounds.high[i] - bounds.low[i];
    return e.h(i, i) * range * range > least;
  };
  std::vector<bool> out(n);
  for (std::size_t i = 0; i < n; ++i)
    out[i] = !has_effect(i) || (x[i] <= bounds.low[i] && e.g[i] >= 0) ||
             (x[i] >= bounds.high[i] && e.g[i] <= 0);
  std::vector<double> by(n);  // of those that have met a bound
  for (std::size_t round = 0; round <= n; ++round) {
    auto right = times(e.h, by);
    for (std::size_t i = 0; i < n; ++i) right[i] = -e.g[i] - right[i];
    const auto solution = damped_solution(e.h, right, lambda, out);
    if (!solution) return {};
    bool met = false;
    Step s{x, 0};
    auto whole = by;
    for (std::size_t i = 0; i < n; ++i) {
      if (out[i]) continue;
      whole[i] = (*solution)[i];
      const double inside = std::clamp(x[i] + whole[i], bounds.low[i], bounds.high[i]);
      if (inside == x[i] + whole[i]) continue;
      met = out[i] = true;
      by[i] = inside - x[i];
    }
    if (met) continue;
    for (std::size_t i = 0; i < n; ++i)
      s.to[i] = std::clamp(x[i] + whole[i], bounds.low[i], bounds.high[i]);
    s.decrease = -dot(e.g, whole) - dot(whole, times(e.h, whole)) / 2;
    return s;
  }
  return {};
}

/// Bounds of the next step.
Bounds within_reach(Bounds b, const std::vector<double>& x, std::span<const double> origins) {
  constexpr double factor = 3;
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const double away = x[i] - origins[i];
    if (std::isnan(away) || away == 0) continue;
    const double nearer = origins[i] + away / factor, farther = origins[i] + away * factor;
    b.low[i] = std::max(b.low[i], std::min(nearer, farther));
    b.high[i] = std::min(b.high[i], std::max(nearer, farther));
  }
  return b;
}

}  // namespace

Descent descend(const NormalEquationsAt& evaluate,
                std::vector<double>& x,
                const Bounds& bounds,
                const DescentOptions& options,
                std::span<const double> origins) {
  constexpr double first_damping = 1e-6, least_damping = 1e-12, most_damping = 1e10;
  Descent d;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], bounds.low[i], bounds.high[i]);
  NormalEquations e = evaluate(x);
  d.passes = 1;
  d.cost = is_finite(e) ? e.cost : std::numeric_limits<double>::infinity();
  double lambda = first_damping;
  while (std::isfinite(d.cost) && d.passes < options.max_passes && lambda < most_damping) {
    const auto step = step_from(e, x, within_reach(bounds, x, origins), lambda);
    if (!step) {
      lambda = 10 * std::max(lambda, first_damping);
      continue;
    }
    if (!(step->decrease > options.tolerance * e.cost)) {
      d.settled = true;
      break;
    }
    auto there = evaluate(step->to);
    ++d.passes;
    if (!(is_finite(there) && there.cost < e.cost)) {
      lambda = 10 * std::max(lambda, 1e-3);
      continue;
    }
    const double kept = (e.cost - there.cost) / step->decrease;
    lambda = kept > 0.75   ? std::max(lambda / 10, least_damping)
             : kept < 0.25 ? 4 * std::max(lambda, first_damping)
                           : lambda;
    x = step->to;
    e = std::move(there);
    d.cost = e.cost;
  }
  return d;
}

}  // namespace gonio
