// Ceres stays in this file (and in plain_fit.cpp, which is measured against it).
#include "fitting/solve/solve.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <ceres/ceres.h>
#include <fmt/format.h>

namespace gonio {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool is_finite(const NormalEquations& e) {
  return std::isfinite(e.cost) &&
         std::ranges::all_of(e.h, [](double x) { return std::isfinite(x); }) &&
         std::ranges::all_of(e.g, [](double x) { return std::isfinite(x); });
}

/// The next Gauss–Newton step and what it promises.
struct Step {
  Eigen::VectorXd by;
  double decrease = 0;  ///< of the cost: ½ gᵀ H⁻¹ g
};
/// None where some direction is so badly determined that rounding would decide where it leads.
std::optional<Step> next_step(const NormalEquations& e) {
  constexpr double least = 1e-6;
  const auto n = static_cast<Eigen::Index>(e.g.size());
  const auto h = Eigen::Map<const RowMajor>(e.h.data(), n, n);
  if (!is_finite(e) || !(h.diagonal().minCoeff() > 0)) return {};
  const Eigen::VectorXd s = h.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      Eigen::MatrixXd(s.asDiagonal() * h * s.asDiagonal()));
  if (!(eigen.eigenvalues()[0] > least)) return {};
  const Eigen::VectorXd g = s.asDiagonal() * Eigen::Map<const Eigen::VectorXd>(e.g.data(), n);
  const Eigen::VectorXd rotated = eigen.eigenvectors().transpose() * g;
  const Eigen::VectorXd y = rotated.cwiseQuotient(eigen.eigenvalues());
  return Step{-(s.asDiagonal() * (eigen.eigenvectors() * y)), y.dot(rotated) / 2};
}
/// So small a part of the cost that rounding may hide it.
constexpr double hidden = 1e-6;

/// Stops where only rounding is left to work on.
class Enough : public ceres::IterationCallback {
 public:
  Enough(double rounding, double scale, std::function<const NormalEquations&()> best)
      : rounding_(rounding), scale_(scale), best_(std::move(best)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& i) override {
    const double cost = i.cost / scale_, change = std::abs(i.cost_change) / scale_;
    const bool in_vain =
        i.iteration > 0 && !i.step_is_successful && change < std::max(rounding_, 1e-7 * cost);
    const auto step = next_step(best_());
    const bool hides = step && step->decrease < hidden * best_().cost;
    return in_vain || hides || cost < rounding_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                : ceres::SOLVER_CONTINUE;
  }

 private:
  double rounding_, scale_;
  std::function<const NormalEquations&()> best_;
};

/// The cost function described in the header.  Ceres asks for the cost at a trial point first and
/// for its Jacobian after accepting it: one pass over the samples serves both.
class Reduced : public ceres::CostFunction {
 public:
  /// \param scale  of the cost, so that none of Ceres' absolute limits depends on the data's unit
  Reduced(const NormalEquationsAt& evaluate, std::size_t n, double scale)
      : evaluate_(evaluate), scale_(scale) {
    set_num_residuals(static_cast<int>(n) + 1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(n));
  }

