#pragma once
/// \file
/// Symmetric matrices in arrow form: unknowns that all channels share and, for each channel, its own,
/// which meet those of no other channel.  Storing, solving and judging them takes time linear in the
/// number of channels.
///
///       ⎛ H   B₁ᵀ  B₂ᵀ … ⎞   head: what is shared
///   A = ⎜ B₁  D₁         ⎟   arms: D_c of a channel's own, B_c where they meet the head
///       ⎝ B₂       D₂    ⎠
///
/// A small matrix is all head: then it is stored densely, row by row.

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace gonio {

/// Places of the unknowns 0 … n − 1 in such a matrix.
class ArrowLayout {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// All in the head.
  explicit ArrowLayout(std::size_t unknowns = 0);
  /// Without a head the first arm becomes one.
  ArrowLayout(std::vector<std::size_t> head, std::vector<std::vector<std::size_t>> arms);

  std::size_t size() const { return arm_.size(); }
  std::size_t entries() const { return entries_; }
  const std::vector<std::size_t>& head() const { return head_; }
  const std::vector<std::vector<std::size_t>>& arms() const { return arms_; }
  /// Arm of an unknown; `none` for the head.
  std::size_t arm(std::size_t unknown) const { return arm_[unknown]; }
  /// Number of an unknown within its arm or the head.
  std::size_t within(std::size_t unknown) const { return within_[unknown]; }
  /// Place of A_ij among the entries; `none` where two arms do not meet.
  std::size_t at(std::size_t i, std::size_t j) const;
  std::size_t own(std::size_t arm) const { return own_[arm]; }
  std::size_t border(std::size_t arm) const {
    return own_[arm] + arms_[arm].size() * arms_[arm].size();
  }

  /// Layout of some of the unknowns, numbered anew in the order given.
  ArrowLayout part(const std::vector<std::size_t>& unknowns) const;

 private:
  std::vector<std::size_t> head_;
  std::vector<std::vector<std::size_t>> arms_;
  std::vector<std::size_t> arm_, within_;  ///< of each unknown
  std::vector<std::size_t> own_;           ///< where an arm's entries begin: D, then B
  std::size_t entries_ = 0;
};

class ArrowMatrix {
 public:
  ArrowMatrix() : ArrowMatrix(std::make_shared<const ArrowLayout>()) {}
  explicit ArrowMatrix(std::shared_ptr<const ArrowLayout> layout)
      : layout_(std::move(layout)), entries_(layout_->entries()) {}
  /// \param entries  as entries() gives them
  ArrowMatrix(std::shared_ptr<const ArrowLayout> layout, std::vector<double> entries)
      : layout_(std::move(layout)), entries_(std::move(entries)) {}
  /// All head, row by row.
  ArrowMatrix(std::initializer_list<double> dense);

  const ArrowLayout& layout() const { return *layout_; }
  const std::shared_ptr<const ArrowLayout>& shared_layout() const { return layout_; }
  std::size_t size() const { return layout_->size(); }
  double operator()(std::size_t i, std::size_t j) const {
    const std::size_t at = layout_->at(i, j);
    return at == ArrowLayout::none ? 0 : entries_[at];
  }
  /// Adds to A_ij and A_ji, which must not be of two arms.
  void add(std::size_t i, std::size_t j, double value) {
    const std::size_t at = layout_->at(i, j), mirrored = layout_->at(j, i);
    entries_[at] += value;
    if (mirrored != at) entries_[mirrored] += value;
  }
  ArrowMatrix& operator+=(const ArrowMatrix& of_the_same_layout);
  ArrowMatrix& operator*=(double factor);

  /// All that is stored: the head row by row, then D and B of each arm, row by row.
  std::span<const double> entries() const { return entries_; }
  const double* head() const { return entries_.data(); }
  const double* own(std::size_t arm) const { return entries_.data() + layout_->own(arm); }
  const double* border(std::size_t arm) const { return entries_.data() + layout_->border(arm); }

  /// Rows and columns of some unknowns.
  /// \param layout  this one's part of those
  ArrowMatrix part(std::shared_ptr<const ArrowLayout> layout,
                   const std::vector<std::size_t>& unknowns) const;

 private:
  std::shared_ptr<const ArrowLayout> layout_;
  std::vector<double> entries_;
};

}  // namespace gonio
