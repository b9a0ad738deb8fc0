#include "fitting/solve/arrow_root.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  scaled_ = scaled(scale_, head, scale_);
  Columns complement = scaled_;
  for (std::size_t a = 0; a < layout_->arms().size(); ++a) {
    const Eigen::Index k = index(layout_->arms()[a].size());
    const Eigen::Map<const RowMajor> own(m.own(a), k, k), border(m.border(a), k, n);
    Arm arm;
    arm.scale = scale_of(own);
    auto [values, vectors] = eigenpairs(scaled(arm.scale, own, arm.scale));
    arm.eigenvalues = std::move(values);
    arm.eigenvectors = std::move(vectors);
    arm.border = scaled(arm.scale, border, scale_);
    arm.root = arm.eigenvalues.unaryExpr([&](double x) { return x > tiny ? 1 / std::sqrt(x) : 0; });
    arm.w = arm.root.asDiagonal() * transposed_product(arm.eigenvectors, arm.border);
    complement -= transposed_product(arm.w, arm.w);
    arms_.push_back(std::move(arm));
  }
  head_ = eigenpairs(complement);
}

ArrowRoot::Rotated ArrowRoot::rotated(std::span<const double> g) const {
  const auto in_scale = [&](const std::vector<std::size_t>& unknowns, const VectorXd& scale) {
    VectorXd v(index(unknowns.size()));
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      v[index(k)] = scale[index(k)] * g[unknowns[k]];
    return v;
  };
  Rotated r;
  VectorXd head = in_scale(layout_->head(), scale_);
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    const Arm& arm = arms_[a];
    r.arms.push_back(arm.root.cwiseProduct(
        transposed_times(arm.eigenvectors, in_scale(layout_->arms()[a], arm.scale))));
    head -= transposed_times(arm.w, r.arms.back());
  }
  r.head = transposed_times(head_.vectors, head);
  return r;
}

std::vector<double> ArrowRoot::solution(const Rotated& r) const {
  std::vector<double> x(layout_->size());
  const VectorXd head = times(head_.vectors, r.head.cwiseQuotient(head_.values));
  const auto put = [&](const std::vector<std::size_t>& unknowns, const VectorXd& in_scale) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) x[unknowns[k]] = in_scale[index(k)];
  };
  put(layout_->head(), scale_.cwiseProduct(head));
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    const Arm& arm = arms_[a];
    const VectorXd rest = r.arms[a] - times(arm.w, head);
    put(layout_->arms()[a],
        arm.scale.cwiseProduct(times(arm.eigenvectors, arm.root.cwiseProduct(rest))));
  }
  return x;
}

std::size_t ArrowRoot::at_most(double t) const {
  if (arms_.empty()) return static_cast<std::size_t>((head_.values.array() <= t).count());
  // Sylvester's law of inertia: as many as of each D_c − t and of the Schur complement of A − t.
  std::size_t count = 0;
  Columns complement = scaled_;
  complement.diagonal().array() -= t;
  for (const Arm& arm : arms_) {
    VectorXd shifted = arm.eigenvalues.array() - t;
    for (auto& x : shifted) {
      count += x <= 0;
      if (x == 0) x = -1e-300;
    }
    const Columns w = transposed_product(arm.eigenvectors, arm.border);
    complement -= transposed_product(w, shifted.cwiseInverse().asDiagonal() * w);
  }
  return count + static_cast<std::size_t>((eigenvalues(complement).array() <= 0).count());
}

ArrowRoot::Extremes ArrowRoot::extremes() const {
  const auto& all = head_.values;
  if (arms_.empty()) return {all[0], all[all.size() - 1]};
  // Eigenvalues of a matrix with unit diagonal are 1 on average.
  const auto n = static_cast<double>(layout_->size());
  return {bisect(1e-18, 1 + 1e-9, [&](double t) { return at_most(t) > 0; }),
          bisect(1 - 1e-9, n + 1, [&](double t) { return at_most(t) == layout_->size(); })};
}

}  // namespace gonio
