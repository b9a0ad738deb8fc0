// The only user of Ceres in this room: a small dense problem, the target's equations as they are.
#include <algorithm>
#include <cmath>
#include <utility>

#include "fitting/export/target.h"

#include <ceres/ceres.h>

namespace gonio {
namespace {

class Distance : public ceres::CostFunction {
 public:
  Distance(const TargetParameters& p,
           const TargetValues& values,
           std::span<const FrameAngles<double>> angles,
           const std::vector<std::vector<double>>& wanted,
           const std::vector<std::vector<double>>& scale)
      : parameters_(p), values_(values), angles_(angles), wanted_(wanted), scale_(scale) {
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t c = 0; p[i].free && c < p[i].values.size(); ++c) free_.emplace_back(i, c);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(free_.size()));
    set_num_residuals(static_cast<int>(wanted.size() * angles.size()));
  }

  std::size_t count() const { return free_.size(); }
  const Range& legal(std::size_t k) const { return parameters_[free_[k].first].legal; }
  void read(double* x) const {
    for (std::size_t k = 0; k < free_.size(); ++k)
      x[k] = parameters_[free_[k].first].values[free_[k].second];
  }
  TargetParameters with(const double* x) const {
    TargetParameters p = parameters_;
    for (std::size_t k = 0; k < free_.size(); ++k)
      p[free_[k].first].values[free_[k].second] = std::clamp(x[k], legal(k).low, legal(k).high);
    return p;
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const std::size_t n = count(), rows = static_cast<std::size_t>(num_residuals());
    distances(x[0], residuals);
    if (jacobians && jacobians[0]) {
      std::vector<double> at(x[0], x[0] + n), there(rows);
      for (std::size_t k = 0; k < n; ++k) {
        const double step = 1e-6 * std::max(std::abs(at[k]), 1e-2);
        const double h = at[k] + step <= legal(k).high ? step : -step;
        const double kept = std::exchange(at[k], at[k] + h);
        distances(at.data(), there.data());
        at[k] = kept;
        for (std::size_t i = 0; i < rows; ++i)
          jacobians[0][i * n + k] = (there[i] - residuals[i]) / h;
      }
    }
    return std::all_of(residuals, residuals + rows, [](double r) { return std::isfinite(r); });
  }

 private:
  void distances(const double* x, double* out) const {
    const auto f = values_(with(x), angles_);
    for (std::size_t c = 0; c < wanted_.size(); ++c)
      for (std::size_t i = 0; i < angles_.size(); ++i)
        *out++ = (f[c][i] - wanted_[c][i]) / scale_[c][i];
  }

  const TargetParameters& parameters_;
  const TargetValues& values_;
  std::span<const FrameAngles<double>> angles_;
  const std::vector<std::vector<double>>&wanted_, &scale_;
  std::vector<std::pair<std::size_t, std::size_t>> free_;  ///< parameter and channel of each number
};

}  // namespace

double parameter_in(const TargetParameters& all, std::string_view name, std::size_t channel) {
  const auto it = std::ranges::find(all, name, &TargetParameter::name);
  return it == all.end() ? 0 : it->values[it->values.size() > 1 ? channel : 0];
}

TargetParameters refitted(TargetParameters p,
                          const TargetValues& values,
                          std::span<const FrameAngles<double>> angles,
                          const std::vector<std::vector<double>>& wanted,
                          const std::vector<std::vector<double>>& scale) {
  Distance distance(p, values, angles, wanted, scale);
  std::vector<double> x(distance.count());
  if (x.empty()) return p;
  distance.read(x.data());
  ceres::Problem::Options shared;
  shared.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(shared);
  problem.AddResidualBlock(&distance, nullptr, x.data());
  for (std::size_t k = 0; k < x.size(); ++k) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(k), distance.legal(k).low);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(k), distance.legal(k).high);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return distance.with(x.data());
}

}  // namespace gonio
