#include "fitting/judge/uncertainty.h"

#include <cmath>
#include <limits>

#include "fitting/solve/arrow_root.h"

#include <boost/math/distributions/students_t.hpp>

namespace gonio {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double singular = 1e-11;  ///< eigenvalues of the scaled bread below it are rounding

Eigen::Index index(std::size_t n) {
  return static_cast<Eigen::Index>(n);
}

/// Unknowns of a singular direction of the bread: those that have a part of it worth mentioning.
std::vector<bool> in_singular_directions(const ArrowRoot& root, const ArrowLayout& layout) {
  std::vector<bool> lost(layout.size());
  const auto mark = [&](const std::vector<std::size_t>& unknowns, const Eigen::VectorXd& direction,
                        double largest) {
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (std::abs(direction[static_cast<Eigen::Index>(k)]) > 0.1 * largest)
        lost[unknowns[k]] = true;
  };
  for (std::size_t a = 0; a < root.arms().size(); ++a) {
    const auto& arm = root.arms()[a];
    for (Eigen::Index e = 0; e < arm.eigenvalues.size(); ++e)
      if (arm.eigenvalues[e] < singular)
        mark(layout.arms()[a], arm.eigenvectors.col(e),
             arm.eigenvectors.col(e).cwiseAbs().maxCoeff());
  }
  // A direction w of the head takes the arms along, −D_c⁻¹ B_c w of them.
  for (Eigen::Index e = 0; e < root.head().eigenvalues().size(); ++e) {
    const Eigen::VectorXd w = root.head().eigenvectors().col(e);
    double squares = 1, largest = w.cwiseAbs().maxCoeff();
    std::vector<Eigen::VectorXd> along;
    for (const auto& arm : root.arms()) {
      along.push_back(arm.eigenvectors * (arm.root.asDiagonal() * (arm.w * w)));
      squares += along.back().squaredNorm();
      largest = std::max(largest, along.back().cwiseAbs().maxCoeff());
    }
    if (!(root.head().eigenvalues()[e] / squares < singular)) continue;
    mark(layout.head(), w, largest);
    for (std::size_t a = 0; a < along.size(); ++a) mark(layout.arms()[a], along[a], largest);
  }
  return lost;
}

/// Sandwich B⁻¹ M B⁻¹ entry by entry.  With the arms of B taken out,
///
///   B⁻¹ = E + U K Uᵀ,   E = diag(0, D_c⁻¹),   U = (1, −D_c⁻¹ B_c),   K the head's Schur complement⁻¹
///
///   B⁻¹ M B⁻¹ = U (K UᵀMU K) Uᵀ + Q (U K)ᵀ + (U K) Qᵀ + E M E,   Q = E M U
class SandwichProduct {
 public:
  /// \param unknowns  that are looked at, the others held
  SandwichProduct(const Sandwich& s, const std::vector<std::size_t>& unknowns, double factor)
      : layout_(std::make_shared<const ArrowLayout>(s.bread.layout().part(unknowns))),
        factor_(factor) {
    const ArrowRoot root(s.bread.part(layout_, unknowns), 0);
    const ArrowMatrix meat = s.meat.part(layout_, unknowns);
    const auto& head = layout_->head();
    const Eigen::Index n = index(layout_->size()), h = index(head.size());
    const auto& eigen = root.head();
    const Eigen::MatrixXd inverse =
        root.scale().asDiagonal() *
        (eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose()) *
        root.scale().asDiagonal();

    u_ = q_ = RowMajor::Zero(n, h);
    e_ = RowMajor::Zero(n, index(s.scores.size()));
    RowMajor inner = Eigen::Map<const RowMajor>(meat.head(), h, h);  // UᵀMU
    for (std::size_t k = 0; k < head.size(); ++k) u_(index(head[k]), index(k)) = 1;
    std::vector<Eigen::MatrixXd> inverses;
    for (std::size_t a = 0; a < root.arms().size(); ++a) {
      const auto& arm = root.arms()[a];
      const auto& own = layout_->arms()[a];
      const Eigen::Index k = index(own.size());
      const Eigen::MatrixXd half =
          arm.scale.asDiagonal() * arm.eigenvectors * arm.root.asDiagonal();
      inverses.push_back(half * half.transpose());
      const Eigen::MatrixXd u = -half * arm.w * root.scale().cwiseInverse().asDiagonal();
      const Eigen::Map<const RowMajor> d(meat.own(a), k, k), b(meat.border(a), k, h);
      const Eigen::MatrixXd mu = b + d * u;
      inner += u.transpose() * mu + b.transpose() * u;
      put(own, u, u_);
      put(own, inverses[a] * mu, q_);
      squares_.push_back(inverses[a] * d * inverses[a]);
    }
    for (std::size_t g = 0; g < s.scores.size(); ++g) {
      Eigen::VectorXd score(n);
      for (Eigen::Index i = 0; i < n; ++i)
        score[i] = s.scores[g][unknowns[static_cast<std::size_t>(i)]];
      Eigen::VectorXd t(h);
      for (std::size_t k = 0; k < head.size(); ++k) t[index(k)] = score[index(head[k])];
      for (std::size_t a = 0; a < inverses.size(); ++a) {
        const auto& own = layout_->arms()[a];
        Eigen::VectorXd part(index(own.size()));
        for (std::size_t k = 0; k < own.size(); ++k) {
          part[index(k)] = score[index(own[k])];
          t += u_.row(index(own[k])).transpose() * part[index(k)];
        }
        const Eigen::VectorXd e = inverses[a] * part;
        for (std::size_t k = 0; k < own.size(); ++k) e_(index(own[k]), index(g)) = e[index(k)];
      }
      inner += t * t.transpose();
      q_ += e_.col(index(g)) * t.transpose();
    }
    outer_ = u_ * Eigen::MatrixXd(factor * inverse * inner * inverse);
    uk_ = u_ * inverse;
  }

