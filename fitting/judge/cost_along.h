#pragma once
/// \file
/// Profile of the cost over one parameter: how much worse the best fit is that has it elsewhere.

#include <utility>
#include <vector>

#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

/// Cost along one unknown, all others moved to where they are best.
class CostAlong {
 public:
  /// Keeps references.
  /// \param best  of these data
  CostAlong(const Problem&, const FitData<double>&, const Fitted& best, std::size_t unknown);

  /// Rise of twice the cost with the unknown held at a value.
  /// \param scale  rise that it is compared with: it is right to 1 % of that
  double rise(double value, double scale);
  /// Values of all slots in the best fit that the last rise is of.
  const std::vector<double>& last() const { return solved_.back().second; }
  /// Place between that of the best fit and an end where the rise is `much`, to 1 % of the way; the end
  /// itself where it is less there.
  double reach(double end, double much);

 private:
  std::vector<double> start_at(double value) const;

  Problem held_;
  Accumulator<double> accumulate_;
  std::size_t slot_;
  double cost_;
  std::vector<std::pair<double, std::vector<double>>>
      solved_;  ///< values of all slots, the best first
};

}  // namespace gonio
