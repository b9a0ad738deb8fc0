#pragma once
/// \file
/// Worth of a fit: how well the data determine each parameter, and what the model leaves over.
/// One pass over all samples, each on its own.

#include <memory>
#include <vector>

#include "brdf/model/model.h"
#include "fitting/result/document.h"
#include "fitting/sample/sampling.h"
#include "fitting/solve/accumulate.h"

namespace gonio {

class ArrowInverse;

/// Values that share their errors.
struct Cluster {
  ArrowMatrix bread;          ///< their part of the whole bread
  std::vector<double> score;  ///< Σ s over them
};

/// Parts of the sandwich (bread)⁻¹ meat (bread)⁻¹.
struct Sandwich {
  ArrowMatrix bread;  ///< Σ j jᵀ over the residuals that the robust loss does not clip
  /// Σ s sᵀ/(1 − h)², s = ρ' r j, over values that are independent; h is 0 where no influences are
  /// given.  0 where there are clusters.
  ArrowMatrix meat;
  std::vector<Cluster> clusters;  ///< of each incident angle
  /// Per unknown, of independent values and given influences: Σ β⁴, the part of Σ β² = 1 that comes
  /// from values which alone determine something, and Σ of the fourth powers of the moves B⁻¹ s/(1 − h)
  /// over the error (B⁻¹)_kk².
  std::vector<double> fourth, alone, moves;
};

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

struct Assessment {
  Sandwich sandwich;
  FitResiduals residuals;  ///< over all values, and per band of theta_i, theta_h and theta_d
  std::size_t incident_angles = 0;  ///< counted where scores are summed over them
  SampleCounts counts;
};

/// Incident angles are told apart as the rows of a theta_i axis that are no copies, to 0.001° in a
/// list, and by whole degrees where these are more than 360 and on a half/difference grid, where every
/// sample has its own.
/// \param by_incident_angle  whether values of one incident angle make a cluster
/// \param influences         of independent values; null: leverages count as 0
/// \param in_float           where its six digits are enough
/// \param most               about how many groups are looked at
Assessment assess(const Sampling&,
                  const BoundModel&,
                  const FreeSlots&,
                  double huber,
                  bool by_incident_angle,
                  const Influences* influences = nullptr,
                  bool in_float = false,
                  std::size_t most = static_cast<std::size_t>(-1));

/// Residuals of a model against a table.
FitResiduals residual_statistics(const BoundModel&, const Sampling&, std::size_t most);

}  // namespace gonio
