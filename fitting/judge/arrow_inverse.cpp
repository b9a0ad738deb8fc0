#include "fitting/judge/arrow_inverse.h"

namespace gonio {
namespace {

void put(const std::vector<std::size_t>& rows, const Columns& from, RowMajor& to) {
  for (std::size_t k = 0; k < rows.size(); ++k) to.row(index(rows[k])) = from.row(index(k));
}

}  // namespace

ArrowInverse::ArrowInverse(const ArrowMatrix& m) : layout_(m.shared_layout()) {
  if (layout_->size() == 0) return;
  const ArrowRoot root(m, 0);
  const auto& head = layout_->head();
  const auto& eigen = root.head();
  const Columns inverse =
      product(eigen.vectors * eigen.values.cwiseInverse().asDiagonal(), eigen.vectors.transpose());
  head_ = scaled(root.scale(), inverse, root.scale());
  u_ = RowMajor::Zero(index(layout_->size()), index(head.size()));
  for (std::size_t k = 0; k < head.size(); ++k) u_(index(head[k]), index(k)) = 1;
  for (std::size_t a = 0; a < root.arms().size(); ++a) {
    const auto& arm = root.arms()[a];
    const Columns half = scaled(arm.scale, arm.eigenvectors, arm.root);
    inverses_.push_back(times_transposed(half));
    put(layout_->arms()[a], -product(half, arm.w) * root.scale().cwiseInverse().asDiagonal(), u_);
  }
  uk_ = product(u_, head_);
}

double ArrowInverse::operator()(std::size_t i, std::size_t j) const {
  const std::size_t arm = layout_->arm(i);
  const double through_head = uk_.row(index(i)).dot(u_.row(index(j)));
  if (arm == ArrowLayout::none || arm != layout_->arm(j)) return through_head;
  return through_head + inverses_[arm](index(layout_->within(i)), index(layout_->within(j)));
}

double ArrowInverse::along(std::size_t i, std::size_t head) const {
  return u_(index(i), index(head));
}

std::vector<double> ArrowInverse::times(std::span<const double> v) const {
  const Eigen::Map<const VectorXd> all(v.data(), index(v.size()));
  VectorXd x = gonio::times(uk_, transposed_times(u_, all));
  for (std::size_t a = 0; a < inverses_.size(); ++a) {
    const auto& own = layout_->arms()[a];
    VectorXd part(index(own.size()));
    for (std::size_t k = 0; k < own.size(); ++k) part[index(k)] = v[own[k]];
    const VectorXd solved = gonio::times(inverses_[a], part);
    for (std::size_t k = 0; k < own.size(); ++k) x[index(own[k])] += solved[index(k)];
  }
  return {x.begin(), x.end()};
}

ArrowInverse::Sandwich::Sandwich(const ArrowInverse& bread, const ArrowMatrix& meat)
    : bread_(bread) {
  const ArrowLayout& layout = *bread.layout_;
  const Eigen::Index n = index(layout.size()), h = index(layout.head().size());
  q_ = RowMajor::Zero(n, h);
  Columns inner = Eigen::Map<const RowMajor>(meat.head(), h, h);  // UᵀMU
  for (std::size_t a = 0; a < layout.arms().size(); ++a) {
    const auto& own = layout.arms()[a];
    const Eigen::Index k = index(own.size());
    Columns u(k, h);
    for (Eigen::Index r = 0; r < k; ++r)
      u.row(r) = bread.u_.row(index(own[static_cast<std::size_t>(r)]));
    const Columns d = Eigen::Map<const RowMajor>(meat.own(a), k, k),
                  b = Eigen::Map<const RowMajor>(meat.border(a), k, h), mu = b + product(d, u);
    inner += transposed_product(u, mu) + transposed_product(b, u);
    put(own, product(bread.inverses_[a], mu), q_);
    squares_.push_back(product(product(bread.inverses_[a], d), bread.inverses_[a]));
  }
  outer_ = product(bread.u_, product(product(bread.head_, inner), bread.head_));
}

double ArrowInverse::Sandwich::operator()(std::size_t i, std::size_t j) const {
  const Eigen::Index r = index(i), c = index(j);
  const ArrowLayout& layout = *bread_.layout_;
  const std::size_t arm = layout.arm(i);
  double sum = outer_.row(r).dot(bread_.u_.row(c)) + q_.row(r).dot(bread_.uk_.row(c)) +
               bread_.uk_.row(r).dot(q_.row(c));
  if (arm != ArrowLayout::none && arm == layout.arm(j))
    sum += squares_[arm](index(layout.within(i)), index(layout.within(j)));
  return sum;
}

}  // namespace gonio
