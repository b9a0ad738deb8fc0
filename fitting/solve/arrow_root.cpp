#include "fitting/solve/arrow_root.h"

#include <algorithm>
#include <cmath>

namespace gonio {
namespace {

/// 1/√diagonal, 1 where nothing is known.
Eigen::VectorXd scale_of(const Eigen::Map<const RowMajor>& m) {
  Eigen::VectorXd s = m.diagonal().cwiseSqrt();
  for (auto& d : s) d = d > 0 ? 1 / d : 1;
  return s;
}

/// A number between low and high, both positive, from which on `is_above` holds, to the last digits.
template <class IsAbove>
double bisect(double low, double high, IsAbove&& is_above) {
  for (int i = 0; i < 100 && high > low * (1 + 1e-15); ++i) {
    const double middle = std::sqrt(low * high);
    (is_above(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

ArrowRoot::ArrowRoot(const ArrowMatrix& m, double tiny) : layout_(m.shared_layout()) {
  const Eigen::Index n = index(layout_->head().size());
  const Eigen::Map<const RowMajor> head(m.head(), n, n);
  scale_ = scale_of(head);
  scaled_ = scale_.asDiagonal() * head * scale_.asDiagonal();
  Columns complement = scaled_;
  for (std::size_t a = 0; a < layout_->arms().size(); ++a) {
    const Eigen::Index k = index(layout_->arms()[a].size());
    const Eigen::Map<const RowMajor> own(m.own(a), k, k), border(m.border(a), k, n);
    Arm arm;
    arm.scale = scale_of(own);
    const Eigen::SelfAdjointEigenSolver<Columns> eigen(
        Columns(arm.scale.asDiagonal() * own * arm.scale.asDiagonal()));
    arm.eigenvalues = eigen.eigenvalues();
    arm.eigenvectors = eigen.eigenvectors();
    arm.border = arm.scale.asDiagonal() * border * scale_.asDiagonal();
    arm.root = arm.eigenvalues.unaryExpr([&](double x) { return x > tiny ? 1 / std::sqrt(x) : 0; });
    arm.w = arm.root.asDiagonal() * (arm.eigenvectors.transpose() * arm.border);
    complement.noalias() -= arm.w.transpose() * arm.w;
    arms_.push_back(std::move(arm));
  }
  head_.compute(complement);
}

ArrowRoot::Rotated ArrowRoot::rotated(std::span<const double> g) const {
  const auto scaled = [&](const std::vector<std::size_t>& unknowns, const Vector& scale) {
    Vector v(index(unknowns.size()));
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      v[index(k)] = scale[index(k)] * g[unknowns[k]];
    return v;
  };
  Rotated r;
  Vector head = scaled(layout_->head(), scale_);
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    const Arm& arm = arms_[a];
    r.arms.push_back(arm.root.asDiagonal() *
                     (arm.eigenvectors.transpose() * scaled(layout_->arms()[a], arm.scale)));
    head.noalias() -= arm.w.transpose() * r.arms.back();
  }
  r.head = head_.eigenvectors().transpose() * head;
  return r;
}

std::vector<double> ArrowRoot::solution(const Rotated& r) const {
  std::vector<double> x(layout_->size());
  const Vector head = head_.eigenvectors() * r.head.cwiseQuotient(head_.eigenvalues());
  const auto put = [&](const std::vector<std::size_t>& unknowns, const Vector& scaled) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) x[unknowns[k]] = scaled[index(k)];
  };
  put(layout_->head(), scale_.asDiagonal() * head);
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    const Arm& arm = arms_[a];
    put(layout_->arms()[a],
        arm.scale.asDiagonal() *
            (arm.eigenvectors * (arm.root.asDiagonal() * (r.arms[a] - arm.w * head))));
  }
  return x;
}

std::size_t ArrowRoot::at_most(double t) const {
  if (arms_.empty()) return static_cast<std::size_t>((head_.eigenvalues().array() <= t).count());
  // Sylvester's law of inertia: as many as of each D_c − t and of the Schur complement of A − t.
  std::size_t count = 0;
  Columns complement = scaled_;
  complement.diagonal().array() -= t;
  for (const Arm& arm : arms_) {
    Vector shifted = arm.eigenvalues.array() - t;
    for (auto& x : shifted) {
      count += x <= 0;
      if (x == 0) x = -1e-300;
    }
    const Columns w = arm.eigenvectors.transpose() * arm.border;
    complement.noalias() -= w.transpose() * shifted.cwiseInverse().asDiagonal() * w;
  }
  const Eigen::SelfAdjointEigenSolver<Columns> eigen(complement, Eigen::EigenvaluesOnly);
  return count + static_cast<std::size_t>((eigen.eigenvalues().array() <= 0).count());
}

ArrowRoot::Extremes ArrowRoot::extremes() const {
  const auto& all = head_.eigenvalues();
  if (arms_.empty()) return {all[0], all[all.size() - 1]};
  // Eigenvalues of a matrix with unit diagonal are 1 on average.
  const auto n = static_cast<double>(layout_->size());
  return {bisect(1e-18, 1 + 1e-9, [&](double t) { return at_most(t) > 0; }),
          bisect(1 - 1e-9, n + 1, [&](double t) { return at_most(t) == layout_->size(); })};
}

}  // namespace gonio
