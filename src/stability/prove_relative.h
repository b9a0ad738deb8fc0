#pragma once
/// \file
/// Proofs of a bound of the relative error, for all inputs of a domain, by Gappa (https://gappa.gitlabpages.inria.fr),
/// where it is installed: of forms of + − × ÷ √ (number/scripted.h), rounded to nearest or as any GPU may round,
/// not contracted.
///
/// Error here is that of the formula's operations and constants: its inputs are exact as the number holds them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "number/rounding.h"
#include "stability/evidence.h"
#include "stability/subject.h"

namespace gonio::stability {

/// RelativeProof::why on a machine without Gappa.
inline constexpr std::string_view without_gappa = "Gappa is not installed";

struct RelativeProof {
  std::optional<double> bound;  ///< of |x / f − 1|
  /// Inputs for which it holds: those of the subject; or, where that bounds ten times as closely, without angles of 1
  /// itself, where √(1 − 1) would be, and of less than twice the least normal number, whose products lose digits.
  std::vector<Range> domain;
  bool whole = false;  ///< the domain is all of the subject's
  std::string why;     ///< where there is no bound: in a few words, why not
};

/// The lowest bound that Gappa finds, told where to split the domain and not.  Nothing overflows on the way, which
/// Gappa would not see: that is proved by the enclosures of the values.
///
/// \param seconds  that Gappa may take, in all
RelativeProof prove_relative(const Subject&, Number, const Rounding& = {}, double seconds = 10);

/// Script for Gappa of a subject over a domain; empty: `why` says what of it cannot be written.
std::string gappa_script(const Subject&,
                         Number,
                         const Rounding&,
                         const std::vector<Range>& domain,
                         bool split,
                         std::string& why);

/// Largest size of the interval that Gappa found, "… in [-7b-3 {…}, 5b-4 {…}]"; no value where it found none.
std::optional<double> gappa_bound(const std::string& output);

}  // namespace gonio::stability