  double operator()(std::size_t i, std::size_t j) const {
    const Eigen::Index r = index(i), c = index(j);
    const std::size_t arm = layout_->arm(i);
    double rest = q_.row(r).dot(uk_.row(c)) + uk_.row(r).dot(q_.row(c)) + e_.row(r).dot(e_.row(c));
    if (arm != ArrowLayout::none && arm == layout_->arm(j))
      rest += squares_[arm](index(layout_->within(i)), index(layout_->within(j)));
    return outer_.row(r).dot(u_.row(c)) + factor_ * rest;
  }

 private:
  static void put(const std::vector<std::size_t>& rows, const Eigen::MatrixXd& from, RowMajor& to) {
    for (std::size_t k = 0; k < rows.size(); ++k) to.row(index(rows[k])) = from.row(index(k));
  }

  std::shared_ptr<const ArrowLayout> layout_;
  double factor_;
  RowMajor u_, q_, e_, uk_, outer_;  ///< by unknown: U, Q, E times each score, U K, U (K UᵀMU K)
  std::vector<Eigen::MatrixXd> squares_;  ///< E M E of each arm
};

}  // namespace

double student_t_975(double nu) {
  return boost::math::quantile(boost::math::students_t(nu), 0.975);
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
  const auto effect = [&](std::size_t i) { return s.bread(i, i) * range(i) * range(i); };
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
  const auto layout = std::make_shared<const ArrowLayout>(s.bread.layout().part(known));
  const ArrowRoot all(s.bread.part(layout, known), singular);
  const auto [least, largest] = all.extremes();
  u.condition = largest / std::max(least, 1e-300);
  const auto lost = in_singular_directions(all, *layout);
  std::vector<std::size_t> determined;
  for (std::size_t k = 0; k < known.size(); ++k)
    if (lost[k])
      u.status[known[k]] = ParameterStatus::not_identifiable;
    else
      determined.push_back(known[k]);
  const double count = static_cast<double>(values_used), p = static_cast<double>(determined.size());
  const double g = static_cast<double>(clusters);
  const double freedom = clusters ? g - 1 : count - p;
  if (determined.empty() || freedom < 1) return u;
  u.t = student_t_975(freedom);

  // The sandwich.
  //
  // 1. A cluster's score is s = Σ ρ' r ∂r/∂x over its residuals; the best x makes Σ s = 0.
  // 2. About the true x*, Σ s(x) = S + H (x − x*) but for squares, with S = Σ s(x*) and the bread
  //    H = Σ j jᵀ over what is not clipped: x − x* = −H⁻¹ S.
  // 3. The mean of S is 0, so the covariance of x is H⁻¹ ⟨S Sᵀ⟩ H⁻¹.
  // 4. Clusters are independent and within one nothing is assumed: ⟨S Sᵀ⟩ is about M = Σ s sᵀ,
  //    the meat.
  // 5. Scores at the best x are smaller than those at x*: with G clusters, n values and p unknowns
  //    G/(G − 1) (n − 1)/(n − p) makes up for it.
  // 6. H = W⁻¹ (V Λ Vᵀ) W⁻¹ with W = diag(H)^−½, so H⁻¹ = W V Λ⁻¹ Vᵀ W, whatever the units of x.
  //
  //    ┌─────────────────────────────────────────────────┐
  //    │  cov x = G/(G − 1) (n − 1)/(n − p) · H⁻¹ M H⁻¹  │
  //    └─────────────────────────────────────────────────┘
  const double correction =
      (clusters ? g / (g - 1) * (count - 1) : count) / std::max(count - p, 1.0);
  const SandwichProduct covariance(s, determined, correction);
  std::vector<double> variance;
  for (std::size_t a = 0; a < determined.size(); ++a) variance.push_back(covariance(a, a));

  for (std::size_t a = 0; a < determined.size(); ++a) {
    const std::size_t i = determined[a];
    const double error = std::sqrt(variance[a]);
    if (2 * u.t * error >= range(i)) {
      u.status[i] = ParameterStatus::not_identifiable;
      continue;
    }
    u.std_error[i] = error;
    for (std::size_t b = 0; b < determined.size(); ++b)
      u.correlations[i][determined[b]] = covariance(a, b) / std::sqrt(variance[a] * variance[b]);
  }
  return u;
}

}  // namespace gonio
