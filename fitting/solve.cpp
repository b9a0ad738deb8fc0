// The one file that knows Ceres.
#include "fitting/solve.h"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gonio {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The cost function described in the header.  Ceres asks for the cost at a trial point first and
/// for its Jacobian after accepting it: one pass over the samples serves both.
class Reduced : public ceres::CostFunction {
 public:
  Reduced(const std::function<NormalEquations(const std::vector<double>&)>& evaluate, std::size_t n)
      : evaluate_(evaluate) {
    set_num_residuals(static_cast<int>(n) + 1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(n));
  }

  const NormalEquations& at(const std::vector<double>& x) const {
    if (x != x_) {
      x_ = x;
      e_ = evaluate_(x);
      ++passes_;
    }
    return e_;
  }
  int passes() const { return passes_; }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const auto n = static_cast<Eigen::Index>(parameter_block_sizes()[0]);
    const auto& e = at({parameters[0], parameters[0] + n});
    if (!std::isfinite(e.cost)) return false;
    const Eigen::Map<const RowMajor> h(e.h.data(), n, n);
    const Eigen::Map<const Eigen::VectorXd> g(e.g.data(), n);
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
    r[n] = std::sqrt(std::max(0.0, 2 * e.cost - r.head(n).squaredNorm()));
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
  const std::function<NormalEquations(const std::vector<double>&)>& evaluate_;
  mutable std::vector<double> x_;
  mutable NormalEquations e_;
  mutable int passes_ = 0;
};

}  // namespace

Solution solve(const std::function<NormalEquations(const std::vector<double>&)>& evaluate,
               std::vector<double> start, const Bounds& bounds, const SolveOptions& options) {
  Solution s;
  s.x = std::move(start);
  const std::size_t n = s.x.size();
  if (n == 0) {
    s.at = evaluate(s.x);
    s.converged = true;
    s.message = "nothing to fit";
    return s;
  }
  for (std::size_t i = 0; i < n; ++i) s.x[i] = std::clamp(s.x[i], bounds.low[i], bounds.high[i]);

  ceres::Problem::Options ours;
  ours.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ours);
  Reduced cost(evaluate, n);
  problem.AddResidualBlock(&cost, nullptr, s.x.data());
  for (std::size_t i = 0; i < n; ++i) {
    problem.SetParameterLowerBound(s.x.data(), static_cast<int>(i), bounds.low[i]);
    problem.SetParameterUpperBound(s.x.data(), static_cast<int>(i), bounds.high[i]);
  }
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_QR;
  o.max_num_iterations = options.max_iterations;
  o.function_tolerance = options.function_tolerance;
  o.parameter_tolerance = options.parameter_tolerance;
  o.gradient_tolerance = 1e-16;
  o.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(o, &problem, &summary);

  s.at = cost.at(s.x);
  s.passes = cost.passes();
  s.converged = summary.termination_type == ceres::CONVERGENCE;
  s.iterations = static_cast<int>(summary.iterations.size());
  for (const auto& i : summary.iterations) s.cost_per_iteration.push_back(i.cost);
  s.message = summary.message;
  return s;
}

}  // namespace gonio