  struct Evaluation {
    std::vector<double> x;
    NormalEquations at;
  };
  /// The lowest cost seen: Ceres stops without taking the last step that it looked at.
  const Evaluation& best() const { return best_; }
  int passes() const { return passes_; }
  /// What is known already.
  void known(const std::vector<double>& x, const NormalEquations& e) { best_ = last_ = {x, e}; }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const auto n = static_cast<Eigen::Index>(parameter_block_sizes()[0]);
    const auto& e = at({parameters[0], parameters[0] + n});
    if (!is_finite(e)) return false;
    const RowMajor h = scale_ * Eigen::Map<const RowMajor>(e.h.data(), n, n);
    const Eigen::VectorXd g = scale_ * Eigen::Map<const Eigen::VectorXd>(e.g.data(), n);
    Eigen::VectorXd s = h.diagonal().cwiseSqrt();
    for (auto& d : s) d = d > 0 ? 1 / d : 1;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        Eigen::MatrixXd(s.asDiagonal() * h * s.asDiagonal()));
    const double tiny = 1e-15 * static_cast<double>(n);

    Eigen::Map<Eigen::VectorXd> r(residuals, n + 1);
    r.setZero();
    const Eigen::VectorXd rotated = eigen.eigenvectors().transpose() * (s.asDiagonal() * g);
    for (Eigen::Index i = 0; i < n; ++i)
      if (eigen.eigenvalues()[i] > tiny) r[i] = rotated[i] / std::sqrt(eigen.eigenvalues()[i]);
    r[n] = std::sqrt(std::max(0.0, 2 * scale_ * e.cost - r.head(n).squaredNorm()));
    if (jacobians && jacobians[0]) {
      Eigen::Map<RowMajor> j(jacobians[0], n + 1, n);
      j.setZero();
      for (Eigen::Index i = 0; i < n; ++i)
        if (eigen.eigenvalues()[i] > tiny)
          j.row(i) = std::sqrt(eigen.eigenvalues()[i]) *
                     eigen.eigenvectors().col(i).cwiseQuotient(s).transpose();
    }
    return true;
  }

 private:
  const NormalEquations& at(const std::vector<double>& x) const {
    if (x == best_.x) return best_.at;
    if (x == last_.x) return last_.at;
    last_ = {x, evaluate_(x)};
    ++passes_;
    if (!(last_.at.cost < best_.at.cost)) return last_.at;
    best_ = last_;
    return best_.at;
  }

  const NormalEquationsAt& evaluate_;
  double scale_;
  mutable Evaluation best_, last_;
  mutable int passes_ = 0;
};

/// Gauss–Newton steps from a place so close to the optimum that each is shorter than the last.
/// Whether it got there; where not, s is where the last step that kept to that led.
bool take_last_steps(const NormalEquationsAt& evaluate,
                     const Bounds& bounds,
                     std::vector<double>& x,
                     Solution& s) {
  constexpr double enough = 1e-8, shorter = 0.5;
  auto step = next_step(s.at);
  while (step && step->decrease < hidden * s.at.cost) {
    if (step->decrease <= enough * s.at.cost) {
      s.message = fmt::format("The next step would lower the cost by {:.1g} of it",
                              s.at.cost > 0 ? step->decrease / s.at.cost : 0);
      return true;
    }
    auto tried = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      tried[i] += step->by[static_cast<Eigen::Index>(i)];
      if (!(tried[i] > bounds.low[i] && tried[i] < bounds.high[i])) return false;
    }
    auto at = evaluate(tried);
    ++s.passes;
    const auto next = next_step(at);
    if (!next || next->decrease > shorter * step->decrease) return false;
    ++s.iterations;
    s.cost_per_iteration.push_back(at.cost);
    x = std::move(tried);
    s.at = std::move(at);
    step = next;
  }
  return false;
}

/// One run of Ceres, all unknowns free inside their bounds, and the last steps after it.
Solution solve_once(const NormalEquationsAt& evaluate,
                    std::vector<double>& x,
                    const Bounds& bounds,
                    const SolveOptions& options) {
  Solution s;
  const std::size_t n = x.size();

  ceres::Problem::Options ours;
  ours.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ours);
  // One for the sum of what each unknown changes over its range.
  double effect = 0;
  s.at = evaluate(x);
  for (std::size_t i = 0; i < n; ++i) {
    const double range = bounds.high[i] - bounds.low[i];
    effect += s.at.h[i * n + i] * range * range;
  }
  if (!is_finite(s.at) || !std::isfinite(effect)) {
    s.message = "the sum of squares is not finite at the start";
    return s;
  }
  s.passes = 1;
  s.cost_per_iteration.push_back(s.at.cost);
  if (options.rounding > 0 && take_last_steps(evaluate, bounds, x, s)) {
    s.converged = true;
    return s;
  }
  const double scale = effect > 0 ? 1 / effect : 1;
  Reduced cost(evaluate, n, scale);
  cost.known(x, s.at);
  problem.AddResidualBlock(&cost, nullptr, x.data());
  for (std::size_t i = 0; i < n; ++i) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(i), bounds.low[i]);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(i), bounds.high[i]);
  }
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_QR;
  o.max_num_iterations = options.max_iterations;
  o.function_tolerance = options.function_tolerance;
  o.parameter_tolerance = options.parameter_tolerance;
  o.gradient_tolerance = 0;             // absolute: it would depend on the data's unit
  o.initial_trust_region_radius = 1e6;  // the start is close: nearly a Gauss–Newton step
  o.logging_type = ceres::SILENT;
  Enough enough(options.rounding, scale,
                [&]() -> const NormalEquations& { return cost.best().at; });
  if (options.rounding > 0) o.callbacks.push_back(&enough);
  ceres::Solver::Summary summary;
  ceres::Solve(o, &problem, &summary);

  x = cost.best().x;
  s.at = cost.best().at;
  s.passes += cost.passes();
  s.converged = summary.termination_type == ceres::CONVERGENCE ||
                summary.termination_type == ceres::USER_SUCCESS;
  for (std::size_t i = 1; i < summary.iterations.size(); ++i) {  // the first is the start
    ++s.iterations;
    s.cost_per_iteration.push_back(summary.iterations[i].cost / scale);
  }
  s.message = summary.message;
  if (options.rounding > 0 && s.converged) take_last_steps(evaluate, bounds, x, s);
  return s;
}

