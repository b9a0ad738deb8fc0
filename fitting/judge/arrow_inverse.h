#pragma once
/// \file
/// Inverse of positive definite arrow matrices, entry by entry.  Includes Eigen: for the sources of
/// this room.

#include <memory>
#include <span>
#include <vector>

#include "fitting/solve/arrow_root.h"

namespace gonio {

/// Inverse of an arrow matrix B.  With its arms taken out,
///
///   B⁻¹ = E + U K Uᵀ,   E = diag(0, D_c⁻¹),   U = (1, −D_c⁻¹ B_c),   K the head's Schur complement⁻¹
class ArrowInverse {
 public:
  explicit ArrowInverse(const ArrowMatrix&);
  double operator()(std::size_t i, std::size_t j) const;
  /// B⁻¹ v
  std::vector<double> times(std::span<const double> v) const;
  /// Entry (row, column of the head) of U: the unknown's share in a move of the head.
  double along(std::size_t i, std::size_t head) const;

  /// B⁻¹ M B⁻¹ of a matrix M of the same layout, whose entries take time that does not depend on the
  /// number of arms:
  ///
  ///   U (K UᵀMU K) Uᵀ + Q (U K)ᵀ + (U K) Qᵀ + E M E,   Q = E M U
  class Sandwich {
   public:
    Sandwich(const ArrowInverse&, const ArrowMatrix& meat);
    double operator()(std::size_t i, std::size_t j) const;

   private:
    const ArrowInverse& bread_;
    RowMajor q_, outer_;            ///< by unknown: Q, U (K UᵀMU K)
    std::vector<Columns> squares_;  ///< E M E of each arm
  };

 private:
  std::shared_ptr<const ArrowLayout> layout_;
  Columns head_;                   ///< K
  RowMajor u_, uk_;                ///< by unknown: U, U K
  std::vector<Columns> inverses_;  ///< D_c⁻¹
};

}  // namespace gonio
