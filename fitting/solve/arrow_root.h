#pragma once
/// \file
/// Decomposition of positive semidefinite arrow matrices.  Includes Eigen: for the sources that solve.

#include <cstddef>
#include <span>
#include <vector>

#include "fitting/solve/arrow.h"
#include "fitting/solve/matrix.h"

namespace gonio {

/// A scaled to a unit diagonal, S A S with S = diag(A)^(−1/2), its arms taken out one by one and the
/// head's Schur complement decomposed:
///
///   D_c = V_c Λ_c V_cᵀ,   W_c = Λ_c^(−1/2) V_cᵀ B_c,   H − Σ W_cᵀ W_c = V Λ Vᵀ
///
/// so that S A S = Jᵀ J with the rows  (Λ_c^(1/2) V_cᵀ on the arm, W_c on the head)  of each arm and
/// Λ^(1/2) Vᵀ on the head.  Directions of an arm with an eigenvalue up to `tiny` are left out.
class ArrowRoot {
 public:
  ArrowRoot(const ArrowMatrix&, double tiny);

  struct Arm {
    VectorXd scale, eigenvalues, root;  ///< S; Λ_c; Λ_c^(−1/2), 0 where left out
    Columns eigenvectors, border, w;    ///< V_c, B_c, W_c
  };
  const VectorXd& scale() const { return scale_; }  ///< of the head
  const Eigenpairs& head() const { return head_; }
  const std::vector<Arm>& arms() const { return arms_; }

  /// Gradient g in that form: parts of the arms and of the head with Jᵀ r = S g, where
  /// r_c = arms[c] and the head's r = Λ^(−1/2) head.
  struct Rotated {
    std::vector<VectorXd> arms;
    VectorXd head;
  };
  Rotated rotated(std::span<const double> g) const;
  /// S (S A S)⁻¹ of what was rotated: A⁻¹ g, by unknowns.
  std::vector<double> solution(const Rotated&) const;

  /// Number of eigenvalues of S A S that are t or less.
  std::size_t at_most(double t) const;
  struct Extremes {
    double least, largest;
  };
  /// Extreme eigenvalues of S A S.
  Extremes extremes() const;

 private:
  std::shared_ptr<const ArrowLayout> layout_;
  VectorXd scale_;
  Columns scaled_;  ///< H
  Eigenpairs head_;
  std::vector<Arm> arms_;
};

}  // namespace gonio