/// The problem in a subset of its unknowns, the others held.
NormalEquations restricted(const NormalEquations& e,
                           std::size_t n,
                           const std::vector<std::size_t>& moving) {
  NormalEquations r{Matrix(), {}, e.cost};
  for (const std::size_t a : moving) {
    r.g.push_back(e.g[a]);
    for (const std::size_t b : moving) r.h.push_back(e.h[a * n + b]);
  }
  return r;
}

}  // namespace

Solution solve(const NormalEquationsAt& evaluate,
               std::vector<double>& x,
               const Bounds& bounds,
               const SolveOptions& options) {
  const std::size_t n = x.size();
  Solution s;
  s.message = "nothing to fit";
  s.converged = true;
  for (std::size_t i = 0; i < n; ++i) x[i] = std::clamp(x[i], bounds.low[i], bounds.high[i]);
  if (n == 0) {
    s.at = evaluate(x);
    return s;
  }
  const auto at_low = [&](std::size_t i) { return x[i] <= bounds.low[i]; };
  const auto at_high = [&](std::size_t i) { return x[i] >= bounds.high[i]; };
  // What stands at a bound and is pushed outwards is held; what is pulled inside is let go.
  const auto pushed_outwards = [&] {
    std::vector<bool> pushed(n);
    for (std::size_t i = 0; i < n; ++i)
      pushed[i] = (at_low(i) && s.at.g[i] >= 0) || (at_high(i) && s.at.g[i] <= 0);
    return pushed;
  };
  std::vector<bool> held(n, false);
  for (std::size_t i = 0; i < n; ++i)
    if (at_low(i) || at_high(i)) {
      s.at = evaluate(x);
      ++s.passes;
      held = pushed_outwards();
      break;
    }
  for (std::size_t round = 0; round < n + 2; ++round) {
    std::vector<std::size_t> moving;
    Bounds inside;
    std::vector<double> some;
    for (std::size_t i = 0; i < n; ++i) {
      if (held[i]) continue;
      moving.push_back(i);
      inside.low.push_back(bounds.low[i]);
      inside.high.push_back(bounds.high[i]);
      some.push_back(x[i]);
    }
    const auto whole = [&](const std::vector<double>& part) {
      auto all = x;
      for (std::size_t k = 0; k < moving.size(); ++k) all[moving[k]] = part[k];
      return all;
    };
    NormalEquations best;  // of the whole problem where the part was lowest
    std::vector<double> best_x;
    const NormalEquationsAt part = [&](const std::vector<double>& p) {
      auto all = whole(p);
      const NormalEquations e = evaluate(all);
      if (best_x.empty() || e.cost < best.cost) {
        best = e;
        best_x = std::move(all);
      }
      return restricted(e, n, moving);
    };
    if (moving.empty()) {
      s.converged = true;
      s.message = "every unknown is at a bound";
    } else {
      const Solution once = solve_once(part, some, inside, options);
      x = whole(some);
      s.at = x == best_x ? std::move(best) : evaluate(x);
      s.converged = once.converged;
      s.message = once.message;
      s.iterations += once.iterations;
      s.passes += once.passes;
      const auto& costs = once.cost_per_iteration;  // a later round starts where the last one ended
      const bool repeats = !s.cost_per_iteration.empty() && !costs.empty();
      s.cost_per_iteration.insert(s.cost_per_iteration.end(), costs.begin() + repeats, costs.end());
    }
    auto now = pushed_outwards();
    if (now == held || !s.converged) return s;
    held = std::move(now);
  }
  s.converged = false;
  s.message = "the unknowns at their bounds keep changing";
  return s;
}

}  // namespace gonio
