#include "fitting/solve/arrow.h"

#include <cmath>
#include <numeric>

namespace gonio {

ArrowLayout::ArrowLayout(std::size_t unknowns)
    : head_(unknowns), arm_(unknowns, none), within_(unknowns), entries_(unknowns * unknowns) {
  std::iota(head_.begin(), head_.end(), std::size_t{0});
  within_ = head_;
}

ArrowLayout::ArrowLayout(std::vector<std::size_t> head, std::vector<std::vector<std::size_t>> arms)
    : head_(std::move(head)), arms_(std::move(arms)) {
  std::erase_if(arms_, [](const auto& arm) { return arm.empty(); });
  if (head_.empty() && !arms_.empty()) {
    head_ = std::move(arms_.front());
    arms_.erase(arms_.begin());
  }
  std::size_t unknowns = head_.size();
  for (const auto& arm : arms_) unknowns += arm.size();
  arm_.assign(unknowns, none);
  within_.resize(unknowns);
  for (std::size_t k = 0; k < head_.size(); ++k) within_[head_[k]] = k;
  entries_ = head_.size() * head_.size();
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    own_.push_back(entries_);
    for (std::size_t k = 0; k < arms_[a].size(); ++k) {
      arm_[arms_[a][k]] = a;
      within_[arms_[a][k]] = k;
    }
    entries_ += arms_[a].size() * (arms_[a].size() + head_.size());
  }
}

std::size_t ArrowLayout::at(std::size_t i, std::size_t j) const {
  const std::size_t a = arm_[i], b = arm_[j];
  if (a == none && b == none) return within_[i] * head_.size() + within_[j];
  if (a == b) return own(a) + within_[i] * arms_[a].size() + within_[j];
  if (b == none) return border(a) + within_[i] * head_.size() + within_[j];
  if (a == none) return border(b) + within_[j] * head_.size() + within_[i];
  return none;
}

ArrowLayout ArrowLayout::part(const std::vector<std::size_t>& unknowns) const {
  std::vector<std::size_t> head;
  std::vector<std::vector<std::size_t>> arms(arms_.size());
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    (arm_[unknowns[k]] == none ? head : arms[arm_[unknowns[k]]]).push_back(k);
  return {std::move(head), std::move(arms)};
}

ArrowMatrix::ArrowMatrix(std::initializer_list<double> dense)
    : layout_(std::make_shared<const ArrowLayout>(
          static_cast<std::size_t>(std::lround(std::sqrt(dense.size()))))),
      entries_(dense) {}

ArrowMatrix& ArrowMatrix::operator+=(const ArrowMatrix& m) {
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i] += m.entries_[i];
  return *this;
}

ArrowMatrix& ArrowMatrix::operator*=(double factor) {
  for (auto& x : entries_) x *= factor;
  return *this;
}

ArrowMatrix ArrowMatrix::part(std::shared_ptr<const ArrowLayout> layout,
                              const std::vector<std::size_t>& unknowns) const {
  ArrowMatrix m(std::move(layout));
  const auto copy = [&](const std::vector<std::size_t>& rows,
                        const std::vector<std::size_t>& columns) {
    for (const std::size_t i : rows)
      for (const std::size_t j : columns)
        m.entries_[m.layout_->at(i, j)] = (*this)(unknowns[i], unknowns[j]);
  };
  const auto& head = m.layout_->head();
  copy(head, head);
  for (const auto& arm : m.layout_->arms()) {
    copy(arm, arm);
    copy(arm, head);
  }
  return m;
}

}  // namespace gonio
