#pragma once
/// \file
/// Factors that an instrument may put on all values of one angle, taken out of residuals.

#include <cstddef>
#include <vector>

#include "fitting/judge/left_over.h"

namespace gonio::misfit {

/// Factors of their own for each channel under each angle of some axes.
///
/// A value's residual changes with the factors of its angles by Value::change.  The factors that fit a column of residuals best are
/// its weighted means over each angle, axis after axis until they settle: any number of factors costs little.
class Gains {
 public:
  Gains(const Left&, const std::vector<SharedAngle>&);
  /// Number of factors that the values tell apart.
  std::size_t count() const { return count_; }
  bool empty() const { return of_axis_.empty(); }
  /// The part of a column, of one number per value, that the best factors explain.
  /// \param scores  the column times Value::active; of residuals these themselves, which are clipped
  /// \param factors  [axis][angle · channels + channel]: if there, gets the logarithms of the factors
  std::vector<double> taken_up(const std::vector<double>& scores,
                               std::vector<std::vector<double>>* factors = nullptr) const;

 private:
  struct OfAxis {
    std::vector<std::size_t> group;  ///< of each value: its angle and channel
    std::vector<double> weight;      ///< of each group
  };
  const Left& left_;
  std::vector<OfAxis> of_axis_;
  std::size_t count_ = 0;
};

}  // namespace gonio::misfit
