#pragma once
/// \file
/// Proofs that every value of a formula keeps its bounds, for all inputs of a domain, by enclosures of boxes
/// (number/enclosure.h).
///
/// A box whose enclosure keeps the bounds is done.  Another is looked at in the number itself, at its corners and its
/// middle: one value outside the bounds refutes the claim, and is its counterexample.  Else it is cut in two, where
/// that halves the longest side in logarithms towards 0, on the grid of the number, down to single inputs.  What is
/// then left is looked at in more places, and stays open.  Where a value rises or falls with an input all over a
/// box, its bounds are taken at the box's faces: Schlick's f0 (1 − w) + w is at most what it is for f0 = 1.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "number/enclosure.h"
#include "stability/evidence.h"
#include "stability/subject.h"

namespace gonio::stability {

/// Formula as it is enclosed, and its value in the number, computed in one way that the rule allows.
template <class F>
struct Provable {
  std::function<Enclosure<F>(std::span<const Enclosure<F>>)> enclosed;
  std::function<double(std::span<const double>)> value;
};

/// Work after which what is not proved is open.  Of boxes alone the result does not depend on the machine.
struct ProofBudget {
  std::uint64_t boxes = 100'000;
  double seconds = std::numeric_limits<double>::infinity();
};

/// Inputs of a value that is not within the bounds.
struct Violation {
  std::vector<double> inputs;
  std::vector<std::string> inputs_hex;
  double value;
};

/// Box of inputs, and what values its enclosure has.
struct OpenBox {
  std::vector<Range> inputs;
  Range values;
  bool may_be_nan;

  /// "alpha 0.01 to 0.02, noh 1: values from 3 to inf, or no number"
  std::string text(const Subject&) const;
};

struct Proof {
  Evidence evidence = Evidence::open;  ///< proved; searched: there is a counterexample; open
  std::optional<Range> range;          ///< of the values, where it is proved
  std::uint64_t boxes = 0;             ///< that were enclosed
  std::uint64_t open_boxes = 0;
  double open_share = 0;          ///< of the domain, its sides measured as they are cut
  std::vector<OpenBox> open;      ///< the first of those that are open
  std::uint64_t evaluations = 0;  ///< in the number, looking for a counterexample
  bool out_of_budget = false;
  std::optional<Violation> counterexample;

  bool holds() const { return evidence == Evidence::proved; }
};

/// Bounds of all finite values of a number, of those that are not negative, too.
Range finite_values(Number);
Range finite_and_not_negative(Number);

/// Rounding by which an arithmetic's results lie in enclosures; of any GPU subnormals are flushed or not, whatever it says.
Rounding rounding_of(const Arithmetic&);

/// Claim that all values over the domain are numbers within the bounds required.  Same result whatever the threads.
template <class F>
Proof prove(const Provable<F>&,
            std::span<const Range> domain,
            const Rounding&,
            const Range& required,
            const ProofBudget& = {});

/// Claim about a subject over its domain, in half, float or double; wrong usage for another number.
Proof prove(
    const Subject&, Number, const Rounding&, const Range& required, const ProofBudget& = {});

/// Least value of the input that decides (Subject::decides) from which on the claim is proved, found by halving; no value:
/// of none, or there is no such input.
std::optional<double> proved_from(const Subject&,
                                  Number,
                                  const Rounding&,
                                  const Range& required,
                                  const ProofBudget& = {.boxes = 2000});

}  // namespace gonio::stability
