#pragma once
/// \file
/// A time for a whole scene, shared out among its materials.

#include <cstddef>
#include <limits>
#include <vector>

namespace gonio::scene {

/// Set of forms that a material may take.
struct Choice {
  double ns = 0;         ///< of a visible sample
  double error = 0;      ///< upper bound of its quantile
  bool breaks = false;   ///< the tolerance, however little it errs
  double spread_ns = 0;  ///< of the time
  std::size_t rank = 0;  ///< the lower of those that are as fast is taken
};
struct Sharer {
  double coverage = 0;          ///< of the picture
  std::vector<Choice> choices;  ///< not empty
};
struct Shares {
  std::vector<std::size_t> choice;  ///< of each material
  double ns = 0;                    ///< mean over visible samples, weighted by coverage
  double error = 0;                 ///< the worst
  bool fits = false;                ///< within the budget; else each takes what is cheapest
};

/// Choices with the least worst error whose mean time keeps the budget; of those with that error the cheapest.  The worst
/// error is one of the choices' own: the least of these for which everyone's cheapest choice within it fits.  What is left of the
/// budget goes to those that err by more than `enough`, or break the tolerance otherwise, the worst first: each takes the cheapest
/// choice that errs by no more, or else the nearest that fits.  Last, each takes of the choices that are as fast as its own the one of
/// the lowest rank that errs by no more than the worst, or than enough, and keeps the budget.
Shares share_out(std::vector<Sharer>,
                 double budget_ns,
                 double enough = std::numeric_limits<double>::infinity());

}  // namespace gonio::scene
