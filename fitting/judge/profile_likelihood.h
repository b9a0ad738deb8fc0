#pragma once
/// \file
/// Profile of the cost over one parameter: how much worse the best fit is that has it elsewhere.

#include <vector>

#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

namespace gonio {

class ProfileLikelihood {
 public:
  /// Keeps references.
  ProfileLikelihood(const Problem&, const FitData<double>&, const Fitted&);

  const Fitted& best() const { return best_; }  ///< of these data
  /// Rise of twice the cost with an unknown held at a value and all others moved to where they are best.
  double rise(std::size_t unknown, double value) const;
  /// Place between that of the best fit and an end where the rise is `much`, to 1 % of the way; the end
  /// itself where it is less there.
  double reach(std::size_t unknown, double end, double much) const;

 private:
  const Problem& problem_;
  const FitData<double>& data_;
  Fitted best_;
};

}  // namespace gonio
