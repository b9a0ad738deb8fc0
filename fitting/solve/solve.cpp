// Ceres stays in this file (and in plain_fit.cpp, which is measured against it).
#include "fitting/solve/solve.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fitting/solve/arrow_root.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

namespace gonio {
namespace {

// Of a Ceres with its own log in place of glog the level is set where it is built (cmake/wheel.sh).
#ifndef CERCES_INTERNAL_MINIGLOG_GLOG_LOGGING_H_
/// True: Ceres' log goes nowhere.  What it would say of a step that failed is no one's but the solver's.
const bool is_silent = [] {
  FLAGS_minloglevel = google::GLOG_FATAL;
  return true;
}();
#endif

/// \param scale  of the cost
/// Next Gauss–Newton step and what it promises.
struct NewtonStep {
  std::vector<double> by;
  double decrease = 0;  ///< of the cost: ½ gᵀ H⁻¹ g
};
/// None where some direction is so badly determined that rounding would decide where it leads.
std::optional<NewtonStep> next_step(const NormalEquations& e) {
  constexpr double least = 1e-6;
  if (!is_finite(e)) return {};
  for (std::size_t i = 0; i < e.h.size(); ++i)
    if (!(e.h(i, i) > 0)) return {};
  const ArrowRoot root(e.h, 0);
  if (root.at_most(least) > 0) return {};
  const auto g = root.rotated(e.g);
  double decrease = g.head.cwiseQuotient(root.head().values).dot(g.head) / 2;
  for (const auto& arm : g.arms) decrease += arm.squaredNorm() / 2;
  auto by = root.solution(g);
  for (double& x : by) x = -x;
  return NewtonStep{std::move(by), decrease};
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

/// Cost functions described in the header, one for the head and one for each arm, over one evaluation.
/// Ceres asks for the cost at a trial point first and for its Jacobian after accepting it: one pass
/// over the samples serves both.
class Reduced : public ceres::EvaluationCallback {
 public:
  /// \param scale  of the cost, so that none of Ceres' absolute limits depends on the data's unit
  /// \param units  of the unknowns that Ceres sees, so that none depends on theirs
  /// \param known  what is known already
  Reduced(const NormalEquationsAt& evaluate,
          double scale,
          std::vector<double> units,
          const std::vector<double>& x,
          const NormalEquations& known)
      : evaluate_(evaluate),
        scale_(scale),
        units_(std::move(units)),
        layout_(known.h.shared_layout()),
        best_{x, known},
        last_(best_) {
    const auto gather = [&](const std::vector<std::size_t>& unknowns) {
      auto& part = parts_.emplace_back();
      for (const std::size_t i : unknowns) part.push_back(x[i] / units_[i]);
    };
    gather(layout_->head());
    for (const auto& arm : layout_->arms()) gather(arm);
  }

  struct Evaluation {
    std::vector<double> x;
    NormalEquations at;
  };
  /// The lowest cost seen: Ceres stops without taking the last step that it looked at.
  const Evaluation& best() const { return best_; }
  int passes() const { return passes_; }

  /// Adds the unknowns, part by part, and the residuals.
  void add_to(ceres::Problem& problem, const Bounds& bounds) {
    const auto add = [&](std::size_t k, const std::vector<std::size_t>& unknowns) {
      double* const part = parts_[k].data();
      std::vector<double*> blocks{part};
      if (k > 0) blocks.push_back(parts_[0].data());
      problem.AddResidualBlock(new Part(*this, k), nullptr, blocks);
      for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const double unit = units_[unknowns[i]];
        problem.SetParameterLowerBound(part, static_cast<int>(i), bounds.low[unknowns[i]] / unit);
        problem.SetParameterUpperBound(part, static_cast<int>(i), bounds.high[unknowns[i]] / unit);
      }
    };
    add(0, layout_->head());
    for (std::size_t a = 0; a < layout_->arms().size(); ++a) add(a + 1, layout_->arms()[a]);
  }
  /// Arms first: each is eliminated by itself.
  void eliminate_arms(ceres::Solver::Options& o) {
    if (parts_.size() == 1) return;
    o.linear_solver_type = ceres::DENSE_SCHUR;
    o.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (std::size_t k = 0; k < parts_.size(); ++k)
      o.linear_solver_ordering->AddElementToGroup(parts_[k].data(), k == 0);
  }

  void PrepareForEvaluation(bool, bool new_point) override {
    if (!new_point && root_) return;
    std::vector<double> x(layout_->size());
    const auto scatter = [&](std::size_t k, const std::vector<std::size_t>& unknowns) {
      for (std::size_t i = 0; i < unknowns.size(); ++i)
        x[unknowns[i]] = parts_[k][i] * units_[unknowns[i]];
    };
    scatter(0, layout_->head());
    for (std::size_t a = 0; a < layout_->arms().size(); ++a) scatter(a + 1, layout_->arms()[a]);
    const auto& e = at(x);
    root_.reset();
    if (!is_finite(e, scale_)) return;
    ArrowMatrix h = e.h;
    h *= scale_;
    std::vector<double> g = e.g;
    for (double& component : g) component *= scale_;
    root_.emplace(h, tiny());
    gradient_ = root_->rotated(g);
    double squares = 0;
    auto& head = gradient_.head;
    for (Eigen::Index i = 0; i < head.size(); ++i)
      head[i] = root_->head().values[i] > tiny() ? head[i] / std::sqrt(root_->head().values[i]) : 0;
    squares = head.squaredNorm();
    for (const auto& arm : gradient_.arms) squares += arm.squaredNorm();
    constant_ = std::sqrt(std::max(0.0, 2 * scale_ * e.cost - squares));
  }

 private:
  /// Residuals of the head, with the constant one, or of an arm.
  class Part : public ceres::CostFunction {
   public:
    Part(const Reduced& whole, std::size_t k) : whole_(whole), k_(k) {
      const auto n = static_cast<int>(whole.parts_[k].size());
      set_num_residuals(k == 0 ? n + 1 : n);
      mutable_parameter_block_sizes()->push_back(n);
      if (k > 0)
        mutable_parameter_block_sizes()->push_back(static_cast<int>(whole.parts_[0].size()));
    }
    bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
      if (!whole_.root_) return false;
      k_ == 0 ? whole_.head(residuals, jacobians) : whole_.arm(k_ - 1, residuals, jacobians);
      return true;
    }

   private:
    const Reduced& whole_;
    std::size_t k_;
  };

