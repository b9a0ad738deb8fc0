#pragma once
/// \file
/// JᵀJ, Jᵀr and the cost of a model over all samples: one pass over SIMD columns on all threads,
/// the same sums whatever the number of threads.

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "brdf/kernel/kernels.h"
#include "brdf/model/model.h"
#include "fitting/sample/data.h"
#include "fitting/solve/arrow.h"

namespace gonio {

/// Value slots of a model that a fit may move; the others keep their values.
class FreeSlots {
 public:
  explicit FreeSlots(std::vector<bool> free);
  /// Slots of which one channel alone knows become the arms of its matrices, where there are many.
  FreeSlots(const Model&, std::vector<bool> free);
  std::size_t size() const { return slots_.size(); }
  const std::vector<bool>& mask() const { return mask_; }
  std::span<const std::size_t> slots() const { return slots_; }
  /// Position among the free ones, of a slot that is free.
  std::size_t index(std::size_t slot) const { return index_[slot]; }
  /// Free ones of all values, in order.
  std::vector<double> of(std::span<const double> values) const;
  /// Puts them back where they belong.
  void put(std::span<const double> free, std::span<double> values) const;
  /// Layout of a matrix over the free ones.
  const std::shared_ptr<const ArrowLayout>& layout() const { return layout_; }

 private:
  std::vector<bool> mask_;
  std::vector<std::size_t> slots_, index_;
  std::shared_ptr<const ArrowLayout> layout_;
};

struct NormalEquations {
  ArrowMatrix h;          ///< JᵀJ with robust weights: Σ ρ' j jᵀ
  std::vector<double> g;  ///< Σ ρ' r j
  double cost = 0;        ///< ½ Σ ρ(r²)
};
/// True where the cost, times the scale, and all sums times it are finite.
bool is_finite(const NormalEquations&, double scale = 1);

/// Residuals beyond it count linearly.
inline constexpr double no_huber = std::numeric_limits<double>::max();

/// The sums of [r, J]ᵀ[r, J] of one channel: lanes during a task, added up after it.
template <class F>
class GramSums {
 public:
  /// \param columns  of r and J together
  explicit GramSums(std::size_t columns) : lanes_(columns * (columns + 1) / 2 * padding) {}
  F* lanes() { return lanes_.data(); }
  double entry(std::size_t e) const {
    double sum = 0;
    for (std::size_t i = 0; i < padding; ++i)
      sum += static_cast<double>(lanes_.data()[e * padding + i]);
    return sum;
  }
  /// Adds the part of J (and of r to g, unless that is null) where it belongs.
  /// \param free  the position among n unknowns of each column of J; n where it is not free
  void scatter(const std::vector<std::size_t>& free,
               std::size_t n,
               ArrowMatrix& h,
               std::vector<double>* g) const;

 private:
  Column<F> lanes_;
};

/// One pass is one evaluation of the model with its derivatives at every sample.
template <class F>
class Accumulator {
 public:
  /// Keeps references.
  Accumulator(const Model&, const FitData<F>&, const FreeSlots&, double huber = no_huber);
  ~Accumulator();

  /// \param values  model.value_count of them
  NormalEquations normal_equations(std::span<const double> values) const;
  /// Costs of the channels, each its own.
  std::vector<double> channel_costs(std::span<const double> values) const;
  /// Weighted residuals of what is compared, task by task, channel by channel in each block.
  std::vector<double> residuals(std::span<const double> values) const;

 private:
  struct Passes;
  const Model& model_;
  const FitData<F>& data_;
  const FreeSlots& free_;
  F huber_;
  std::unique_ptr<Passes> passes_;
};

}  // namespace gonio
