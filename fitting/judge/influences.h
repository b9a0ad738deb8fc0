#pragma once
/// \file
/// Influence of each value of a table on what a fit finds.

#include <cstddef>
#include <memory>
#include <vector>

#include "fitting/solve/arrow.h"

namespace gonio {

class ArrowInverse;

/// Influence of each value on the unknowns: of a value with derivatives j the unknowns move by
/// b = B⁻¹ j times its error.  β_k = b_k/√(B⁻¹)_kk is that in parts of the unknown's own error, if all
/// errors are alike: Σ β_k² = 1.  The leverage of the value is h = jᵀ B⁻¹ j.
class Influences {
 public:
  /// \param bread  of the fit   \param determined  unknowns that move; the others have no influence
  Influences(const ArrowMatrix& bread, const std::vector<std::size_t>& determined);

  /// One channel's: rows of the unknowns that its values move by themselves.
  struct Channel {
    std::vector<std::size_t> unknown;       ///< of each row
    std::vector<std::vector<double>> beta;  ///< [row][derivative]: β = Σ beta j
    std::vector<double> leverage;           ///< [row]: h = Σ_derivative leverage j β, of its row
    std::vector<std::size_t> row;           ///< [derivative], `none` where undetermined
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// \param free  unknowns that the channel's derivatives belong to
  Channel channel(const std::vector<std::size_t>& free) const;

  /// Adds to sums of fourth powers of the unknowns in arms what values of other arms do to them, through
  /// the head.  Of several unknowns in the head it takes the most that these can do together (Minkowski).
  /// \param by_arm  such sums of the head's unknowns over the values of each arm
  void add_others(const std::vector<std::vector<double>>& by_arm,
                  std::vector<double>& fourth) const;
  const ArrowLayout& layout() const { return *layout_; }

 private:
  std::shared_ptr<const ArrowLayout> layout_;  ///< of all unknowns
  std::vector<std::size_t> place_;             ///< among the determined; or `none`
  std::vector<double> error_;                  ///< √(B⁻¹)_kk of those
  std::shared_ptr<const ArrowInverse> inverse_;
};

}  // namespace gonio