  void head(double* residuals, double** jacobians) const {
    const Eigen::Index n = index(parts_[0].size());
    const auto& eigen = root_->head();
    Eigen::Map<Eigen::VectorXd> r(residuals, n + 1);
    r.head(n) = gradient_.head;
    r[n] = constant_;
    if (!jacobians || !jacobians[0]) return;
    Eigen::Map<RowMajor> j(jacobians[0], n + 1, n);
    j.setZero();
    for (Eigen::Index i = 0; i < n; ++i)
      if (eigen.values[i] > tiny())
        j.row(i) = std::sqrt(eigen.values[i]) *
                   eigen.vectors.col(i).cwiseQuotient(root_->scale()).transpose();
    in_units(j, layout_->head());
  }
  void arm(std::size_t a, double* residuals, double** jacobians) const {
    const auto& arm = root_->arms()[a];
    const Eigen::Index n = arm.eigenvalues.size(), h = index(parts_[0].size());
    Eigen::Map<Eigen::VectorXd>(residuals, n) = gradient_.arms[a];
    if (!jacobians) return;
    if (jacobians[0]) {
      Eigen::Map<RowMajor> j(jacobians[0], n, n);
      j.setZero();
      for (Eigen::Index i = 0; i < n; ++i)
        if (arm.root[i] > 0)
          j.row(i) = std::sqrt(arm.eigenvalues[i]) *
                     arm.eigenvectors.col(i).cwiseQuotient(arm.scale).transpose();
      in_units(j, layout_->arms()[a]);
    }
    if (!jacobians[1]) return;
    Eigen::Map<RowMajor> j(jacobians[1], n, h);
    j = arm.w * root_->scale().cwiseInverse().asDiagonal();
    in_units(j, layout_->head());
  }
  /// Makes derivatives by the unknowns those by what Ceres sees.
  void in_units(Eigen::Map<RowMajor>& j, const std::vector<std::size_t>& unknowns) const {
    for (std::size_t i = 0; i < unknowns.size(); ++i) j.col(index(i)) *= units_[unknowns[i]];
  }

