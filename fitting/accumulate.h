#pragma once
/// \file
/// JᵀJ, Jᵀr and the cost of a model over all samples: one pass over SIMD columns on all threads,
/// the same sums whatever the number of threads.

#include <limits>
#include <span>
#include <vector>

#include "brdf/kernels.h"
#include "brdf/model.h"
#include "fitting/data.h"

namespace gonio {

/// Which value slots of a model a fit may move; the others keep their values.
class FreeSlots {
 public:
  explicit FreeSlots(std::vector<bool> free);
  std::size_t size() const { return slots_.size(); }
  const std::vector<bool>& mask() const { return mask_; }
  std::span<const std::size_t> slots() const { return slots_; }
  /// Position among the free ones, of a slot that is free.
  std::size_t index(std::size_t slot) const { return index_[slot]; }

 private:
  std::vector<bool> mask_;
  std::vector<std::size_t> slots_, index_;
};

/// Symmetric, row-major, of the free slots.
using Matrix = std::vector<double>;

struct NormalEquations {
  Matrix h;               ///< JᵀJ with robust weights: Σ ρ' j jᵀ
  std::vector<double> g;  ///< Σ ρ' r j
  double cost = 0;        ///< ½ Σ ρ(r²)
};

/// The parts of the sandwich (bread)⁻¹ meat (bread)⁻¹.
struct Sandwich {
  Matrix bread;  ///< Σ j jᵀ over the residuals that the robust loss does not clip
  Matrix meat;   ///< Σ s sᵀ, s = ρ' r j: of each value, or summed over each cluster first
};

/// What is minimised: ½ Σ ρ(w² residual(f, y)²) over all valid values.
struct Objective {
  Metric metric = Metric::log;
  double huber = std::numeric_limits<double>::max();  ///< max: plain least squares
};

class Accumulator {
 public:
  /// Keeps references to all but the objective.
  Accumulator(const Model& model, const FitData& data, const FreeSlots& free, Objective objective)
      : model_(model), data_(data), free_(free), objective_(objective) {}

  /// \param values  model.value_count of them
  NormalEquations normal_equations(std::span<const double> values) const;
  /// \param by_incident_angle  whether scores are summed over each incident angle first
  Sandwich sandwich(std::span<const double> values, bool by_incident_angle) const;
  /// Weighted residuals of the valid values, channel after channel.
  std::vector<double> residuals(std::span<const double> values) const;

 private:
  const Model& model_;
  const FitData& data_;
  const FreeSlots& free_;
  Objective objective_;
};

}  // namespace gonio
