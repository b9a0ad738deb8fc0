#include "fitting/judge/uncertainty.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace gonio {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

RowMajor part(const Matrix& m, std::size_t n, const std::vector<std::size_t>& of) {
  const auto k = static_cast<Eigen::Index>(of.size());
  RowMajor p(k, k);
  for (Eigen::Index a = 0; a < k; ++a)
    for (Eigen::Index b = 0; b < k; ++b)
      p(a, b) = m[of[static_cast<std::size_t>(a)] * n + of[static_cast<std::size_t>(b)]];
  return p;
}

/// Bread scaled to a unit diagonal, decomposed.
struct Decomposed {
  Eigen::VectorXd scale;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  explicit Decomposed(const RowMajor& bread)
      : scale(bread.diagonal().cwiseSqrt().cwiseInverse()),
        eigen(Eigen::MatrixXd(scale.asDiagonal() * bread * scale.asDiagonal())) {}
};

}  // namespace

double student_t_975(double nu) {
  if (nu < 1.5) return 12.7062;
  if (nu < 2.5) return 4.30265;
  if (nu < 3.5) return 3.18245;
  // Cornish–Fisher expansion about the normal quantile [Abramowitz & Stegun 26.7.5].
  const double z = 1.959963984540054, z2 = z * z;
  const double g1 = z * (z2 + 1) / 4, g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
  const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  return z + g1 / nu + g2 / (nu * nu) + g3 / (nu * nu * nu);
}

Uncertainty uncertainty(const Sandwich& s,
                        std::span<const double> x,
                        const Bounds& bounds,
                        std::size_t values_used,
                        std::size_t clusters) {
  const std::size_t n = x.size();
  Uncertainty u;
  u.status.assign(n, ParameterStatus::free);
  u.std_error.assign(n, nan);
  u.correlations.assign(n, std::vector<double>(n, nan));
  const auto range = [&](std::size_t i) { return bounds.high[i] - bounds.low[i]; };
  const auto effect = [&](std::size_t i) { return s.bread[i * n + i] * range(i) * range(i); };
  double strongest = 0;
  for (std::size_t i = 0; i < n; ++i) strongest = std::max(strongest, effect(i));
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < n; ++i) {
    const double near = 1e-7 * range(i);
    if (x[i] <= bounds.low[i] + near || x[i] >= bounds.high[i] - near)
      u.status[i] = ParameterStatus::at_bound;
    else if (!(effect(i) > 1e-18 * strongest))
      u.status[i] = ParameterStatus::not_identifiable;
    else
      known.push_back(i);
  }
  if (known.empty()) return u;

  // Directions in which nothing changes take their parameters out.
  const Decomposed all(part(s.bread, n, known));
  const auto& values = all.eigen.eigenvalues();
  u.condition = values[values.size() - 1] / std::max(values[0], 1e-300);
  std::vector<std::size_t> determined;
  for (std::size_t k = 0; k < known.size(); ++k) {
    bool lost = false;
    for (Eigen::Index e = 0; e < values.size(); ++e) {
      const auto direction = all.eigen.eigenvectors().col(e);
      const double largest = direction.cwiseAbs().maxCoeff();
      if (values[e] < 1e-11)
        lost = lost || std::abs(direction[static_cast<Eigen::Index>(k)]) > 0.1 * largest;
    }
    if (lost)
      u.status[known[k]] = ParameterStatus::not_identifiable;
    else
      determined.push_back(known[k]);
  }
  const double count = static_cast<double>(values_used), p = static_cast<double>(determined.size());
  const double g = static_cast<double>(clusters);
  const double freedom = clusters ? g - 1 : count - p;
  if (determined.empty() || freedom < 1) return u;
  u.t = student_t_975(freedom);

  const Decomposed d(part(s.bread, n, determined));
  const Eigen::MatrixXd inverse =
      d.scale.asDiagonal() *
      (d.eigen.eigenvectors() * d.eigen.eigenvalues().cwiseInverse().asDiagonal() *
       d.eigen.eigenvectors().transpose()) *
      d.scale.asDiagonal();
  const double correction =
      (clusters ? g / (g - 1) * (count - 1) : count) / std::max(count - p, 1.0);
  const Eigen::MatrixXd covariance = correction * inverse * part(s.meat, n, determined) * inverse;

  for (std::size_t a = 0; a < determined.size(); ++a) {
    const auto ia = static_cast<Eigen::Index>(a);
    const std::size_t i = determined[a];
    const double error = std::sqrt(covariance(ia, ia));
    if (2 * u.t * error >= range(i)) {
      u.status[i] = ParameterStatus::not_identifiable;
      continue;
    }
    u.std_error[i] = error;
    for (std::size_t b = 0; b < determined.size(); ++b) {
      const auto ib = static_cast<Eigen::Index>(b);
      u.correlations[i][determined[b]] =
          covariance(ia, ib) / std::sqrt(covariance(ia, ia) * covariance(ib, ib));
    }
  }
  return u;
}

}  // namespace gonio
