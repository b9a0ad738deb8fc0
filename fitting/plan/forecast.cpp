#include "fitting/plan/forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fitting/judge/uncertainty.h"
#include "fitting/solve/matrix.h"
#include "number/distributions.h"

#include <Eigen/Cholesky>

namespace gonio {
namespace {

using Eigen::Index;

/// Information of a range: one over the variance of a uniform density.
Eigen::ArrayXd of_range(const Eigen::VectorXd& range) {
  return 12 / range.array().square();
}

/// Degrees of freedom of which Student's t is that.
double freedom_of(double t, double most) {
  double low = 1, high = std::max(most, 1.0);
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(low * high);
    (students_t_quantile(0.975, middle) > t ? low : high) = middle;
  }
  return low;
}

}  // namespace

/// Variances with so many samples, and what single values have to do with them.
struct Forecast::Sums {
  Eigen::ArrayXd variance,
      leveraged;  ///< V_kk; Σ b²/(1 − h), with all that is not followed value by value
  Eigen::ArrayXd fourth, squares;  ///< Σ b⁴, Σ (b²/(1 − h))², of the values followed
  Eigen::ArrayXd from_new;         ///< Σ b² over the new values
  double freedom;
  double samples = 0;  ///< new ones

  /// Degrees of freedom of each unknown.
  double nu(Index k) const {
    double nu = freedom;
    if (fourth[k] > 0) nu = std::min(nu, variance[k] * variance[k] / fourth[k]);
    if (squares[k] > 0) nu = std::min(nu, leveraged[k] * leveraged[k] / squares[k]);
    return std::max(nu, 1.0);
  }
};

Forecast::Forecast(FitSoFar f) : fit_(std::move(f)) {
  for (Index k = 0; k < fit_.width.size(); ++k) {
    if (!std::isnan(fit_.width[k])) continue;
    fit_.information.row(k).setZero();
    fit_.information.col(k).setZero();
    for (auto& j : fit_.values) j.col(k).setZero();
  }
  excess_ = Eigen::VectorXd::Ones(fit_.range.size());
  shared_ = Eigen::VectorXd::Constant(fit_.range.size(), std::numeric_limits<double>::infinity());
  const Sums now = sums({});
  for (Index k = 0; k < excess_.size(); ++k) {
    if (fit_.in_proportion && !std::isnan(fit_.width[k])) {
      if (!std::isnan(fit_.std_error[k]))
        shared_[k] = freedom_of(fit_.width[k] / fit_.std_error[k] / 2, fit_.freedom);
      const double alike = 2 * t_of(now, k, now.freedom) * std::sqrt(now.variance[k]);
      excess_[k] = std::pow(fit_.width[k] / alike, 2);
    } else if (!std::isnan(fit_.std_error[k]) && !std::isnan(fit_.width[k])) {
      constexpr double as_if = 8;  // values that say that noise is alike
      const double told = std::pow(fit_.std_error[k], 2) / now.leveraged[k];
      excess_[k] = (now.nu(k) * told + as_if) / (now.nu(k) + as_if);
    }
  }
}

Eigen::MatrixXd Forecast::covariance(SampleList more) const {
  Eigen::MatrixXd a = fit_.information;
  a.diagonal().array() += of_range(fit_.range);
  for (const auto* j : more) a += transposed_product(*j, *j);
  return a.llt().solve(Eigen::MatrixXd::Identity(a.rows(), a.cols()));
}

Forecast::Sums Forecast::sums(SampleList more) const {
  const Eigen::MatrixXd v = covariance(more);
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(v.rows());
  Sums s{v.diagonal(), v.diagonal(), none, none, none, fit_.freedom};
  const auto add = [&](const SampleRows& j, bool is_new) {
    for (Index c = 0; c < j.rows(); ++c) {
      const Eigen::VectorXd b = times(v, j.row(c).transpose());
      constexpr double all = 0.999;  // from which on a value alone knows something
      const double h = std::min(j.row(c).dot(b), all);
      const Eigen::ArrayXd squares = b.array().square(), leveraged = squares / (1 - h);
      s.leveraged += leveraged - squares;
      s.fourth += squares.square();
      s.squares += leveraged.square();
      if (!is_new) continue;
      s.from_new += squares;
      s.freedom += 1;
    }
  };
  for (const auto& j : fit_.values) add(j, false);
  for (const auto* j : more) add(*j, true);
  s.samples = static_cast<double>(more.size());
  return s;
}

Eigen::VectorXd Forecast::factor(const Sums& s) const {
  if (fit_.in_proportion) return excess_.array().sqrt();
  const Eigen::ArrayXd old = (1 - s.from_new / s.variance).max(0.0);
  return (1 + (excess_.array() - 1) * old).sqrt();
}

double Forecast::t_of(const Sums& s, Index k, double most) const {
  return students_t_quantile(0.975, std::min(most, shared_[k] + s.samples));
}

Eigen::VectorXd Forecast::widths(SampleList more) const {
  const Sums s = sums(more);
  Eigen::ArrayXd t(s.variance.size());
  for (Index k = 0; k < t.size(); ++k) t[k] = t_of(s, k, s.freedom);
  return 2 * t * s.variance.sqrt() * factor(s).array();
}

Eigen::VectorXd Forecast::told_widths(SampleList more) const {
  const Sums s = sums(more);
  Eigen::ArrayXd t(s.variance.size());
  for (Index k = 0; k < t.size(); ++k) t[k] = t_of(s, k, s.nu(k));
  return 2 * t * s.leveraged.sqrt() * factor(s).array();
}

Eigen::VectorXd Forecast::variances_after(const Eigen::MatrixXd& v, const SampleRows& j) {
  const Eigen::MatrixXd jv = product(j, v);
  Eigen::MatrixXd s = product(jv, j.transpose());
  s.diagonal().array() += 1;
  const Eigen::MatrixXd lower = s.llt().matrixL().solve(jv);
  return v.diagonal() - lower.colwise().squaredNorm().transpose();
}

}  // namespace gonio