  double tiny() const { return 1e-15 * static_cast<double>(layout_->size()); }
  const NormalEquations& at(const std::vector<double>& x) {
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
  std::vector<double> units_;
  std::shared_ptr<const ArrowLayout> layout_;
  std::vector<std::vector<double>> parts_;  ///< unknowns of the head and of each arm: Ceres' blocks
  std::optional<ArrowRoot> root_;           ///< none where the sums are not finite
  ArrowRoot::Rotated gradient_;             ///< residuals of the arms and the head
  double constant_ = 0;                     ///< the residual that makes up the cost
  Evaluation best_, last_;
  int passes_ = 0;
};

/// Gauss–Newton steps from a place so close to the optimum that each is shorter than the last.
/// True where it got there; else s is where the last step that kept to that led.
bool take_last_steps(const NormalEquationsAt& evaluate,
                     const Bounds& bounds,
                     std::vector<double>& x,
                     Solution& s) {
  constexpr double enough = 1e-8, shorter = 0.5;
  auto step = next_step(s.at);
  while (step && step->decrease < hidden * s.at.cost) {
    if (step->decrease <= enough * s.at.cost) {
      s.message = fmt::format("The next step would lower the cost by {:.1g} of its value",
                              s.at.cost > 0 ? step->decrease / s.at.cost : 0);
      return true;
    }
    auto tried = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      tried[i] += step->by[i];
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

double scale_of_cost(double cost) {
  constexpr double least = 1e-200;
  return cost > least ? 1 / cost : 1;
}
/// Changes of the unknowns that change the residuals by about 1; powers of 2, so that bounds stay as they
/// are.
std::vector<double> units_of(const NormalEquations& e, double scale) {
  std::vector<double> units;
  for (std::size_t i = 0; i < e.h.size(); ++i) {
    const double effect = e.h(i, i) * scale;
    units.push_back(
        effect > 0 && std::isfinite(effect) ? std::exp2(-std::round(std::log2(effect) / 2)) : 1);
  }
  return units;
}

/// Why Ceres ended, as a reader of the fit is told.
std::string in_words(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return "Further steps would hardly change anything";
    case ceres::NO_CONVERGENCE:
      return "The cost was still falling when the steps allowed were used up";
    case ceres::FAILURE:
    case ceres::USER_FAILURE:
      break;
  }
  return "No further step could be computed";
}

/// One run of Ceres, all unknowns free inside their bounds, and the last steps after it.
Solution solve_once(const NormalEquationsAt& evaluate,
                    std::vector<double>& x,
                    const Bounds& bounds,
                    const SolveOptions& options) {
  Solution s;
  s.at = evaluate(x);
  if (!is_finite(s.at)) {
    s.message = "The sum of squares is not finite at the start";
    return s;
  }
  s.passes = 1;
  s.cost_per_iteration.push_back(s.at.cost);
  if (options.rounding > 0 && take_last_steps(evaluate, bounds, x, s)) {
    s.converged = true;
    return s;
  }
  // Near 1 are the cost and, for Ceres' limits on its own scaling and damping, each unknown's
  // effect: one of them may be 10⁶⁰ of another where data reach over as many decades.
  const double scale = scale_of_cost(s.at.cost);
  Reduced cost(evaluate, scale, units_of(s.at, scale), x, s.at);
  ceres::Problem::Options with;
  with.evaluation_callback = &cost;
  ceres::Problem problem(with);
  cost.add_to(problem, bounds);
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_QR;
  cost.eliminate_arms(o);
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
  s.message = in_words(summary);
  if (options.rounding > 0 && s.converged) take_last_steps(evaluate, bounds, x, s);
  return s;
}

}  // namespace

Solution solve(const NormalEquationsAt& evaluate,
               std::vector<double>& x,
               const Bounds& bounds,
               const SolveOptions& options) {
  const std::size_t n = x.size();
  Solution s;
  s.message = "Nothing to fit";
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
    std::shared_ptr<const ArrowLayout> layout;  // of what moves
    NormalEquations best;                       // of the whole problem where the part was lowest
    std::vector<double> best_x;
    const NormalEquationsAt part = [&](const std::vector<double>& p) {
      auto all = whole(p);
      const NormalEquations e = evaluate(all);
      if (!layout) layout = std::make_shared<const ArrowLayout>(e.h.layout().part(moving));
      if (best_x.empty() || e.cost < best.cost) {
        best = e;
        best_x = std::move(all);
      }
      NormalEquations some_of{e.h.part(layout, moving), {}, e.cost};
      for (const std::size_t i : moving) some_of.g.push_back(e.g[i]);
      return some_of;
    };
    if (moving.empty()) {
      s.converged = true;
      s.message = "Every unknown is at a bound";
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
